#!/usr/bin/env bash
# Fetches pose_landmark_full.tflite again, from npm (Debian 12's). Not run by the build.
#   modules/segmenter/models/fetch.sh [FILE]    FILE: what is written (default: the one beside this script)
set -euo pipefail
here=$(realpath "$(dirname "$0")")
out=$(realpath "${1:-$here/pose_landmark_full.tflite}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cd "$work"
archive=$(npm pack --silent @mediapipe/pose@0.5.1675469404)
tar -xf "$archive" package/pose_landmark_full.tflite
sha256sum --check --quiet <<<"e9a5c5cb17f736fafd4c2ec1da3b3d331d6edbe8a0d32395855aeb2cdfd64b9f  package/pose_landmark_full.tflite"
install -m 644 package/pose_landmark_full.tflite "$out"
sha256sum "$out"
