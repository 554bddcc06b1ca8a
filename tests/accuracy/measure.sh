#!/usr/bin/env bash
# Replays the data with truth with method=paper and method=refined and prints the table of README.md.
#   tests/accuracy/measure.sh [DATA_DIR [BODIES]]
# DATA_DIR: default ../shared/data; BODIES: default D4,D5, the checking half (README.md says what has seen it).
# The poses and all figures (JSON) stay in build/accuracy/.
set -euo pipefail
cd "$(dirname "$0")/../.."
data=${1:-../shared/data}
bodies=${2:-D4,D5}
bin=build/release/bin
out=build/accuracy
mkdir -p "$out"
[ -d "$data/stereo_dev" ] || { echo "measure: $data/stereo_dev is missing; give the data folder" >&2; exit 2; }

sets=(pointing general sequence multi nohuman hd rgbd_pointing)
folder() { case $1 in rgbd_*) echo "$data/$1" ;; *) echo "$data/stereo_dev/$1" ;; esac; }

for set in "${sets[@]}"; do
  camera=stereo-camera
  [[ $set == rgbd_* ]] && camera=depth-camera
  log=$out/$set.log
  [ -e "$log" ] || "$bin/limbcast-$camera" --source "$(folder "$set")" \
    --calibration "$(folder "$set")/calibration.yml" --log "$log" --log-level warning
  for method in paper refined; do
    "$bin/limbcast-replay" "$log" "$out/$set.$method.log" --pose_fitter.method="$method" --log-level warning
    "$bin/limbcast-export-poses" "$out/$set.$method.log" >"$out/$set.$method.jsonl"
  done
done

# score NAME METHOD BODIES SET...: figures of these sets together into NAME.METHOD.json
score() {
  local name=$1 method=$2 counted=$3 truth="" set
  shift 3
  : >"$out/$name.poses"
  for set in "$@"; do
    cat "$out/$set.$method.jsonl" >>"$out/$name.poses"
    truth+=${truth:+,}$(folder "$set")
  done
  "$bin/limbcast-evaluate" --poses "$out/$name.poses" --truth "$truth" ${counted:+--bodies "$counted"} \
    --json "$out/$name.$method.json" --log-level error >"$out/$name.$method.txt"
  rm "$out/$name.poses"
}
for method in paper refined; do
  score one_person "$method" "$bodies" pointing general sequence hd
  score pointing "$method" "$bodies" pointing sequence
  score natural "$method" "$bodies" general
  score groups "$method" "$bodies" multi
  score nobody "$method" "" nohuman
  score rgbd "$method" "" rgbd_pointing
done

value() {  # value NAME METHOD KEY
  jq -r --arg key "$3" '.figures[$key].value | if . == null then "-" else (. * 10 | round / 10 | tostring) end' \
    "$out/$1.$2.json"
}
row() {  # row TITLE NAME KEY PAPER'S-OWN
  echo "| $1 | $4 | $(value "$2" paper "$3") | $(value "$2" refined "$3") |"
}
echo "| figure | the paper's own | \`paper\` | \`refined\` |"
echo "|---|---|---|---|"
row "postures right, stereo [%]" one_person pointing_right_percent 80.2
row "wrong reported, stereo [%]" one_person wrong_reported_percent 3.2
row "pointing, median [degrees]" one_person pointing_median_deg 6.8
row "pointing, p90 [degrees]" one_person pointing_p90_deg -
row "joints within 10 cm, one person [%]" one_person joints_within_10cm_percent -
row "joints within 10 cm, natural poses [%]" natural joints_within_10cm_percent -
row "mean error of joints, one person [cm]" one_person joint_error_mean_cm -
row "people found, groups [%]" groups people_found_percent -
row "joints within 10 cm, groups [%]" groups joints_within_10cm_percent -
row "poses in frames without people" nobody invented_in_empty_frames -
row "not pointing but said to [%]" one_person said_to_point_percent -
row "postures right, real depth camera [%]" rgbd pointing_right_percent -
row "pointing, real depth camera, median [degrees]" rgbd pointing_median_deg -
row "mean error of joints, real depth camera [cm]" rgbd joint_error_mean_cm -
