#!/usr/bin/env bash
# How fast pictures and videos are compared, beside odiff: ./dev bench diff
# Wall-clock medians of alternating runs, PNG decoding included. Exit status 1 when a figure misses its target.
set -euo pipefail
cd "$(dirname "$0")/../.."

offstage=$PWD/build/release/offstage
work=build/bench/diff
npm=build/npm-bench
runs=${RUNS:-9}
missed=0
mkdir -p "$work" "$npm"

for tool in node npm; do
  command -v $tool >/dev/null || { echo "bench diff: needs the Debian packages nodejs and npm" >&2; exit 3; }
done
if ! cmp -s tests/bench/diff/package.json "$npm/package.json" || [ ! -d "$npm/node_modules" ]; then
  cp tests/bench/diff/package.json "$npm/"
  (cd "$npm" && npm install --no-audit --no-fund --loglevel=error >/dev/null)
fi
# The program itself, not the script of Node that starts it.
odiff=$(find "$PWD/$npm/node_modules/@odiff" -type f -name odiff | head -1)

# Pairs: two moments of a scene, a file and its copy, two photographs.
make_pairs() {
  local size
  for size in 1920x1080 4096x4096; do
    [ -f "$work/same_$size.png" ] && continue
    "$offstage" still scenes/exercise2_bounce.toml --at 16 --size $size -o "$work/a_$size.png" >/dev/null
    "$offstage" still scenes/exercise2_bounce.toml --at 16.02 --size $size -o "$work/b_$size.png" >/dev/null
    cp "$work/a_$size.png" "$work/same_$size.png"
  done
  [ -f "$work/photo_b.png" ] || node tests/bench/diff/make_photo.mjs 4096 "$work/photo_a.png" "$work/photo_b.png"
  [ -f "$work/b.mp4" ] && return
  "$offstage" render scenes/exercise2_bounce.toml --size 1920x1080 --duration 60 --progress none -o "$work/a.mp4" >/dev/null
  "$offstage" render scenes/exercise2_bounce.toml --size 1920x1080 --duration 60 --seed 7 --progress none -o "$work/b.mp4" >/dev/null
}

# Milliseconds that a command takes; a difference found is no failure.
millis() {
  local begin end status=0
  begin=$(date +%s%N)
  "$@" >/dev/null 2>&1 || status=$?
  end=$(date +%s%N)
  [ "$status" -le 22 ] || { echo "bench diff: $* ended with $status" >&2; exit 1; }
  echo $(((end - begin) / 1000)) | awk '{ printf "%.1f", $1 / 1000 }'
}

median() { sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

# line WHAT FIGURE UNIT LIMIT
line() {
  local verdict=ok
  awk "BEGIN { exit !($2 <= $4) }" || { verdict=MISSED; missed=1; }
  printf '%-58s %8s %-3s (at most %s) %s\n' "$1" "$2" "$3" "$4" "$verdict"
}

# beside_odiff WHAT LIMIT A B
beside_odiff() {
  local ours=() theirs=() i a b
  for ((i = 0; i < runs; ++i)); do
    theirs+=("$(millis "$odiff" --antialiasing "$3" "$4" "$work/odiff.png")")
    ours+=("$(millis "$offstage" diff "$3" "$4")")
  done
  a=$(printf '%s\n' "${ours[@]}" | median)
  b=$(printf '%s\n' "${theirs[@]}" | median)
  line "$1: $a ms, odiff $b ms" "$(awk "BEGIN { printf \"%.2f\", $a / $b }")" x "$2"
}

seconds() { awk "BEGIN { printf \"%.2f\", $(millis "$@") / 1000 }"; }

make_pairs
for size in 1920x1080 4096x4096; do
  beside_odiff "$size, scene" 0.6 "$work/a_$size.png" "$work/b_$size.png"
  beside_odiff "$size, identical" 0.3 "$work/a_$size.png" "$work/same_$size.png"
done
beside_odiff "4096x4096, photographs" 0.6 "$work/photo_a.png" "$work/photo_b.png"

# Peak memory, as the kernel counts it.
peak() { bash -c '"$@" >/dev/null & child=$!; peak=0
  while [ -r /proc/$child/status ]; do
    now=$(awk "/VmHWM/ { print int(\$2 / 1024) }" /proc/$child/status 2>/dev/null); [ "${now:-0}" -gt $peak ] && peak=$now
  done; echo $peak' peak "$@"; }
line "4096x4096, scene: peak memory" "$(peak "$offstage" diff "$work/a_4096x4096.png" "$work/b_4096x4096.png")" MB 200
line "4096x4096, photographs: peak memory" "$(peak "$offstage" diff "$work/photo_a.png" "$work/photo_b.png")" MB 200

# The reference tool takes 22 s on a pair of 4096x4096 (two cores at 2.5 GHz).
line "4096x4096, scene: every metric with FLIP" "$(seconds "$offstage" diff --metric all "$work/a_4096x4096.png" "$work/b_4096x4096.png")" s 2.2
line "4096x4096, photographs: every metric with FLIP" "$(seconds "$offstage" diff --metric all "$work/photo_a.png" "$work/photo_b.png")" s 11
line "60 s of 1080p, same video" "$(seconds "$offstage" diff "$work/a.mp4" "$work/a.mp4")" s 60
line "60 s of 1080p, every frame different" "$(seconds "$offstage" diff "$work/a.mp4" "$work/b.mp4")" s 60
exit $missed
