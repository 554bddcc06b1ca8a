#!/usr/bin/env bash
# From nothing to poses: installs and builds what is missing, runs the chain as separate processes over LCM on a
# recording, prints a line for each frame and person, and ends with pictures and the accuracy.
#   modules/demo.sh                            the demo log of this repository
#   modules/demo.sh RECORDING [CALIBRATION]    your own: a folder of *_left/*_right images, *_color/*_depth images,
#                                              *_depth images alone or laser scans (.pcd, .ply, .bin), a Velodyne's
#                                              .pcap, or a log made by lcm-logger; CALIBRATION of images: default
#                                              FOLDER/calibration.yml
# Settings (environment): DEMO_OUTPUT folder for log and pictures, DEMO_RATE frames a second.
# Exit codes: 0 done, 1 failed, 2 wrong usage or input.
set -euo pipefail
source "$(dirname "$0")/usage.sh"
check_arguments 0 2 "$@"
start_folder=$PWD
cd "$(dirname "$0")/.."
root=$PWD

fail() { echo "demo: $*" >&2; exit 1; }
refuse() { echo "demo: $*" >&2; exit 2; }
step() { printf '\n[%s/5] %s\n' "$1" "$2"; }

input=${1:-$root/logs/demo.log}
calibration=${2:-}
rate=${DEMO_RATE:-5}
output=${DEMO_OUTPUT:-$root/demo-output}
case $input in /*) ;; *) input=$start_folder/$input ;; esac
case $calibration in '' | /*) ;; *) calibration=$start_folder/$calibration ;; esac
case $output in /*) ;; *) output=$start_folder/$output ;; esac
bin=$root/build/release/bin

pids=()
cleanup() {
  trap - EXIT INT TERM
  [ ${#pids[@]} -eq 0 ] || kill "${pids[@]}" 2>/dev/null || true
  wait 2>/dev/null || true
}
trap cleanup EXIT
trap 'cleanup; exit 130' INT TERM

[ -e "$input" ] || refuse "$input: no such folder or log"
# What an earlier demo wrote goes; nothing else does.
if [ -e "$output" ] && [ ! -e "$output/processes" ] && [ -n "$(ls -A "$output")" ]; then
  refuse "$output: holds what no demo wrote; set DEMO_OUTPUT to a folder that is empty or not there"
fi

# What feeds the chain: the camera process of this kind of recording.
if [[ $input == *.pcap ]] || { [ -d "$input" ] && ls "$input" | grep -Eiq '\.(pcd|ply|bin)$'; }; then
  camera=(limbcast-laser-scanner --source "$input")
elif [ -d "$input" ]; then
  if compgen -G "$input/*_left.*" >/dev/null; then
    camera=(limbcast-stereo-camera)
  elif compgen -G "$input/*_color.*" >/dev/null || compgen -G "$input/*_depth.*" >/dev/null; then
    camera=(limbcast-depth-camera)
  else
    refuse "$input: holds no *_left.* and *_right.* images, no *_color.* and *_depth.png images and no scans"
  fi
  calibration=${calibration:-$input/calibration.yml}
  [ -e "$calibration" ] || refuse "$calibration: no such calibration; give it as second argument"
  camera+=(--source "$input" --calibration "$calibration")
elif grep -aq -m 1 DEPTH_IMAGES "$input"; then
  camera=(limbcast-depth-camera --source "$input")
elif grep -aq -m 1 STEREO_IMAGES "$input"; then
  camera=(limbcast-stereo-camera --source "$input")
else
  refuse "$input: holds no images; a log of clouds goes through limbcast-replay"
fi

step 1 "What limbcast needs"
modules/install_dependencies.sh run
echo "all there"

step 2 "Build"
build_log=$(mktemp)
cmake --preset release >"$build_log" 2>&1 || { tail -n 30 "$build_log" >&2; fail "cmake failed, see above"; }
cmake --build --preset release --target limbcast_demo_programs
rm -f "$build_log"

step 3 "Run: ${camera[0]#limbcast-}, reconstructor, segmenter, pose-fitter, recorded by lcm-logger"
# A port of its own, so that no other LCM traffic is disturbed; ttl=0: nothing leaves this host.
export LCM_DEFAULT_URL="udpm://239.255.76.67:$((20000 + $$ % 30000))?ttl=0&recv_buf_size=2000000"
if ! ip route get 239.255.76.67 >/dev/null 2>&1; then
  # Without any network the kernel has no route for multicast; over the loopback device it stays here.
  ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo ||
    fail "no multicast route; as root: ip link set lo multicast on; ip route add 224.0.0.0/4 dev lo"
fi
rm -rf "$output"
mkdir -p "$output/processes"
run_log=$output/run.log

start() {  # start NAME COMMAND...
  local name=$1
  shift
  "$@" >"$output/processes/$name.txt" 2>&1 &
  pids+=($!)
}
start lcm-logger lcm-logger --quiet "$run_log"
logger=${pids[-1]}
for module in reconstructor segmenter pose-fitter; do start "$module" "$bin/limbcast-$module"; done
chain=("${pids[@]:1}")
"$bin/limbcast-export-poses" --format text 2>"$output/processes/export-poses.txt" \
  > >(exec tee "$output/poses.txt") &
pids+=($!)
for module in reconstructor segmenter pose-fitter export-poses; do
  until grep -q "INFO" "$output/processes/$module.txt" 2>/dev/null; do
    kill -0 "${pids[@]}" 2>/dev/null || { cat "$output/processes/"*.txt >&2; fail "a process did not start"; }
    sleep 0.1
  done
done
"$bin/${camera[0]}" "${camera[@]:1}" --rate "$rate" >"$output/processes/camera.txt" 2>&1 ||
  { code=$?; cat "$output/processes/camera.txt" >&2; echo "demo: the camera process failed" >&2; exit "$code"; }
# The last frames are still on their way, on a busy machine the first one too: done when for a second no line has come and
# the chain has hardly worked; before the first line for five, since starved processes stand still for a while.
chain_ticks() {  # its processes' time of the processor, user and system [10 ms]
  local pid
  for pid in "${chain[@]}"; do cut -d ' ' -f 14,15 "/proc/$pid/stat" 2>/dev/null || true; done |
    awk '{ sum += $1 + $2 } END { print sum + 0 }'
}
idle_ticks=2  # what waiting and telling the status takes of them at most in a second
quiet=0 lines=0 ticks=0
until [ "$quiet" -ge $((lines > 0 ? 1 : 5)) ]; do
  sleep 1
  now_lines=$(wc -l <"$output/poses.txt")
  now_ticks=$(chain_ticks)
  quiet=$((now_lines != lines || now_ticks - ticks > idle_ticks ? 0 : quiet + 1))
  lines=$now_lines ticks=$now_ticks
done
kill -INT "$logger"
cleanup
trap cleanup EXIT
pids=()
sent=$(sed -n 's/.* \([0-9]*\) frames sent$/\1/p' "$output/processes/camera.txt")
posed=$(cut -d ' ' -f 1 "$output/poses.txt" | sort -u | wc -l)
echo "$posed of $sent frames have their poses"
if [ "$posed" -lt "$sent" ]; then
  # Live, a busy machine skips frames rather than fall behind; a replay skips none.
  echo "(this machine was too busy for $rate frames a second; the rest follows in a replay of the recording)"
  cmake --build --preset release --target limbcast-replay
  "$bin/limbcast-replay" "$run_log" "$output/replayed.log"
  run_log=$output/replayed.log
  [ "$posed" -gt 0 ] || "$bin/limbcast-export-poses" "$run_log" --format text | tee "$output/poses.txt"
fi
[ -s "$output/poses.txt" ] || { tail -n 3 "$output/processes/"*.txt >&2; fail "no pose came out, see above"; }

step 4 "Pictures"
"$bin/limbcast-viewer" "$run_log" --png "$output/pictures"

step 5 "Accuracy against the truth in the recording"
"$bin/limbcast-evaluate" "$run_log" --brief || true

echo
echo "Log:      $run_log  (lcm-logplayer $(printf %q "$run_log"))"
echo "Pictures: $output/pictures"
echo "All other programs (replay, tracker, simulate ...): cmake --build --preset release"
