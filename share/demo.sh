#!/usr/bin/env bash
# From nothing to a registered 3D map: installs what is missing, builds the programs that are
# needed, simulates a robot's drive through a corridor, and registers its scans.
# usage: share/demo.sh [OUT_DIR]     (default: build/demo)
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=$(realpath -m "${1:-$root/build/demo}")
bin=$root/build/release/bin

step() { printf '\n== %s\n' "$*"; }

step "1/4 dependencies"
"$root/cmake/install_dependencies.sh"

step "2/4 build (a few minutes the first time)"
cd "$root"
cmake --preset release --log-level=WARNING
cmake --build build/release --target demo

step "3/4 sample data: a robot drives through a corridor, rooms and over a ramp"
"$bin/pcl_slam6d_simulate" corridor -o "$out/scans" --seed 1 --force

step "4/4 register the scans"
"$bin/pcl_slam6d" "$out/scans" -o "$out/map" --force --report

rms() { # position rms [m] without alignment of a trajectory against the truth, both KITTI rows
  paste -d ' ' "$1" "$out/scans/groundtruth.txt" |
    LC_ALL=C awk '{ s += ($4 - $16) ^ 2 + ($8 - $20) ^ 2 + ($12 - $24) ^ 2 } END { print sqrt(s / NR) }'
}
before=$(rms "$out/scans/odometry.txt")
after=$(rms "$out/map/trajectory.kitti")

step "done"
cat <<TEXT
poses:    $out/map/trajectory.kitti
map:      $out/map/map.pcd   (pcl_viewer $out/map/scans/*.pcd shows the scans in place)
picture:  $out/map/top_view.png
report:   $out/map/report.html   (opens in any browser, from disk)
summary:  $out/map/summary.json
your own:  $bin/pcl_slam6d SCAN_DIR -o OUT_DIR
position error (rms against the truth): $(printf '%.3f' "$before") m before, $(printf '%.3f' "$after") m after
TEXT
