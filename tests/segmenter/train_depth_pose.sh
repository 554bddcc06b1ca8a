#!/bin/bash
# Trains limbcast's own network of poses from nothing: simulates people before each sensor, and rooms and streets without
# any, draws their depths and writes modules/segmenter/models/depth_pose.tflite. Build again afterwards, and fit the
# confidences of the refined fitter anew (tests/pose_fitter/train.sh). Needs Debian's python3-torch and
# python3-flatbuffers.
# Usage: tests/segmenter/train_depth_pose.sh SIMULATED_DIR DATA_DIR [BIN_DIR]
#   SIMULATED_DIR   14290 simulated frames, 10 GB, about an hour on two cores; sets and pictures that are there stay
#   DATA_DIR        the folder of laser_dev, stereo_dev and rgbd_pointing: to check on, nobody there is trained on
#   BIN_DIR         default: build/release/bin
# Run it after segments or range images changed. Training takes an hour and a half on two cores without
# brain floats of 16 bits; with them a step takes a third of the time.
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 2 3 "$@"
cd "$(dirname "$0")/../.."
simulated=$(realpath -m "$1") data=$(realpath "$2") bin=${3:-build/release/bin}
source tests/support/simulated_sets.sh

gray=(--color=false) far=(--max-distance-m 5) near=(--max-distance-m 4.5) children=(--child-share 0.2)
simulate n_depth_general general depth 500 20001 "${gray[@]}" "${children[@]}" "${far[@]}"
simulate n_dense_general general laser 300 20002 "${children[@]}" "${far[@]}" "${dense[@]}"
simulate n_laser_pointing pointing laser 300 20003 --child-share 0.1 "${far[@]}"
simulate n_depth_multi multi depth 200 20004 "${gray[@]}" "${children[@]}"
simulate n_depth_low general depth 150 20005 "${gray[@]}" "${low[@]}"
simulate n_few_general general laser 150 20006 --max-distance-m 6 "${few[@]}" "${coats[@]}"
simulate n_stereo_general general stereo 250 20007 "${children[@]}"
simulate n_depth_pointing pointing depth 500 20011 "${gray[@]}" --child-share 0.1 "${far[@]}"
simulate n_dense_pointing pointing laser 300 20012 --child-share 0.1 "${far[@]}" "${dense[@]}"
simulate n_laser_general general laser 300 20013 "${children[@]}" "${far[@]}"
simulate n_laser_multi multi laser 150 20014 "${children[@]}"
simulate n_dense_multi multi laser 100 20015 "${children[@]}" "${dense[@]}"
simulate n_depth_up general depth 100 20016 "${gray[@]}" "${up[@]}"
simulate n_depth_desk general depth 100 20017 "${gray[@]}" "${desk[@]}"
simulate n_stereo_pointing pointing stereo 250 20018 --child-share 0.1 "${far[@]}"
simulate n_depth_sit general depth 300 20021 "${gray[@]}" --posture sit
simulate n_stereo_sit general stereo 150 20022 --posture sit
simulate n_depth_general2 general depth 500 20023 "${gray[@]}" "${far[@]}" "${coats[@]}"
simulate n_depth_pointing2 pointing depth 500 20024 "${gray[@]}" "${far[@]}"
simulate n_stereo_multi multi stereo 200 20025 --child-share 0.15
simulate n_stereo_general2 general stereo 400 20026 "${near[@]}"
simulate n_stereo_pointing2 pointing stereo 400 20027 "${near[@]}"
simulate n_laser_general2 general laser 300 20028 "${far[@]}" "${coats[@]}"
simulate n_dense_pointing2 pointing laser 300 20029 "${far[@]}" "${dense[@]}"
simulate n_few_pointing pointing laser 200 20030 --max-distance-m 6 "${few[@]}"
simulate n_stereo_low general stereo 150 20031 "${near[@]}" "${low[@]}"
simulate n_stereo_up general stereo 120 20032 "${near[@]}" "${up[@]}"
simulate n_stereo_desk general stereo 150 20033 "${desk[@]}"
simulate n_stereo_high general stereo 120 20034 "${near[@]}" "${high[@]}"
simulate n_wide_general general laser 150 20035 "${far[@]}" "${wide[@]}" "${coats[@]}"
simulate n_laser_sit general laser 100 20036 --posture sit
# People beside and before one another, whose sides are told apart least.
simulate n_stereo_multi2 multi stereo 350 20051 --child-share 0.15
simulate n_depth_multi2 multi depth 300 20052 "${gray[@]}" --child-share 0.15
simulate n_dense_multi2 multi laser 250 20053 --child-share 0.15 "${dense[@]}"
simulate n_laser_multi2 multi laser 200 20054 --child-share 0.15
# More before stereo pairs, whose depths are the roughest.
simulate n_stereo_pointing4 pointing stereo 900 20061 --child-share 0.15 "${far[@]}"
simulate n_stereo_multi4 multi stereo 450 20062 --child-share 0.15
simulate n_stereo_general4 general stereo 800 20063 "${children[@]}" "${far[@]}"
# Rooms and streets: what may be taken for people.
simulate n_depth_nohuman nohuman depth 400 20041 "${gray[@]}"
simulate n_depth_nohuman2 nohuman depth 200 20042 "${gray[@]}" "${low[@]}"
simulate n_stereo_nohuman nohuman stereo 500 20043
simulate n_stereo_nohuman2 nohuman stereo 150 20044 "${desk[@]}"
simulate n_dense_nohuman nohuman laser 500 20045 "${dense[@]}"
simulate n_laser_nohuman nohuman laser 500 20046
simulate n_few_nohuman nohuman laser 400 20047 "${few[@]}"
simulate n_wide_nohuman nohuman laser 300 20048 "${wide[@]}"
simulate n_street_nohuman nohuman laser 400 20049 "${few[@]}" --street-share 1 --max-camera-height-m 2.1

pictures() {
  local out=$simulated/$(basename "$1").bin
  [ -e "$out" ] && return
  "$bin/limbcast-write-depth-pictures" "$out.part" "$1"
  mv "$out.part" "$out"
}
training=()
for folder in "${folders[@]}"; do
  pictures "$folder"
  training+=("$folder.bin")
done
checks=()
for set in laser_dev stereo_dev/pointing stereo_dev/general stereo_dev/multi stereo_dev/nohuman rgbd_pointing; do
  pictures "$data/$set"
  checks+=("$simulated/$(basename "$set").bin")
done
/usr/bin/python3 tests/segmenter/train_depth_pose.py modules/segmenter/models/depth_pose.tflite "${training[@]}" \
  --check "${checks[@]}"
