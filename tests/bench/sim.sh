#!/usr/bin/env bash
# Workload S, circles that fall into a heap, beside Chipmunk and Box2D 2.4: medians of runs taken in turns. Called by ./dev bench sim.
set -euo pipefail
cd "$(dirname "$0")/../.."
bin=build/release/tests/bench

median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

printf '%-22s %10s %10s %10s %8s %8s   %s\n' 'CPU ms a step' offstage chipmunk box2d2.4 /chipm. /box2d 'ratios: medians of the pairs'
row() { # N STEPS RUNS
  local ours=() chipmunk=() box2d=() to_chipmunk=() to_box2d=() a b c ours_rest chipmunk_rest box2d_rest
  for ((i = 0; i < $3; ++i)); do
    read -r a ours_rest < <("$bin/sim_offstage" "$1" "$2")
    read -r b chipmunk_rest < <("$bin/sim_chipmunk" "$1" "$2" 2>/dev/null | tail -1)
    read -r c box2d_rest < <("$bin/sim_box2d24" "$1" "$2")
    ours+=("$a") chipmunk+=("$b") box2d+=("$c")
    to_chipmunk+=("$(awk -v a="$a" -v b="$b" 'BEGIN { printf "%.3f", a / b }')")
    to_box2d+=("$(awk -v a="$a" -v b="$c" 'BEGIN { printf "%.3f", a / b }')")
  done
  last=$(printf '%s\n' "${ours[@]}" | median)
  printf '%-22s %10s %10s %10s %8s %8s\n' "N = $1, $2 steps" "$last" "$(printf '%s\n' "${chipmunk[@]}" | median)" \
    "$(printf '%s\n' "${box2d[@]}" | median)" "$(printf '%s\n' "${to_chipmunk[@]}" | median)" "$(printf '%s\n' "${to_box2d[@]}" | median)"
  local mean worst before after outside bytes name rest
  for name in offstage chipmunk box2d2.4; do
    case $name in offstage) rest=$ours_rest ;; chipmunk) rest=$chipmunk_rest ;; *) rest=$box2d_rest ;; esac
    read -r mean worst before after outside bytes <<<"$rest"
    echo "    $name: overlap mean $mean r, worst $worst r; energy $before to $after J a body; $outside outside; $bytes bytes a body"
  done
}
row 1000 300 5
row 10000 300 3
ten_thousand=$last
row 100000 "${1:-60}" 3
awk -v a="$last" -v b="$ten_thousand" 'BEGIN { printf "from N = 10000 to 100000 a step of Offstage takes %.1f times as long\n", a / b }'
