#!/usr/bin/env bash
# Replays the data with truth with method=paper and method=refined and prints the table of README.md.
#   tests/accuracy/measure.sh [DATA_DIR [BODIES]]
# DATA_DIR: default ../shared/data; BODIES: default D4,D5, the checking half. All figures: see figures.sh.
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 0 2 "$@"
cd "$(dirname "$0")/../.."
out=build/accuracy
for method in paper refined; do tests/accuracy/figures.sh "$method" "$@"; done

value() {  # value NAME METHOD KEY
  jq -r --arg key "$3" '.figures[$key].value | if . == null then "-" else (. * 10 | round / 10 | tostring) end' \
    "$out/$1.$2.json"
}
row() {  # row TITLE NAME KEY PAPER'S-OWN
  echo "| $1 | $4 | $(value "$2" paper "$3") | $(value "$2" refined "$3") |"
}
# Over the people of the demo log; "-" where Google Benchmark was missing when limbcast was built.
fit_ms() {  # fit_ms CLASS
  local benchmark=build/release/bin/fitting_benchmark
  [ -x "$benchmark" ] || { echo -; return; }
  "$benchmark" --benchmark_filter="$1" --benchmark_format=json 2>/dev/null | jq '.benchmarks[0].cpu_time | round'
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
echo "| mean time to fit a person [ms of CPU] | - | $(fit_ms PaperFitter) | $(fit_ms RefinedFitter) |"
