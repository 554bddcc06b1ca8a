#!/usr/bin/env bash
# Replays the data with truth with one method and writes all figures (JSON) to build/accuracy/, where the poses stay too.
#   tests/accuracy/figures.sh METHOD [DATA_DIR [BODIES]]
# METHOD: paper or refined. DATA_DIR: default ../shared/data; BODIES: default D4,D5, the checking half (README.md says
# what has seen it).
# REPLAY_OPTIONS (environment): more options of limbcast-replay, as --segmenter.portable-networks=true.
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 1 3 "$@"
case $1 in paper | refined) ;; *) wrong_usage "$1: give paper or refined" ;; esac
cd "$(dirname "$0")/../.."
method=$1
data=${2:-../shared/data}
bodies=${3:-D4,D5}
bin=build/release/bin
out=build/accuracy
mkdir -p "$out"
[ -d "$data/stereo_dev" ] || { echo "figures: $data/stereo_dev is missing; give the data folder" >&2; exit 2; }

sets=(pointing general sequence multi nohuman hd rgbd_pointing laser_dev)
folder() { case $1 in rgbd_* | laser_*) echo "$data/$1" ;; *) echo "$data/stereo_dev/$1" ;; esac; }

# record SET LOG: the set as its sensor's driver publishes it
record() {
  local source
  source=$(folder "$1")
  case $1 in
    laser_*) "$bin/limbcast-laser-scanner" --source "$source" --log "$2" --log-level warning ;;
    rgbd_*) "$bin/limbcast-depth-camera" --source "$source" --calibration "$source/calibration.yml" --log "$2" --log-level warning ;;
    *) "$bin/limbcast-stereo-camera" --source "$source" --calibration "$source/calibration.yml" --log "$2" --log-level warning ;;
  esac
}

for set in "${sets[@]}"; do
  log=$out/$set.log
  [ -e "$log" ] || record "$set" "$log"
  "$bin/limbcast-replay" "$log" "$out/$set.$method.log" --pose_fitter.method="$method" ${REPLAY_OPTIONS:-} --log-level warning
  "$bin/limbcast-export-poses" "$out/$set.$method.log" >"$out/$set.$method.jsonl"
done

# score NAME BODIES SET...: figures of these sets together into NAME.METHOD.json
score() {
  local name=$1 counted=$2 truth="" set
  shift 2
  : >"$out/$name.poses"
  for set in "$@"; do
    cat "$out/$set.$method.jsonl" >>"$out/$name.poses"
    truth+=${truth:+,}$(folder "$set")
  done
  "$bin/limbcast-evaluate" --poses "$out/$name.poses" --truth "$truth" ${counted:+--bodies "$counted"} \
    --json "$out/$name.$method.json" --log-level error >"$out/$name.$method.txt"
  rm "$out/$name.poses"
}
score one_person "$bodies" pointing general sequence hd
score pointing "$bodies" pointing sequence
score natural "$bodies" general
score groups "$bodies" multi
score nobody "" nohuman
score rgbd "" rgbd_pointing
score laser_dev "" laser_dev
