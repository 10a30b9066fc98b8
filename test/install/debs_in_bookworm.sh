#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the packages in a fresh Debian 12, and uses each; prints the seconds of each step.
# Needs root, a network and debootstrap; not a test of ctest.
# usage: test/install/debs_in_bookworm.sh DEB_DIR ROOT    (ROOT: made by debootstrap if missing)
set -euo pipefail
debs=$(realpath "$1") root=$2
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
[ -e "$root/etc/debian_version" ] || debootstrap --variant=minbase bookworm "$root"
rm -rf "$root/debs" "$root/tests"
cp -a "$debs" "$root/debs"
cp -a "$here/../../share/packaging/debian/tests" "$root/tests"
mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT
begin=$EPOCHREALTIME

step() { # words of a command in the new system
  local before=$EPOCHREALTIME status=0
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive \
    LC_ALL=C.UTF-8 sh -c "$1" >"$root/step.log" 2>&1 || status=$?
  awk -v a="$before" -v b="$EPOCHREALTIME" -v c="$1" -v s="$status" -v t="$begin" \
    'BEGIN { printf "%7.1f s  %7.1f s since the start  exit %d  %s\n", b - a, b - t, s, c }'
  if [ "$status" != 0 ]; then
    tail -n 15 "$root/step.log"
    exit 1
  fi
}

step 'apt-get update'
begin=$EPOCHREALTIME
step 'apt-get install -y --no-install-recommends /debs/libpcl6d0.2_*.deb /debs/pcl6d-tools_*.deb xvfb libgl1-mesa-dri'
step 'rm -rf /w && mkdir /w && pcl_slam6d_simulate corridor -o /w/scans'
step 'pcl_slam6d /w/scans -o /w/map'
tail -n 6 "$root/step.log"
step 'test -s /w/map/map.pcd && test -s /w/map/top_view.png'
step 'sh /tests/map-a-folder'
step 'apt-get install -y --no-install-recommends /debs/python3-pcl6d_*.deb /debs/pcl6d-doc_*.deb'
step 'python3 -c "import pcl6d; print(pcl6d.__version__)"'
step 'sh /tests/python'
step 'apt-get install -y --no-install-recommends /debs/libpcl6d-dev_*.deb cmake make g++ pkg-config'
step 'sh /tests/outside-program'
step 'apt-get purge -y "*pcl6d*" && test ! -e /usr/bin/pcl_slam6d && test ! -e /usr/include/pcl6d'
