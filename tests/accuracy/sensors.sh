#!/usr/bin/env bash
# Measures for each kind of sensor how exact poses are at which distance and how many frames a second one core works on, and prints
# the table of README.md, all on simulated people who point (limbcast-simulate --report); then recorded people, where there are any.
#   tests/accuracy/sensors.sh [FRAMES [DATA_DIR]]
# FRAMES: at each distance, default 12. DATA_DIR: default ../shared/data. The reports stay in build/sensors/.
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 0 2 "$@"
cd "$(dirname "$0")/../.."
frames=${1:-12}
data=${2:-../shared/data}
rate_frames=32 # whose time is taken
bin=build/release/bin
out=build/sensors
mkdir -p "$out"

# cpu_seconds COMMAND...: what it takes of a core
cpu_seconds() {
  local TIMEFORMAT='%U %S'
  { time "$@" >/dev/null 2>&1; } 2>&1 | awk '{ print $1 + $2 }'
}

# frame_rate LOG: frames a second of one core; the networks, which are loaded once, do not count
frame_rate() {
  local all first
  "$bin/limbcast-log" cut "$1" "$1.first" --to-frame 0 --log-level warning
  all=$(cpu_seconds "$bin/limbcast-replay" "$1" "$1.out" --threads 1)
  first=$(cpu_seconds "$bin/limbcast-replay" "$1.first" "$1.out" --threads 1)
  awk -v all="$all" -v first="$first" -v frames="$rate_frames" 'BEGIN { print (frames - 1) / (all - first) }'
}

# simulated NAME OPTION...: a row of the table
simulated() {
  local name=$1 stem report
  shift
  stem=$out/${name//[^a-z0-9]/_}
  report=$stem.txt
  "$bin/limbcast-simulate" --report "$@" --report-frames "$frames" --report-step-m 1 --report-to-m 5.5 \
    --log-level warning >"$report"
  "$bin/limbcast-simulate" --log "$stem.in.log" "$@" --frames "$rate_frames" --min-distance-m 2.4 --max-distance-m 3.6 \
    --log-level warning
  # Columns of the report: distance m, sigma cm, points, found %, joints %, error cm, postures %, pointing deg.
  awk -v name="$name" -v rate="$(frame_rate "$stem.in.log")" '
    $2 == "m" { for (i = 3; i <= 14; i++) if ($i ~ /^[0-9.]+$/) $i = sprintf("%.1f", $i)
                sigma = sigma " / " $3; found = found " / " sprintf("%.0f", $6)
                joints = joints " / " sprintf("%.0f", $8); error = error " / " $10; pointing = pointing " / " $14 }
    END { printf "| %s | %s | %s | %s | %s | %s | %.0f |\n", name, substr(sigma, 4), substr(found, 4), substr(joints, 4),
                 substr(error, 4), substr(pointing, 4), rate }' "$report"
}

echo "| sensor, simulated, at 1.5 / 2.5 / 3.5 / 4.5 / 5.5 m | sigma of distance [cm] | people found [%] | joints within 10 cm [%] | mean error [cm] | pointing, median [degrees] | frames/s of one core |"
echo "|---|---|---|---|---|---|---|"
simulated "stereo pair, vga, 12 cm" --sensor stereo
simulated "side by side, 672 x 376, 12 cm" --sensor stereo --width-px 672 --height-px 376 --focal-px 350
simulated "depth camera, vga" --sensor depth
simulated "laser, 64 rings" --sensor laser --rings 64

# recorded NAME PROGRAM FOLDER OPTION...: the main figures of a recording with truth
recorded() {
  local name=$1 program=$2 folder=$3
  shift 3
  [ -d "$folder" ] || return 0
  "$bin/$program" --source "$folder" "$@" --log "$out/$name.in.log" --log-level warning
  "$bin/limbcast-replay" "$out/$name.in.log" "$out/$name.out.log" --log-level warning
  echo "$name: $("$bin/limbcast-evaluate" "$out/$name.out.log" --brief --log-level warning)"
}
echo
recorded laser_dev limbcast-laser-scanner "$data/laser_dev"
recorded rgbd_pointing limbcast-depth-camera "$data/rgbd_pointing" --calibration "$data/rgbd_pointing/calibration.yml"
recorded stereo_dev_general limbcast-stereo-camera "$data/stereo_dev/general" --calibration "$data/stereo_dev/general/calibration.yml"
