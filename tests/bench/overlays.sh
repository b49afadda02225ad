#!/usr/bin/env bash
# What overlays cost: each scene as a 1080p60 video at the default quality without them and with them, in turns. CPU seconds are user + system
# of all processes; printed are the medians and the median of the pairs' ratios. Called by ./dev bench overlays; RUNS=N and ONLY="circles_all" narrow
# it. Exit status 1 when a figure misses its target.
set -euo pipefail
root=$(realpath "$(dirname "$0")/../..")
offstage=${OFFSTAGE:-$root/build/release/offstage}
runs=${RUNS:-3}
missed=0
work=$(mktemp -d "${BENCH_DIR:-/dev/shm}/offstage-bench.XXXXXX")
trap 'rm -rf "$work"' EXIT

TIMEFORMAT='%R %U %S'
measure() { { time "$offstage" render "$1" --size 1920x1080 -o "$work/out.mp4" --progress none >/dev/null 2>"$work/errors"; } 2>&1 ||
  { cat "$work/errors" >&2; exit 1; }; } # wall user system
median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

# The scene without the tables of these names.
without() { awk -v names="$2" 'BEGIN { n = split(names, list); for (i = 1; i <= n; ++i) drop["[[" list[i] "]]"] = 1 }
  /^\[/ { skip = $1 in drop } !skip' "$1"; }

# A hundred circles of the video bench's kind, five seconds; their walls throw them back.
circles() {
  printf 'duration = 5\n[frame]\nsize = [1920, 1080]\n[world]\ngravity = [0, 0]\n[walls]\nall = 1\n'
  awk 'BEGIN { srand(7); for (i = 0; i < 100; ++i)
    printf "[[body]]\nname = \"b%d\"\ncenter = [%.1f, %.1f]\nradius = %.1f\nvelocity = [%.1f, %.1f]\nfill = \"#%02x%02x%02x\"\n",
      i, 40 + rand() * 1840, 40 + rand() * 1000, 12 + rand() * 18, (rand() * 2 - 1) * 300, (rand() * 2 - 1) * 300,
      rand() * 200, rand() * 200, rand() * 200 }'
}
trails='[[trail]]'
arrows='[[arrow]]'
plot=$'[[plot]]\ny = ["kinetic", "b0.kinetic", "b1.kinetic"]\narea = [1240, 20, 660, 420]'

circles >"$work/circles.toml"
for what in trails arrows plot; do { circles; printf '%s\n' "${!what}"; } >"$work/circles_$what.toml"; done
{ circles; printf '%s\n' "$trails" "$arrows" "$plot"; } >"$work/circles_all.toml"
cp "$root/scenes/lecture_euler.toml" "$root/scenes/lecture_projectiles.toml" "$work"
for lecture in lecture_euler lecture_projectiles; do
  without "$work/$lecture.toml" 'trail arrow ghost mark outline ruler plot text' >"$work/${lecture}_plain.toml"
done

# row PLAIN OVERLAID
row() {
  local plain=() overlaid=() ratios=() a b
  [[ " ${ONLY:-$2} " == *" $2 "* ]] || return 0
  for ((i = 0; i < runs; ++i)); do
    a=$(measure "$work/$1.toml" | awk '{ print $2 + $3 }')
    b=$(measure "$work/$2.toml" | awk '{ print $2 + $3 }')
    plain+=("$a") overlaid+=("$b") ratios+=("$(awk -v a="$a" -v b="$b" 'BEGIN { printf "%.3f", b / a }')")
  done
  local ratio verdict=ok
  ratio=$(printf '%s\n' "${ratios[@]}" | median)
  awk -v r="$ratio" 'BEGIN { exit !(r < 1.3) }' || { verdict=MISSED; missed=1; }
  printf '  %-22s %7s s without, %7s s with: %s (below 1.3) %s\n' "$2" "$(printf '%s\n' "${plain[@]}" | median)" \
    "$(printf '%s\n' "${overlaid[@]}" | median)" "$ratio" "$verdict"
}
echo 'CPU of a video without and with overlays'
row circles circles_trails
row circles circles_arrows
row circles circles_plot
row circles circles_all
row lecture_euler_plain lecture_euler
row lecture_projectiles_plain lecture_projectiles

# A minute of lecture, with a process a processor.
if [[ " ${ONLY:-pace} " == *" pace "* ]]; then
  walls=()
  for ((i = 0; i < runs; ++i)); do walls+=("$(measure "$work/lecture_euler.toml" | awk '{ print $1 }')"); done
  wall=$(printf '%s\n' "${walls[@]}" | median)
  pace=$(awk -v w="$wall" 'BEGIN { printf "%.2f", 60 / w }')
  verdict=ok
  awk -v p="$pace" 'BEGIN { exit !(p >= 3) }' || { verdict=MISSED; missed=1; }
  echo "  lecture_euler, 60 s of video in $wall s on $(nproc) processors: $pace times real time (at least 3) $verdict"
fi
exit $missed
