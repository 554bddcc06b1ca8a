#!/bin/bash
# Fits the confidences of the refined fitter anew: simulates people and rooms without any, runs the chain on them and on
# the recordings of bodies D1 to D3, writes modules/pose_fitter/refined/confidence_coefficients.inc and prints how often
# what was told with which probability came true. Build again afterwards.
# Usage: tests/pose_fitter/train.sh SIMULATED_DIR DATA_DIR [BIN_DIR]
#   SIMULATED_DIR   660 simulated frames, 0.2 GB, about ten minutes on one core; sets that are there stay
#   DATA_DIR        the folder of stereo_dev
#   BIN_DIR         default: build/release/bin
# Run it after the cost, the search, the heads' classifier or the matcher changed.
set -euo pipefail
cd "$(dirname "$0")/../.."
simulated=$(realpath -m "${1:?SIMULATED_DIR}") data=$(realpath "${2:?DATA_DIR}") bin=${3:-build/release/bin}
source tests/support/simulated_sets.sh

# Directions come from people who point, also farther off than any recording; confidences of people from rooms too.
simulate c_pointing pointing stereo 160 701 --max-distance-m 5.2 --child-share 0.1
simulate c_pointing2 pointing stereo 160 707 --max-distance-m 4.5
simulate c_nohuman nohuman stereo 80 702
simulate c_general general stereo 80 703 --child-share 0.1
simulate c_multi multi stereo 60 704 --child-share 0.1
simulate c_depth_pointing pointing depth 60 705 --color
simulate c_depth_nohuman nohuman depth 60 706 --color

recorded=()
for set in pointing general multi hd; do recorded+=("$data/stereo_dev/$set"); done
"$bin/limbcast-train-confidences" modules/pose_fitter/refined/confidence_coefficients.inc "${folders[@]}" "${recorded[@]}"
