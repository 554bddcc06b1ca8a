#!/usr/bin/env bash
# Installs the Debian 12 packages that limbcast needs; does nothing where they are there.
#   modules/install_dependencies.sh [run|test]    run (default): build and run; test: also what the tests need
set -euo pipefail
source "$(dirname "$0")/usage.sh"
check_arguments 0 1 "$@"

packages_run=(
  build-essential cmake ninja-build ccache git ca-certificates pkg-config
  liblcm-dev liblcm-bin libeigen3-dev libopencv-dev libboost-program-options-dev
  nlohmann-json3-dev libzstd-dev libturbojpeg0-dev libtbb-dev libnanoflann-dev libxnnpack-dev libdnnl-dev libpthreadpool-dev libflatbuffers-dev libgomp1 libgstreamer1.0-dev qtbase5-dev
  iproute2 procps)
packages_test=(
  libgtest-dev libgmock-dev libbenchmark-dev libpcl-dev
  clang-format clang-tidy jq
  default-jdk-headless default-jre liblcm-java libjchart2d-java junit4
  xvfb xdotool imagemagick poppler-utils
  libfaketime systemd help2man file
  gstreamer1.0-plugins-base gstreamer1.0-plugins-good)

packages=("${packages_run[@]}")
case ${1:-run} in
  run) ;;
  test) packages+=("${packages_test[@]}") ;;
  *) wrong_usage "$1: give run or test" ;;
esac

missing=()
for package in "${packages[@]}"; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "install_dependencies: not root and no sudo; as root: apt-get install ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "Installing ${#missing[@]} packages: ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
export DEBIAN_FRONTEND=noninteractive
install() {
  "${as_root[@]}" apt-get update -q >"$log" 2>&1 &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -q --no-install-recommends "${missing[@]}" >>"$log" 2>&1
}
install &
installer=$!
# apt's own output is long; a line every ten seconds shows that it goes on.
seconds=0
while kill -0 "$installer" 2>/dev/null; do
  sleep 1
  seconds=$((seconds + 1))
  [ $((seconds % 10)) -eq 0 ] && echo "  ... ${seconds} s: $(tail -n 1 "$log" | cut -c 1-80)"
done
wait "$installer" || {
  tail -n 20 "$log" >&2
  echo "install_dependencies: apt-get failed, see above" >&2
  exit 1
}
echo "Installed in ${seconds} s."
