#!/bin/bash
# Makes the logs of this folder again from the rendered frames of data/stereo_dev (CC0).
# Usage: logs/make_logs.sh DATA_DIR BIN_DIR
#   DATA_DIR  folder that holds stereo_dev
#   BIN_DIR   folder of the built programs, e.g. build/release/bin
set -euo pipefail
source "$(dirname "$0")/../modules/usage.sh"
check_arguments 2 2 "$@"
data=$(realpath "$1")/stereo_dev
bin=$(realpath "$2")
logs=$(realpath "$(dirname "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The frames come from recordings of different days. One clock for all of them, five frames a second, lets
# lcm-logplayer play a log as if it had been recorded in one go.
first_utime=1775000000000000
step_us=200000

# make_log NAME SET/FRAME... : links the frames into one folder and records it.
make_log() {
  local name=$1 folder=$work/$1 utime=$first_utime frame set id
  shift
  mkdir "$folder"
  cp "$data/pointing/calibration.yml" "$folder/"
  echo "name,utime,down_x,down_y,down_z" > "$folder/timestamps.csv"
  for frame in "$@"; do
    set=${frame%/*}
    id=${frame#*/}
    for side in left right; do ln -s "$data/$set/${id}_$side.jpg" "$folder/"; done
    sed -E "0,/\"utime\": *[0-9]+/s//\"utime\": $utime/" "$data/$set/${id}_gt.json" > "$folder/${id}_gt.json"
    sed -n -E "s/^$id,[0-9]+,(.*)/$id,$utime,\1/p" "$data/$set/timestamps.csv" >> "$folder/timestamps.csv"
    utime=$((utime + step_us))
  done
  rm -f "$logs/$name.log"
  "$bin/limbcast-stereo-camera" --source "$folder" --calibration "$folder/calibration.yml" \
    --log "$logs/$name.log" --log-level warning
  echo "$name.log: $# frames, $(stat -c %s "$logs/$name.log") bytes"
}

# frames SET PREFIX NUMBER... : SET/PREFIX_0007 for each number
frames() {
  local set=$1 prefix=$2 number
  shift 2
  for number in "$@"; do printf '%s/%s_%04d ' "$set" "$prefix" "$number"; done
}

# shellcheck disable=SC2046  # a list of words is wanted
make_log demo \
  $(frames pointing pointing60 58 2 3 15 34 16 11 24 33 38) \
  $(frames general general60 1 3 6 15 44 22) \
  $(frames multi multi12 0 4) \
  $(frames pointing pointing60 46 54 42 43 0 1 12 25 27 53) \
  $(frames general general60 5 29 23 46 28 0) \
  $(frames multi multi12 9 11) \
  $(frames sequence seq5s 30 31 32 33 34 35 36 37 38 39 40 41)
# shellcheck disable=SC2046
make_log multi $(frames multi multi12 1 2 3 5 6 7 8 10)
# shellcheck disable=SC2046
make_log nobody $(frames nohuman nohuman12 0 1 2 3 5 8 9 10)
