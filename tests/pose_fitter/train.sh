#!/bin/bash
# Fits the confidences of the refined fitter anew: simulates people and rooms without any, runs the chain on them and on
# the recordings of bodies D1 to D3, writes confidence_coefficients.inc and person_trees.inc of
# modules/pose_fitter/refined/confidence and prints how often what was told with which probability came true. Build again afterwards.
# Usage: tests/pose_fitter/train.sh SIMULATED_DIR DATA_DIR [BIN_DIR]
#   SIMULATED_DIR   12000 simulated frames, 4 GB, about half an hour on two cores; sets that are there stay
#   DATA_DIR        the folder of stereo_dev
#   BIN_DIR         default: build/release/bin
# Run it after the cost, the search, the heads' classifier or the matcher changed.
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 2 3 "$@"
cd "$(dirname "$0")/../.."
simulated=$(realpath -m "$1") data=$(realpath "$2") bin=${3:-build/release/bin}
source tests/support/simulated_sets.sh

# Directions come from people who point, also farther off than any recording, and at a desk.
simulate c_pointing pointing stereo 160 701 --max-distance-m 5.2 --child-share 0.1
simulate c_pointing2 pointing stereo 160 707 --max-distance-m 4.5
simulate c_general general stereo 80 703 --child-share 0.1
simulate c_multi multi stereo 60 704 --child-share 0.1
simulate c_near_pointing pointing stereo 120 712 --min-distance-m 0.8 --max-distance-m 2.2
simulate c_desk_pointing pointing stereo 80 713 "${desk[@]}"
simulate c_depth_pointing pointing depth 60 705 --color
# Without colours the network of poses looks at surfaces.
simulate c_dense_pointing pointing laser 120 709 --max-distance-m 5 "${dense[@]}"
simulate c_laser_pointing pointing laser 120 710 --max-distance-m 5
simulate c_colorless_pointing pointing depth 80 711 --color=false

