#!/bin/bash
# Trains the classifiers of heads, bodies and surfaces from nothing: simulates people for each sensor, trains on them
# and on the recordings of bodies D1 to D3, and writes head_networks.inc, body_network.inc and
# surface_network.inc of modules/segmenter/classifiers. Build again afterwards.
# Usage: tests/segmenter/train.sh SIMULATED_DIR DATA_DIR [BIN_DIR]
#   SIMULATED_DIR   3260 simulated frames, 2 GB, about half an hour on two cores; sets that are there stay
#   DATA_DIR        the folder of stereo_dev, laser_dev and rgbd_pointing
#   BIN_DIR         default: build/release/bin
# Run it after the matcher, the lattice, the template or the growing changed.
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 2 3 "$@"
cd "$(dirname "$0")/../.."
simulated=$(realpath -m "$1") data=$(realpath "$2") bin=${3:-build/release/bin}
source tests/support/simulated_sets.sh

# Pairs, matched by the reconstructor as it is.
simulate s_multi multi stereo 120 101 --child-share 0.15
simulate s_multi2 multi stereo 150 204 --child-share 0.1
simulate s_general general stereo 100 102 --child-share 0.2
simulate s_general2 general stereo 150 210 --child-share 0.15
simulate s_pointing pointing stereo 80 104 --child-share 0.1
simulate s_sequence sequence stereo 60 111
# Arms beside the head are what is hardest.
simulate s_raise1 general stereo 25 203 --posture raise1
simulate s_raise2 general stereo 30 201 --posture raise2 --child-share 0.1
simulate s_behindhead general stereo 25 202 --posture behindhead
simulate s_nohuman nohuman stereo 100 103
simulate s_nohuman2 nohuman stereo 120 205
# What other matchers would give: noise, swollen silhouettes and holes of many kinds.
simulate t_multi multi stereo-depth 120 112 --child-share 0.15
simulate t_general general stereo-depth 80 113
simulate t_nohuman nohuman stereo-depth 80 114
simulate d_multi multi depth 80 105 --child-share 0.15 --color
simulate d_multi2 multi depth 80 206 --color --max-distance-m 3.5
simulate d_general general depth 60 107 --color
simulate d_nohuman nohuman depth 60 109 --color
simulate d_nohuman2 nohuman depth 80 207 --color
# Cameras in other places.
simulate s_low_general general stereo 120 221 --max-distance-m 4.5 "${low[@]}"
simulate s_low_pointing pointing stereo 80 222 --max-distance-m 4.5 "${low[@]}"
simulate s_low_nohuman nohuman stereo 100 223 "${low[@]}"
simulate s_up_general general stereo 120 224 --max-distance-m 4.5 "${up[@]}"
simulate s_up_pointing pointing stereo 80 225 --max-distance-m 4.5 "${up[@]}"
simulate s_up_nohuman nohuman stereo 100 226 "${up[@]}"
simulate s_high_general general stereo 80 227 --max-distance-m 4.5 "${high[@]}"
simulate s_high_nohuman nohuman stereo 60 228 "${high[@]}"
simulate s_near_general general stereo 100 231 "${desk[@]}"
simulate s_near_nohuman nohuman stereo 80 232 "${desk[@]}"
simulate d_low_general general depth 60 229 --color --max-distance-m 4.5 "${low[@]}"
simulate d_up_nohuman nohuman depth 60 230 --color "${up[@]}"
simulate l_multi multi laser 60 106 --child-share 0.15
simulate l_multi2 multi laser 80 209
simulate l_general general laser 60 108
simulate l_nohuman nohuman laser 60 110
simulate l_nohuman2 nohuman laser 80 208

recorded=()
for set in general pointing multi nohuman sequence hd distorted; do recorded+=("$data/stereo_dev/$set"); done
"$bin/limbcast-train-heads" modules/segmenter/classifiers/head_networks.inc "${folders[@]}" "${recorded[@]}" \
  "$data/laser_dev" "$data/rgbd_pointing"

# What people sit on, as a depth camera and as any matcher tells it. Of the other sets those with most people.
simulate d_sit general depth 160 301 --posture sit
simulate t_sit general stereo-depth 120 302 --posture sit
bodies=()
for set in d_multi d_multi2 d_general d_sit t_sit t_multi t_general s_general s_general2 s_multi s_pointing; do
  bodies+=("$simulated/$set")
done
for set in general pointing multi hd; do bodies+=("$data/stereo_dev/$set"); done
"$bin/limbcast-train-bodies" modules/segmenter/classifiers/body_network.inc "${bodies[@]}"

# Bodies and furniture as cameras see them, whole and cut by the image's edge.
surfaces=()
for set in s_multi s_multi2 s_general s_general2 s_pointing s_nohuman s_nohuman2 t_multi t_general t_nohuman \
  d_multi d_multi2 d_general d_nohuman d_nohuman2; do
  surfaces+=("$simulated/$set")
done
for set in general pointing multi hd; do surfaces+=("$data/stereo_dev/$set"); done
"$bin/limbcast-train-surfaces" modules/segmenter/classifiers/surface_network.inc "${surfaces[@]}"
