#!/usr/bin/env bash
# Builds all for arm64 on x86-64 and runs it under qemu: unit tests, and poses of a log against those of x86-64. Needs root, the
# network and a kernel of 6.7 or newer (or qemu registered with it), and takes most of an hour, so it is not run by ctest.
#   tests/arm64/cross.sh [FOLDER] [PROGRAMS]
#     FOLDER    of arm64's libraries and of what is built (default /tmp/limbcast-arm64); 4.5 GB, made where it is missing, and kept
#     PROGRAMS  folder of the programs for x86-64 (default build/release/bin)
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 0 2 "$@"
cd "$(dirname "$0")/../.."
folder=$(realpath -m "${1:-/tmp/limbcast-arm64}")
x86_64=$(realpath "${2:-build/release/bin}")
export LIMBCAST_SYSROOT=$folder/root QEMU_LD_PREFIX=$folder/root
# GStreamer's program that looks at plugins would be looked for among those of x86-64; its list stays apart from theirs.
export GST_REGISTRY_FORK=no GST_REGISTRY=$folder/gstreamer.bin

step() { printf '\n== %s (%s)\n' "$*" "$(date +%T)"; }

libraries=$LIMBCAST_SYSROOT/usr/lib/aarch64-linux-gnu
if [ ! -e "$folder/complete" ]; then
  step "compiler, qemu and libraries for arm64"
  apt-get install -y -q --no-install-recommends qemu-user-static g++-12-aarch64-linux-gnu >/dev/null
  apt=$folder/apt
  mkdir -p "$apt"/{lists,cache/archives}/partial "$LIMBCAST_SYSROOT"
  : >"$apt/status"
  cat >"$apt/apt.conf" <<END
Dir::State "$apt"; Dir::State::status "$apt/status"; Dir::Cache "$apt/cache";
APT::Architecture "arm64"; APT::Architectures { "arm64"; }; APT::Install-Recommends "false"; APT::Sandbox::User "root";
END
  # The lists of modules/install_dependencies.sh; tools are this computer's own. oneDNN is for x86-64 only, PCL for benchmarks.
  eval "$(sed -n '/^packages_.*=($/,/)$/p' modules/install_dependencies.sh)"
  names=(libc6-dev libstdc++-12-dev libgomp1)
  # shellcheck disable=SC2154 # the line above assigns them
  for name in "${packages_run[@]}" "${packages_test[@]}"; do
    case $name in libdnnl-dev | libpcl-dev) ;; *-dev | gstreamer1.0-plugins-*) names+=("$name") ;; esac
  done
  export APT_CONFIG=$apt/apt.conf
  apt-get update -q >"$folder/apt.log"
  apt-get install -y -q --download-only "${names[@]}" >>"$folder/apt.log"
  unset APT_CONFIG
  for package in "$apt"/cache/archives/*.deb; do dpkg -x "$package" "$LIMBCAST_SYSROOT"; done
  # What installing would do: links within the folder, and the choice of BLAS and LAPACK.
  find "$LIMBCAST_SYSROOT" -type l -lname '/*' | while read -r link; do
    target=$LIMBCAST_SYSROOT$(readlink "$link")
    [ ! -e "$target" ] || ln -sfn "$(realpath -m --relative-to="$(dirname "$link")" "$target")" "$link"
  done
  ln -sf blas/libblas.so.3 lapack/liblapack.so.3 "$libraries/"
  rm -r "$apt"
  touch "$folder/complete"
fi

# In a namespace of its own the kernel gives arm64's programs to qemu, and the computer's settings stay as they are.
if [ "${LIMBCAST_ARM64_RUNS:-}" != yes ]; then
  export LIMBCAST_ARM64_RUNS=yes
  [ -e /proc/sys/fs/binfmt_misc/qemu-aarch64 ] && exec "$0" "$folder" "$x86_64"
  any='\x00\x00\x00\x00\x00\x00\x00\x00' all='\xff\xff\xff\xff\xff\xff\xff\xff'
  export LIMBCAST_BINFMT=":qemu-aarch64:M::\x7fELF\x02\x01\x01\x00$any\x02\x00\xb7\x00:${all%'\xff'}\x00$all\xfe\xff\xff\xff:$(command -v qemu-aarch64-static):F"
  exec unshare --user --map-root-user --mount sh -euc 'mount -t binfmt_misc none /proc/sys/fs/binfmt_misc
    printf %s "$LIMBCAST_BINFMT" > /proc/sys/fs/binfmt_misc/register; exec "$@"' sh "$0" "$folder" "$x86_64"
fi

step "build, warnings are errors"
export PKG_CONFIG_LIBDIR=$libraries/pkgconfig:$LIMBCAST_SYSROOT/usr/share/pkgconfig PKG_CONFIG_SYSROOT_DIR=$LIMBCAST_SYSROOT
cmake --preset ci -B "$folder/build" --toolchain tests/arm64/toolchain.cmake -DLIMBCAST_BUILD_BENCHMARKS=OFF >"$folder/cmake.log"
cmake --build "$folder/build" | tail -n 1
file -b "$folder/build/bin/limbcast-replay" | cut -d, -f 1-2

step "poses"
# Exactly what x86-64 makes of the same input: clouds (by arm64, the rest by x86-64), and poses of segments (made by x86-64). In
# between are XNNPACK's networks and OpenCV, which round otherwise; what that makes of the poses is told only.
failed=0
replay() { "$1/limbcast-replay" "$2" "$3" --segmenter.portable-networks=true --log-level warning "${@:4}"; }
differences() {
  "$x86_64/limbcast-export-poses" "$2" >"$folder/$1.jsonl"
  "$x86_64/compare_poses" "$folder/x86_64.jsonl" "$folder/$1.jsonl" >"$folder/$1.txt"
  echo "$1: $(tail -n 1 "$folder/$1.txt")"
}
replay "$x86_64" logs/multi.log "$folder/x86_64.log"
"$x86_64/limbcast-export-poses" "$folder/x86_64.log" >"$folder/x86_64.jsonl"
replay "$folder/build/bin" logs/multi.log "$folder/chain.log"
replay "$x86_64" "$folder/chain.log" "$folder/clouds.log" --from clouds
replay "$folder/build/bin" "$folder/x86_64.log" "$folder/fits.log" --from segments
differences clouds "$folder/clouds.log"
differences fits "$folder/fits.log"
differences chain "$folder/chain.log"
for name in clouds fits; do grep -qx '0 differences' "$folder/$name.txt" || failed=1; done

step "unit tests"
# Without those that need more than a processor: time as it passes, networks, displays, systemd, packages, another user; nor whole
# replays, each minutes under qemu.
others='^All/|Logs/|Replay|Processes|Chain|Live|^Demo\.|ThreeHosts|ViewerWindow|Impairments|Packages|Units|Completion|Doctor|Stop|Usage'
others+='|Robot|Examples|Stalls|Unplugged|TwoCameras|PublishingStereo|^Accuracy|MayNotWrite'
ctest --test-dir "$folder/build" -j "$(nproc)" --timeout 600 -E "$others" >"$folder/tests.txt" || failed=1
grep -E 'tests passed|\((Failed|Timeout)\)' "$folder/tests.txt"
exit "$failed"
