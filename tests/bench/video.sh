#!/usr/bin/env bash
# Workload R into files, beside FFmpeg and beside cairo piped into FFmpeg: medians of runs taken in turns. CPU seconds are
# user + system of all processes. Called by ./dev bench video; RUNS=N and ONLY="10 1000" narrow it. Exit status 1 when a
# figure misses its target.
set -euo pipefail
root=$(realpath "$(dirname "$0")/../..")
offstage=$root/build/release/offstage
runs=${RUNS:-3}
missed=0
# FFmpeg's input comes from memory, as the targets have it.
work=$(mktemp -d "${BENCH_DIR:-/dev/shm}/offstage-bench.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
cp "$root/build/release/tests/bench/video_cairo" cairo

TIMEFORMAT='%R %U %S'
measure() { { time "$@" >/dev/null 2>errors; } 2>&1 || { cat errors >&2; exit 1; }; } # wall user system
cpu() { measure "$@" | awk '{ print $2 + $3 }'; }
wall() { measure "$@" | awk '{ print $1 }'; }
median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.3f", a / b }'; }

# line WHAT FIGURE LIMIT [least]
line() {
  local verdict=ok word='at most'
  [ "${4:-}" = least ] && word='at least'
  awk -v f="$2" -v l="$3" -v w="$word" 'BEGIN { exit !(w == "at most" ? f <= l : f >= l) }' || { verdict=MISSED; missed=1; }
  printf '  %-52s %9s  (%s %s) %s\n' "$1" "$2" "$word" "$3" "$verdict"
}

# paired UNIT LIMIT WHAT A… -- B…: the median of the ratios of pairs of runs, A by B; UNIT: cpu or wall
paired() {
  local unit=$1 limit=$2 what=$3 a=() b=() ratios=() mine=() theirs=() x y
  shift 3
  while [ "$1" != -- ]; do a+=("$1"); shift; done
  shift
  b=("$@")
  for ((i = 0; i < runs; ++i)); do
    x=$($unit "${a[@]}") y=$($unit "${b[@]}")
    mine+=("$x") theirs+=("$y") ratios+=("$(ratio "$x" "$y")")
  done
  line "$what: $(printf '%s\n' "${mine[@]}" | median) s, $(printf '%s\n' "${theirs[@]}" | median) s" \
    "$(printf '%s\n' "${ratios[@]}" | median)" "$limit"
}

# Where two processors share a core, no program halves its time with two workers.
at_once() {
  local ratios=() one both
  for ((i = 0; i < runs; ++i)); do
    one=$(wall "$offstage" render scene.toml --jobs 1 -o ours.mp4)
    both=$(wall bash -c '"$0" render scene.toml --jobs 1 -o ours.mp4 & "$0" render scene.toml --jobs 1 -o also.mp4; wait' "$offstage")
    ratios+=("$(awk -v a="$both" -v b="$one" 'BEGIN { printf "%.3f", a / (2 * b) }')")
  done
  printf '%s\n' "${ratios[@]}" | median
}

# Frame by frame, whatever the containers make of the times.
ssim() { ffmpeg -i "$1" -i frames.y4m -lavfi '[0]settb=1/60,setpts=N[a];[1]settb=1/60,setpts=N[b];[a][b]ssim' -f null - 2>&1 | sed -n 's/.*All:\([0-9.]*\).*/\1/p'; }
size() { du -bc "$@" | awk 'END { print $1 }'; }
x264=(-c:v libx264 -preset veryfast -crf 20 -y)
# As the video is tagged: BT.709, limited range, chroma sited left. FFmpeg's default filter sites it in the middle.
yuv=scale=out_color_matrix=bt709:out_range=tv:flags=bilinear+accurate_rnd+full_chroma_inp:out_h_chr_pos=0:out_v_chr_pos=128
raw=(-f rawvideo -s 1920x1080 -r 60)

for case in '10 300 0.85 0.4 0.3' '1000 300 0.85 0.7 0.3' '10000 60 1.05 0.5 0.38'; do
  read -r n frames alone piped png <<<"$case"
  [[ " ${ONLY:-10 1000 10000} " == *" $n "* ]] || continue
  echo "N = $n, $frames frames of 1920x1080"
  ./cairo scene $n "$frames" >scene.toml
  "$offstage" render scene.toml -o - --progress none 2>/dev/null |
    ffmpeg -v error "${raw[@]}" -pix_fmt rgba -i - -vf "$yuv" -pix_fmt yuv420p -y frames.y4m

  paired cpu "$alone" 'CPU, the encoder alone on ready frames' "$offstage" render scene.toml -o ours.mp4 -- \
    ffmpeg -v error -i frames.y4m "${x264[@]}" theirs.mp4
  line 'size by the encoder alone' "$(ratio "$(size ours.mp4)" "$(size theirs.mp4)")" 1.1
  line "SSIM" "$(ssim ours.mp4)" "$(ssim theirs.mp4)" least
  paired cpu "$piped" 'CPU, cairo piped into ffmpeg' "$offstage" render scene.toml -o ours.mp4 -- \
    bash -c "./cairo raw $n $frames | ffmpeg -v error ${raw[*]} -pix_fmt bgr0 -i - -pix_fmt yuv420p ${x264[*]} theirs.mp4"
  paired wall 0.55 'wall clock, 2 workers by 1' "$offstage" render scene.toml --jobs 2 -o ours.mp4 -- \
    "$offstage" render scene.toml --jobs 1 -o ours.mp4
  echo "    what this machine's processors give: two such runs at once by both in turn $(at_once)"

  mkdir -p ours theirs
  seconds=$((frames / 60)) && [ "$seconds" -le 2 ] || seconds=2
  "$offstage" render scene.toml --to "$seconds" -o - --progress none 2>/dev/null |
    ffmpeg -v error "${raw[@]}" -pix_fmt rgba -i - -pix_fmt rgb24 -f rawvideo -y frames.rgb
  rm frames.y4m
  paired cpu "$png" "PNG sequence, CPU, ffmpeg's png encoder" "$offstage" render scene.toml --to "$seconds" -o ours/%05d.png -- \
    ffmpeg -v error "${raw[@]}" -pix_fmt rgb24 -i frames.rgb -c:v png -y theirs/%05d.png
  line 'PNG sequence, size' "$(ratio "$(size ours/*.png)" "$(size theirs/*.png)")" 1.1
  rm -r frames.rgb ours theirs
done

# Memory: what the kernel charges each process, shared pages by their share (PSS).
peak() {
  "$@" >/dev/null 2>&1 &
  local parent=$! most=0 now
  while kill -0 $parent 2>/dev/null; do
    now=$(for p in $parent $(pgrep -P $parent) $(pgrep -P "$(pgrep -d, -P $parent)" 2>/dev/null); do
      awk '/^Pss:/ { print $2 }' /proc/$p/smaps_rollup 2>/dev/null
    done | awk '{ s += $1 } END { print int(s / 1000) }')
    [ "${now:-0}" -gt $most ] && most=$now
  done
  echo $most
}
./cairo scene 1000 600 >scene.toml
for jobs in 1 2; do
  line "memory of all processes with $jobs worker(s), MB" "$(peak "$offstage" render scene.toml --jobs $jobs -o ours.mp4)" \
    $((150 + 120 * jobs))
done
# The other formats, 48 frames.
sed 's/^\[frame\]/&\nbackground = "transparent"/' scene.toml >clear.toml
for case in 'scene ours.webm' 'clear ours.webm' 'clear ours.mov' 'scene ours.mkv --quality lossless' \
  'clear ours.mkv --quality lossless' 'scene ours.gif' 'scene ours.apng' 'scene ours-%03d.png'; do
  read -r scene out options <<<"$case"
  # shellcheck disable=SC2086
  line "memory with 2 workers, $scene $out $options, MB" \
    "$(peak "$offstage" render $scene.toml --to 0.8 --jobs 2 $options -o $out)" $((150 + 2 * 120))
done
exit $missed
