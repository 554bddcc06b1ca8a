#!/usr/bin/env bash
# Measures what poses lose where cameras are out of adjustment, out of focus or out of the light: disturbs the pairs of two recordings
# (disturb_pairs.cpp), runs the chain on them and prints a table. Some five minutes on two cores.
#   tests/accuracy/conditions.sh [DATA_DIR [REPLAY_OPTION...]]
# DATA_DIR: default ../shared/data.
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 0 99 "$@"
cd "$(dirname "$0")/../.."
data=${1:-../shared/data}
shift || true
bin=build/release/bin
[ -d "$data/stereo_dev" ] || { echo "conditions: $data/stereo_dev is missing; give the data folder" >&2; exit 2; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# figures SET CONDITION OPTION...: writes SET.json
figures() {
  local set=$1 condition=$2
  shift 2
  "$bin/limbcast-disturb-pairs" "$data/stereo_dev/$set" "$out/pairs" "$condition"
  "$bin/limbcast-stereo-camera" --source "$out/pairs" --calibration "$out/pairs/calibration.yml" --log "$out/in.log" --log-level warning
  "$bin/limbcast-replay" "$out/in.log" "$out/out.log" --log-level warning "$@"
  "$bin/limbcast-evaluate" "$out/out.log" --json "$out/$set.json" --log-level error >"$out/text"
  rm -r "$out/pairs"
}
value() {  # value SET KEY
  jq -r --arg key "$2" '.figures[$key].value | if . == null then "-" else (. * 10 | round / 10 | tostring) end' "$out/$1.json"
}

echo "| condition | postures right [%] | wrong reported [%] | pointing, median [degrees] | people found [%] | joints within 10 cm [%] | natural poses [%] |"
echo "|---|---|---|---|---|---|---|"
for condition in $("$bin/limbcast-disturb-pairs"); do
  for set in pointing general; do figures $set "$condition" "$@"; done
  echo "| ${condition//-/ } | $(value pointing pointing_right_percent) | $(value pointing wrong_reported_percent) | $(value pointing pointing_median_deg) | $(value pointing people_found_percent) | $(value pointing joints_within_10cm_percent) | $(value general joints_within_10cm_percent) |"
done
