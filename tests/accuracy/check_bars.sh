#!/usr/bin/env bash
# Fails when a figure of method=refined is worse than its bar in bars.json: on the recordings of logs/, on simulated
# people before a stereo pair, and on the checking half of the data with truth where there is one.
#   tests/accuracy/check_bars.sh [DATA_DIR]
# DATA_DIR: default ../shared/data. Needs build/release/bin; prints each figure beside its bar.
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 0 1 "$@"
# Bars stand at the figures of one run, and fall by chance where numbers are rounded otherwise.
export REPLAY_OPTIONS=--segmenter.portable-networks=true
cd "$(dirname "$0")/../.."
data=${1:-../shared/data}
bin=build/release/bin
bars=$PWD/tests/accuracy/bars.json
out=build/accuracy
mkdir -p "$out"

failed=0
# check NAME: the figures in NAME.refined.json against the bars of NAME
check() {
  local key least most value
  while IFS=$'\t' read -r key least most; do
    value=$(jq -r --arg key "$key" '.figures[$key].value' "$out/$1.refined.json")
    if jq -en --argjson value "$value" --argjson least "$least" --argjson most "$most" \
      '$value != null and ($least == null or $value >= $least) and ($most == null or $value <= $most)' >/dev/null; then
      echo "ok      $1 $key: $value (at least $least, at most $most)"
    else
      echo "WORSE   $1 $key: $value (at least $least, at most $most)"
      failed=1
    fi
  done < <(jq -r --arg name "$1" '.[$name] | to_entries[] | [.key, (.value.at_least // "null"), (.value.at_most // "null")] | @tsv' "$bars")
}

# check_log NAME LOG: the figures of a recording with truth
check_log() {
  "$bin/limbcast-replay" "$2" "$out/$1.refined.log" "$REPLAY_OPTIONS" --log-level warning
  "$bin/limbcast-evaluate" "$out/$1.refined.log" --json "$out/$1.refined.json" --log-level error >"$out/$1.txt"
  check "$1"
}

# check_simulated NAME OPTION...: people as limbcast-simulate makes them, so many that one arm or joint is no coin's
# throw; their bars stand below the figures by what chance does to them.
check_simulated() {
  "$bin/limbcast-simulate" --log "$out/$1.log" --sensor stereo "${@:2}" --log-level warning
  check_log "$1" "$out/$1.log"
}

for log in logs/*.log; do check_log "$(basename "$log")" "$log"; done
check_simulated simulated_pointing --set pointing --frames 60 --seed 61002 --max-distance-m 4.5
check_simulated simulated_groups --set multi --frames 60 --seed 61003

if [ -d "$data/stereo_dev" ]; then
  tests/accuracy/figures.sh refined "$data"
  for name in one_person natural groups nobody rgbd laser_dev; do check "$name"; done
else
  echo "$data/stereo_dev is missing: only the recordings of logs/ and simulated people were checked"
fi
exit "$failed"
