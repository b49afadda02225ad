#!/usr/bin/env bash
# Workload R, frames to nowhere, beside cairo: medians of five runs, taken in turns. Called by ./dev bench raster.
set -euo pipefail
cd "$(dirname "$0")/../.."
bin=build/release/tests/bench
offstage=build/release/offstage
runs=5

median() { sort -g | sed -n "$(((runs + 1) / 2))p"; }

printf '%-22s %10s %10s %8s   %s\n' 'raster, 1920x1080' offstage cairo ratio 'CPU ms a frame; ratio: the median of the pairs'
row() { # NAME N FRAMES MODE
  local ours=() theirs=() ratios=() a b
  for ((i = 0; i < runs; ++i)); do
    read -r a _ < <("$bin/raster_offstage" "$2" "$3" "$4")
    read -r b _ < <("$bin/raster_cairo" "$2" "$3" "$4")
    ours+=("$a") theirs+=("$b") ratios+=("$(awk -v a="$a" -v b="$b" 'BEGIN { printf "%.3f", a / b }')")
  done
  printf '%-22s %10s %10s %8s\n' "$1" "$(printf '%s\n' "${ours[@]}" | median)" "$(printf '%s\n' "${theirs[@]}" | median)" \
    "$(printf '%s\n' "${ratios[@]}" | median)"
}
row 'N = 10' 10 300 circles
row 'N = 1000' 1000 100 circles
row 'N = 10000' 10000 20 circles
row 'P (100 patterns)' 100 100 pattern

for n in 10 1000; do
  read -r paused _ < <("$bin/raster_offstage" $n 1000 paused)
  echo "paused, N = $n: $paused ms a frame"
done
read -r _ short < <("$bin/raster_offstage" 10 300)
read -r _ long < <("$bin/raster_offstage" 10 30000)
echo "peak memory: $short KiB after 300 frames, $long KiB after 30000"

scene=scenes/fall.toml
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
TIMEFORMAT='%U %S'
cold() { # shader cache: true or false for disabled
  local times=()
  for ((i = 0; i < runs; ++i)); do
    times+=("$({ time MESA_SHADER_CACHE_DISABLE=$1 "$offstage" still "$scene" --at 0 -o "$work/a.png" >/dev/null 2>&1; } 2>&1 |
      awk '{ printf "%.0f", 1000 * ($1 + $2) }')")
  done
  printf '%s\n' "${times[@]}" | median
}
echo "first frame of a 640x480 scene, program start to PNG: $(cold false) ms CPU, $(cold true) ms without Mesa's shader cache"
"$bin/raster_offstage" 10 1 first
