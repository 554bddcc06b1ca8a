#!/bin/bash
# Records the poses of logs/*.log anew after a change that was meant to change them, and shows what changed:
# every frame, person, joint and direction, and the accuracy before and after. Look at it before committing.
# Usage: tests/replay/update_golden.sh [BIN_DIR]   default: build/release/bin
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 0 1 "$@"
cd "$(dirname "$0")/../.."
bin=${1:-build/release/bin}
golden=tests/replay/golden
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$golden"

for log in logs/*.log; do
  name=$(basename "$log" .log)
  echo "== $name"
  "$bin/limbcast-replay" "$log" "$work/$name.log" --segmenter.portable-networks=true --log-level warning
  "$bin/limbcast-export-poses" "$work/$name.log" > "$work/$name.jsonl"
  if [ -e "$golden/$name.jsonl" ]; then
    "$bin/compare_poses" "$golden/$name.jsonl" "$work/$name.jsonl"
  fi
  "$bin/limbcast-evaluate" "$work/$name.log" --brief
  mv "$work/$name.jsonl" "$golden/$name.jsonl"
  rm "$work/$name.log"
done
git diff --stat -- "$golden" || true
