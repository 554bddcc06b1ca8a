#!/usr/bin/env bash
# Measures poses of simulated people before every kind of sensor, on seeds that nothing was tuned on, with networks in 32 bits, and prints
# a table: of how many what is true, a row for each set and one for all. 1300 frames, some ten minutes on two cores.
#   tests/accuracy/simulated.sh [SET...]
# SET: only these, as pairs1 or dense_groups; default all. Logs stay in build/simulated/; those that are there are not made again.
# BIN_DIR (environment): programs to measure, default build/release/bin, so that two builds can be compared on the same logs.
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
help_if_asked "$@"
cd "$(dirname "$0")/../.."
source tests/support/simulated_sets.sh
bin=${BIN_DIR:-build/release/bin}
out=build/simulated
mkdir -p "$out"

declare -A options
sets=()
# set_of NAME OPTION...: how limbcast-simulate makes it
set_of() { sets+=("$1"); options[$1]=${*:2}; }
set_of pairs1 --set pointing --sensor stereo --frames 80 --seed 61001 --max-distance-m 5.2
set_of pairs2 --set pointing --sensor stereo --frames 60 --seed 61002 --max-distance-m 4.5
set_of pairs3 --set pointing --sensor stereo --frames 80 --seed 61005 --max-distance-m 4.5
set_of pairs4 --set pointing --sensor stereo --frames 80 --seed 62001 --max-distance-m 4.5
set_of pairs5 --set pointing --sensor stereo --frames 80 --seed 62002 --max-distance-m 5.2
set_of pairs_natural1 --set general --sensor stereo --frames 60 --seed 61004 --max-distance-m 4.5
set_of pairs_natural2 --set general --sensor stereo --frames 80 --seed 62004 --max-distance-m 5
set_of pairs_groups1 --set multi --sensor stereo --frames 60 --seed 61003
set_of pairs_groups2 --set multi --sensor stereo --frames 60 --seed 61006
set_of pairs_groups3 --set multi --sensor stereo --frames 60 --seed 62003
set_of depth_color1 --set pointing --sensor depth --frames 60 --seed 61022 --color
set_of depth_color2 --set pointing --sensor depth --frames 60 --seed 62005 --color
set_of depth --set pointing --sensor depth --frames 80 --seed 61021 --color=false
set_of dense1 --set pointing --sensor laser --frames 60 --seed 61011 --max-distance-m 5 "${dense[@]}"
set_of dense2 --set pointing --sensor laser --frames 60 --seed 62011 --max-distance-m 5 "${dense[@]}"
set_of dense_groups --set multi --sensor laser --frames 60 --seed 61014 "${dense[@]}"
set_of rings64_1 --set pointing --sensor laser --frames 60 --seed 61012 --max-distance-m 5
set_of rings64_2 --set pointing --sensor laser --frames 60 --seed 62012 --max-distance-m 5
set_of rings64_groups --set multi --sensor laser --frames 50 --seed 62013
set_of rings32 --set pointing --sensor laser --frames 60 --seed 61013 --max-distance-m 6 "${few[@]}"

for set in "$@"; do [ -n "${options[$set]:-}" ] || wrong_usage "$set: there is no such set (${sets[*]})"; done
[ $# -eq 0 ] || sets=("$@")

# counts NAME FILE...: the figures of all these reports together
counts() {
  jq -rs --arg name "$1" '
    def of(key): (map(.figures[key].count) | add | tostring) + " of " + (map(.figures[key].total) | add | tostring);
    "| \($name) | " + ([of("pointing_right_percent"), of("wrong_reported_percent"), of("told_arms_off_percent"),
      of("said_to_point_percent"), of("people_found_percent"), of("joints_within_10cm_percent")] | join(" | ")) + " |"' "${@:2}"
}

echo "| set | postures right | wrong reports | told arms that are elsewhere | resting arms said to point | people found | joints within 10 cm |"
echo "|---|---|---|---|---|---|---|"
reports=()
for set in "${sets[@]}"; do
  log=$out/$set.log
  # shellcheck disable=SC2086  # words of their own
  [ -e "$log" ] || { "$bin/limbcast-simulate" --log "$log.part" ${options[$set]} --log-level warning && mv "$log.part" "$log"; }
  "$bin/limbcast-replay" "$log" "$out/$set.poses.log" --segmenter.portable-networks=true --log-level warning
  "$bin/limbcast-evaluate" "$out/$set.poses.log" --json "$out/$set.json" --log-level error >/dev/null
  counts "$set" "$out/$set.json"
  reports+=("$out/$set.json")
done
counts "all" "${reports[@]}"
