#!/usr/bin/env bash
# Installs the packages on a bare Debian 12 and runs them there; needs root, debootstrap and the network, so it is not run
# by ctest.
#   tests/packages/bare_debian.sh PACKAGES [ROOT]
#     PACKAGES  folder with the .deb files that cpack made
#     ROOT      folder of the bare system (default /tmp/limbcast-bare-debian); made where it is missing, and kept
set -euo pipefail
source "$(dirname "$0")/../../modules/usage.sh"
check_arguments 1 2 "$@"
command -v debootstrap >/dev/null || { echo "bare_debian.sh: debootstrap is missing; apt-get install debootstrap" >&2; exit 2; }
packages=$(realpath "$1")
root=${2:-/tmp/limbcast-bare-debian}
repository=$(realpath "$(dirname "$0")/../..")

[ -d "$root/etc" ] || debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian
mount --bind /proc "$root/proc"
trap 'umount "$root/proc"' EXIT
mkdir -p "$root/packages"
cp "$packages"/*.deb "$repository/logs/demo.log" "$root/packages/"
cp /etc/resolv.conf "$root/etc/"

inside() { chroot "$root" env DEBIAN_FRONTEND=noninteractive sh -euc "$1"; }

echo "== the programs run from anywhere"
inside 'apt-get update -q; apt-get install -y -q --no-install-recommends /packages/limbcast-tools_*.deb' >"$root/packages/tools.txt"
inside 'cd /var/tmp
  for program in /usr/bin/limbcast-*; do
    case $program in */limbcast-spy) continue ;; esac
    $program --version
  done
  limbcast-replay /packages/demo.log replayed.log
  limbcast-export-poses replayed.log | wc -l
  limbcast-evaluate replayed.log | head -n 12
  limbcast-viewer replayed.log --png pictures
  ls pictures | wc -l'

echo "== subscribers of one's own"
inside 'apt-get install -y -q --no-install-recommends /packages/limbcast-dev_*.deb /packages/limbcast-java_*.deb \
  g++ cmake make pkg-config default-jdk-headless' >"$root/packages/dev.txt"
inside 'rm -rf /root/examples; cp -r /usr/share/doc/limbcast-dev/examples /root/examples; cd /root/examples
  export LCM_DEFAULT_URL="udpm://239.255.76.67:7668?ttl=0&recv_buf_size=4000000"
  cmake -B build >/dev/null; cmake --build build
  g++ -std=c++17 subscriber.cpp -o subscriber $(pkg-config --cflags --libs limbcast)
  build/subscriber >cmake.txt & started=$!
  ./subscriber >pkg-config.txt & started="$started $!"
  java -Djava.net.preferIPv4Stack=true -cp /usr/share/java/lcm.jar:/usr/share/java/limbcast_types.jar Subscriber.java >java.txt & started="$started $!"
  trap "kill $started" EXIT
  # Until the slowest of them has started and heard a frame.
  until grep -q frame java.txt; do lcm-logplayer --speed=4 /var/tmp/replayed.log >/dev/null; done
  grep -c frame cmake.txt pkg-config.txt java.txt
  head -n 3 java.txt'
echo "== all done"
