#!/bin/bash
# Trains limbcast's own networks of poses from nothing: simulates people before each sensor, and rooms and streets without
# any, draws their depths and writes depth_pose.tflite, scan_depth_pose.tflite and bent_depth_pose.tflite of
# modules/segmenter/models. Build again afterwards, and fit the confidences of the refined fitter anew
# (tests/pose_fitter/train.sh). Needs Debian's python3-torch and python3-flatbuffers.
# Usage: tests/segmenter/train_depth_pose.sh SIMULATED_DIR DATA_DIR [BIN_DIR]
#   SIMULATED_DIR   30930 simulated frames, 19 GB, two hours on two cores; sets and pictures that are there stay
#   DATA_DIR        the folder of laser_dev, stereo_dev and rgbd_pointing: to check on, nobody there is trained on
#   BIN_DIR         default: build/release/bin
# Run it after segments or range images changed. Training takes two hours on two cores without brain
# floats of 16 bits; with them a step takes a third of the time.
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

cameras_and_scans=("${folders[@]}")
# People who bow, kneel and sit on the ground, who hold boards and crates, and whose heads are above the image, mostly
# before cameras.
folders=()
simulate b_stereo general stereo 300 20111 --posture bow "${children[@]}" "${far[@]}"
simulate b_depth general depth 300 20112 --posture bow "${gray[@]}" "${children[@]}" "${far[@]}"
simulate b_multi multi stereo 100 20116 --posture bow --child-share 0.15
simulate b_depth_kneel general depth 150 20121 --posture kneel "${gray[@]}" --child-share 0.25 "${far[@]}"
simulate b_stereo_kneel general stereo 120 20125 --posture kneel --child-share 0.25 "${near[@]}"
simulate b_depth_floor general depth 150 20131 --posture floor "${gray[@]}" --child-share 0.25 "${far[@]}"
simulate b_stereo_floor general stereo 120 20135 --posture floor --child-share 0.25 "${near[@]}"
simulate b_stereo2 general stereo 500 20141 --posture bow "${children[@]}" "${far[@]}"
simulate b_depth2 general depth 400 20142 --posture bow "${gray[@]}" "${children[@]}" "${far[@]}"
simulate b_multi2 multi stereo 200 20143 --posture bow --child-share 0.15
simulate b_depth_kneel2 general depth 250 20144 --posture kneel "${gray[@]}" --child-share 0.25 "${far[@]}"
simulate b_stereo_kneel2 general stereo 300 20145 --posture kneel --child-share 0.25 "${near[@]}"
simulate b_depth_floor2 general depth 400 20146 --posture floor "${gray[@]}" --child-share 0.25 "${far[@]}"
simulate b_stereo_floor2 general stereo 400 20147 --posture floor --child-share 0.25 "${near[@]}"
simulate b_multi_floor multi stereo 150 20148 --posture floor --child-share 0.15
simulate b_laser_bow general laser 150 20151 --posture bow "${children[@]}" "${far[@]}"
simulate b_laser_floor general laser 150 20153 --posture floor "${children[@]}" "${far[@]}"
simulate h_stereo general stereo 400 20161 --posture hold "${children[@]}" "${near[@]}"
simulate h_depth general depth 400 20162 --posture hold "${gray[@]}" "${children[@]}" "${far[@]}"
simulate h_multi multi stereo 150 20163 --posture hold --child-share 0.15
simulate h_stereo_near general stereo 250 20164 --posture hold --child-share 0.1 --min-distance-m 0.8 --max-distance-m 2.5
simulate h_laser general laser 150 20165 --posture hold "${children[@]}" "${far[@]}"
above=("${near_rooms[@]}" --head-above-share 1)
simulate a_stereo general stereo 400 20171 "${children[@]}" "${above[@]}"
simulate a_depth general depth 400 20172 "${gray[@]}" "${children[@]}" "${above[@]}"
simulate a_stereo_pointing pointing stereo 300 20173 --child-share 0.15 "${above[@]}"
simulate a_depth_pointing pointing depth 250 20174 "${gray[@]}" --child-share 0.15 "${above[@]}"
simulate a_multi multi stereo 150 20175 --child-share 0.15 "${near_rooms[@]}" --head-above-share 0.5
simulate a_stereo_nohuman nohuman stereo 250 20176 "${near_rooms[@]}"
simulate a_depth_nohuman nohuman depth 150 20177 "${gray[@]}" "${near_rooms[@]}"
bent=("${folders[@]}")
# Scans of rotating scanners: streets, where people walk and wear coats, farther away than rooms are wide.
folders=()
street=("${few[@]}" "${streets[@]}") narrow=("${few[@]}" "${streets[@]}" --max-elevation-deg 11.25)
simulate f_street64_general general laser 400 20071 --max-distance-m 9 "${streets[@]}" "${coats[@]}"
simulate f_street64_multi multi laser 250 20072 --max-distance-m 9 "${streets[@]}" "${coats[@]}"
simulate f_street_general general laser 350 20073 --max-distance-m 8 "${street[@]}" "${coats[@]}"
simulate f_street_multi multi laser 200 20074 --max-distance-m 8 "${street[@]}" "${coats[@]}"
simulate f_narrow_general general laser 300 20075 --min-distance-m 2.5 --max-distance-m 9 "${narrow[@]}" "${coats[@]}"
simulate f_roof_general general laser 400 20076 --max-distance-m 10 "${car_roof[@]}" "${coats[@]}"
simulate f_roof_multi multi laser 250 20077 --max-distance-m 10 "${car_roof[@]}" "${coats[@]}"
simulate f_street128_general general laser 200 20078 --max-distance-m 9 "${many[@]}" "${streets[@]}" "${coats[@]}"
simulate f_street64_nohuman nohuman laser 400 20079 "${streets[@]}"
simulate f_street_nohuman nohuman laser 400 20080 "${street[@]}"
simulate f_narrow_nohuman nohuman laser 300 20081 "${narrow[@]}"
simulate f_roof_nohuman nohuman laser 400 20082 "${car_roof[@]}"
simulate f_roof_pointing pointing laser 200 20084 --max-distance-m 9 "${car_roof[@]}"
thick=(--coat-share 0.5 --child-share 0.1)
simulate f_walk64 general laser 300 20101 --max-distance-m 9 "${streets[@]}" "${thick[@]}" --posture walk
simulate f_walkroof general laser 300 20102 --max-distance-m 10 "${car_roof[@]}" "${thick[@]}" --posture walk
simulate f_walk32 general laser 250 20103 --max-distance-m 8 "${street[@]}" "${thick[@]}" --posture walk
simulate f_carryroof general laser 200 20104 --max-distance-m 10 "${car_roof[@]}" "${thick[@]}" --posture carry
# Rooms, to the distance that each density allows.
simulate f_laser_general general laser 300 20085 --child-share 0.2 --max-distance-m 8
simulate f_laser_pointing pointing laser 300 20086 --child-share 0.1 --max-distance-m 6
simulate f_laser_multi multi laser 200 20087 --child-share 0.15 --max-distance-m 7
simulate f_laser_coats general laser 300 20088 --max-distance-m 6 "${coats[@]}"
simulate f_few_general general laser 250 20090 --max-distance-m 7 "${few[@]}" "${coats[@]}"
simulate f_few_pointing pointing laser 200 20091 --max-distance-m 6 "${few[@]}"
simulate f_wide_general general laser 150 20093 --max-distance-m 5 "${wide[@]}" "${coats[@]}"
simulate f_sixteen_general general laser 200 20094 --max-distance-m 5 "${sixteen[@]}" "${coats[@]}"
simulate f_sixteen_multi multi laser 100 20095 --max-distance-m 5 "${sixteen[@]}" "${coats[@]}"
simulate f_many_general general laser 150 20097 --max-distance-m 8 "${many[@]}" "${coats[@]}"
simulate f_laser_nohuman nohuman laser 400 20046
simulate f_few_nohuman nohuman laser 300 20047 "${few[@]}"
simulate f_wide_nohuman nohuman laser 200 20048 "${wide[@]}"
rings=("${folders[@]}")
# And of tilting ones.
folders=()
simulate f_dense_general general laser 300 20002 --child-share 0.2 --max-distance-m 5 "${dense[@]}"
simulate f_dense_pointing pointing laser 300 20012 --child-share 0.1 --max-distance-m 5 "${dense[@]}"
simulate f_dense_multi multi laser 250 20053 --child-share 0.15 "${dense[@]}"
simulate f_dense_nohuman nohuman laser 300 20045 "${dense[@]}"
rasters=("${folders[@]}")

pictures() {
  local out=$simulated/$(basename "$1").bin
  [ -e "$out" ] && return
  "$bin/limbcast-write-depth-pictures" "$out.part" "$1"
  mv "$out.part" "$out"
}
for folder in "${cameras_and_scans[@]}" "${bent[@]}" "${rings[@]}" "${rasters[@]}"; do pictures "$folder"; done
checks=()
for set in laser_dev stereo_dev/pointing stereo_dev/general stereo_dev/multi stereo_dev/nohuman rgbd_pointing; do
  pictures "$data/$set"
  checks+=("$simulated/$(basename "$set").bin")
done
models=modules/segmenter/models
/usr/bin/python3 tests/segmenter/train_depth_pose.py "$models/depth_pose.tflite" "$models/scan_depth_pose.tflite" \
  "$models/bent_depth_pose.tflite" "${cameras_and_scans[@]/%/.bin}" --rings "${rings[@]/%/.bin}" --rasters "${rasters[@]/%/.bin}" \
  --bent "${bent[@]/%/.bin}" --check "${checks[@]}"