with_truth=("${folders[@]}")
# People and what may be taken for them, before every sensor. None of these was seen by the segmenter's networks.
folders=()
simulate p_nohuman nohuman stereo 200 801
simulate p_multi multi stereo 120 802 --child-share 0.15
simulate p_sit general stereo 50 805 --posture sit
simulate p_multi2 multi stereo 100 301 --child-share 0.25
simulate p_depth_nohuman nohuman depth 120 806 --color
simulate p_depth_multi multi depth 80 807 --color --child-share 0.15
simulate p_pointing pointing stereo 80 304 --max-distance-m 5.2
simulate p_laser_nohuman nohuman laser 80 809
simulate p_dense_nohuman nohuman laser 60 814 "${dense[@]}"
simulate p_laser_nohuman2 nohuman laser 120 823
simulate p_laser_multi multi laser 60 812 --child-share 0.15
simulate p_dense_pointing pointing laser 60 810 --max-distance-m 5 "${dense[@]}"
simulate p_laser_pointing pointing laser 60 811 --max-distance-m 5
simulate p_laser_general general laser 50 813 --child-share 0.15
simulate p_depth_nohuman2 nohuman depth 150 822 --color
simulate p_nohuman2 nohuman stereo 200 821
simulate p_general general stereo 120 302 --child-share 0.3 --max-distance-m 5.2
simulate p_depth_sit general depth 60 808 --color --posture sit
simulate p_depth_pointing pointing depth 50 815 --color
simulate p_nohuman3 nohuman stereo 100 303
simulate p_nohuman4 nohuman stereo 150 831
simulate p_laser_nohuman3 nohuman laser 120 832
simulate p_colorless_nohuman nohuman depth 120 833 --color=false
simulate p_colorless_multi multi depth 60 834 --color=false --child-share 0.15
simulate p_colorless_pointing pointing depth 50 835 --color=false
# Scanners of few rings: 32 over 45, 90 and 23 degrees, in rooms and in streets, where people wear coats.
street=("${few[@]}" "${streets[@]}")
narrow=("${street[@]}" --max-elevation-deg 11.25)
simulate p_few_nohuman nohuman laser 150 841 "${few[@]}"
simulate p_few_multi multi laser 120 842 --max-distance-m 7 "${few[@]}" "${coats[@]}"
simulate p_few_pointing pointing laser 60 845 --max-distance-m 6 "${few[@]}"
simulate p_few_general general laser 80 847 --max-distance-m 7 "${few[@]}" "${coats[@]}"
simulate p_wide_nohuman nohuman laser 120 843 "${wide[@]}"
simulate p_wide_multi multi laser 120 844 --max-distance-m 5 "${wide[@]}" "${coats[@]}"
simulate p_wide_general general laser 100 846 --max-distance-m 5 "${wide[@]}" "${coats[@]}"
simulate p_street_nohuman nohuman laser 200 861 "${street[@]}"
simulate p_street_multi multi laser 80 862 --max-distance-m 9 "${street[@]}" "${coats[@]}"
simulate p_narrow_nohuman nohuman laser 200 863 "${narrow[@]}"
simulate p_narrow_multi multi laser 50 864 --min-distance-m 3 --max-distance-m 9 "${narrow[@]}" "${coats[@]}"
# Streets before scanners of more rings: over 45 degrees, 90 degrees, and a car's scanner that looks down.
simulate p_street64_nohuman nohuman laser 150 911 "${streets[@]}"
simulate p_street64_multi multi laser 60 912 --max-distance-m 8 "${streets[@]}" "${coats[@]}"
simulate p_street128_nohuman nohuman laser 150 913 "${many[@]}" "${streets[@]}"
simulate p_street128_multi multi laser 60 914 --max-distance-m 8 "${many[@]}" "${streets[@]}" "${coats[@]}"
simulate p_roof_nohuman nohuman laser 200 915 "${car_roof[@]}"
simulate p_roof_multi multi laser 80 916 --max-distance-m 9 "${car_roof[@]}" "${coats[@]}"
simulate p_roof_general general laser 60 917 --max-distance-m 9 "${car_roof[@]}" "${coats[@]}"
simulate p_street_nohuman2 nohuman laser 300 921 "${street[@]}"
simulate p_narrow_nohuman2 nohuman laser 300 922 "${narrow[@]}"
simulate p_street64_nohuman2 nohuman laser 250 923 "${streets[@]}"
simulate p_roof_nohuman2 nohuman laser 250 924 "${car_roof[@]}"
simulate p_street64_general general laser 100 925 --max-distance-m 8 "${streets[@]}" "${coats[@]}"
simulate p_roof_general2 general laser 100 926 --max-distance-m 9 "${car_roof[@]}" "${coats[@]}"
simulate p_street_general general laser 100 927 --max-distance-m 8 "${street[@]}" "${coats[@]}"
# Scanners of 16 rings, in rooms.
simulate p_sixteen_nohuman nohuman laser 150 928 "${sixteen[@]}"
simulate p_sixteen_multi multi laser 80 929 --max-distance-m 5 "${sixteen[@]}"
simulate p_sixteen_general general laser 100 930 --max-distance-m 5 "${sixteen[@]}" "${coats[@]}"
# More of what may be taken for people.
simulate p_laser_nohuman4 nohuman laser 200 871
simulate p_dense_nohuman2 nohuman laser 200 872 "${dense[@]}"
simulate p_nohuman5 nohuman stereo 200 873
# At a desk.
simulate p_near_general general stereo 160 881 "${desk[@]}"
simulate p_near_nohuman nohuman stereo 150 882 "${desk[@]}"
simulate p_near_depth general depth 80 883 --color "${desk[@]}"
simulate p_near_depth_nohuman nohuman depth 80 884 --color "${desk[@]}"
# More before scanners, where the surface alone tells people from things.
simulate p_few_pointing2 pointing laser 100 885 --max-distance-m 6 "${few[@]}"
simulate p_wide_pointing pointing laser 100 886 --max-distance-m 5 "${wide[@]}"
simulate p_few_general2 general laser 100 887 --max-distance-m 7 "${few[@]}" "${coats[@]}"
simulate p_laser_multi2 multi laser 60 888 --child-share 0.15
simulate p_dense_multi multi laser 60 889 "${dense[@]}"
simulate p_dense_nohuman3 nohuman laser 200 890 "${dense[@]}"
simulate p_laser_nohuman5 nohuman laser 200 891
simulate p_few_nohuman2 nohuman laser 150 892 "${few[@]}"
# Rooms again: each hundred more that the trees have seen leaves fewer people invented in others.
simulate p_nohuman6 nohuman stereo 300 893
simulate p_nohuman7 nohuman stereo 300 894
simulate p_depth_nohuman3 nohuman depth 150 895 --color
# Cameras in other places.
simulate p_low_general general stereo 120 901 --max-distance-m 4.5 "${low[@]}"
simulate p_low_pointing pointing stereo 80 902 --max-distance-m 4.5 "${low[@]}"
simulate p_low_nohuman nohuman stereo 150 903 "${low[@]}"
simulate p_up_general general stereo 100 904 --max-distance-m 4.5 "${up[@]}"
simulate p_up_nohuman nohuman stereo 120 905 "${up[@]}"
simulate p_high_general general stereo 100 906 --max-distance-m 4.5 "${high[@]}"
simulate p_high_nohuman nohuman stereo 120 907 "${high[@]}"
simulate p_low_depth general depth 80 908 --color --max-distance-m 4.5 "${low[@]}"
simulate p_low_depth_nohuman nohuman depth 100 909 --color "${low[@]}"
# Near a robot, where heads are above the image.
simulate p_headless_pointing pointing stereo 150 931 --head-above-share 0.6 "${near_rooms[@]}"
simulate p_headless_general general stereo 150 932 --head-above-share 0.6 "${near_rooms[@]}"
simulate p_headless_multi multi stereo 80 933 --head-above-share 0.5 "${near_rooms[@]}"
simulate p_headless_nohuman nohuman stereo 200 934 "${near_rooms[@]}"
simulate p_headless_depth general depth 120 935 --color --head-above-share 0.6 "${near_rooms[@]}"
simulate p_headless_colorless general depth 120 936 --color=false --head-above-share 0.6 "${near_rooms[@]}"
simulate p_headless_depth_nohuman nohuman depth 150 937 --color "${near_rooms[@]}"

recorded=()
for set in pointing general multi hd; do recorded+=("$data/stereo_dev/$set"); done
# Of the second sets those before dense sensors: few rings tell neither front from back nor an arm.
for set in pointing multi multi2 general depth_pointing depth_multi colorless_pointing colorless_multi dense_pointing laser_pointing; do
  with_truth+=("$simulated/p_$set")
done
"$bin/limbcast-train-confidences" modules/pose_fitter/refined/confidence/confidence_coefficients.inc "${with_truth[@]}" "${recorded[@]}"
"$bin/limbcast-train-persons" modules/pose_fitter/refined/confidence/person_trees.inc "${folders[@]}" "${recorded[@]}" \
  "$data/stereo_dev/nohuman"
