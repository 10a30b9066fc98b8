# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034,SC2154
# For inject.sh: a small run of each program, in a folder of its own. `old_NAME` leaves the
# result of an earlier run; `new_NAME` sets the `command` that is tried, which replaces it.
# All files but those of `fixtures` are written as out*.

cases=(slam6d simulate convert evaluate graph planes objects semantic_map render report doctor)
[ -x "$bin/pcl_slam6d_doctor" ] || cases=("${cases[@]/doctor/}")

make_fixtures() { # FOLDER: what the programs read
  "$bin/pcl_slam6d_simulate" rooms -o "$1/scans" --scans 3 --resolution 6 --quiet
  "$bin/pcl_slam6d_simulate" rooms -o "$1/others" --scans 2 --resolution 8 --seed 2 --quiet
  "$bin/pcl_slam6d" "$1/scans" -o "$1/run" --threads 1 --quiet 2>"$1/run.log" ||
    [ $? = 3 ] || { cat "$1/run.log" >&2; return 1; }
  furnished_room >"$1/room.json"
  "$bin/pcl_slam6d_simulate" "$1/room.json" -o "$1/room" --odometry exact --resolution 2 --quiet
}

furnished_room() { # a scene: a table and a chair in an empty room, seen from one place
  local models=$root/share/models
  cat <<END
{"scans": 1, "max_range": 20, "waypoints": [[-1.5, 0, 0], [0.5, 0, 0], [0.6, 0.2, 0]],
 "bodies": [{"type": "box", "centre": [0, 0, -0.1], "size": [7, 6, 0.2]},
   {"type": "box", "centre": [-3.6, 0, 1.25], "size": [0.2, 6, 2.5]},
   {"type": "box", "centre": [0, -3.1, 1.25], "size": [7, 0.2, 2.5]}],
 "objects": [
   {"class": "table", "file": "$models/table/model.ply", "position": [-0.9, -1.7, 0], "yaw": 0.3},
   {"class": "chair", "file": "$models/chair/model.ply", "position": [0.6, 1.6, 0], "yaw": 0.8}]}
END
}

old_slam6d() { "$bin/pcl_slam6d" "$fixtures/others" -o out --quiet 2>/dev/null || [ $? = 3 ]; }
new_slam6d() { command=("$bin/pcl_slam6d" "$fixtures/scans" -o out --threads 1 --quiet); }

old_simulate() { mkdir out; } # it does not write over scans
new_simulate() {
  command=("$bin/pcl_slam6d_simulate" rooms -o out --scans 2 --resolution 10 --threads 1 --quiet)
}

old_convert() { "$bin/pcl_slam6d_convert" scans "$fixtures/scans/scan001.pcd" -o out.ply --quiet >/dev/null 2>&1; }
new_convert() {
  command=("$bin/pcl_slam6d_convert" scans "$fixtures/scans/scan000.pcd" -o out.ply --quiet)
}

old_evaluate() { echo old >out.json; }
new_evaluate() {
  command=("$bin/pcl_slam6d_evaluate" trajectory "$fixtures/run/trajectory.kitti"
    "$fixtures/scans/groundtruth.txt" --json out.json)
}

old_graph() { "$bin/pcl_slam6d_graph" convert "$fixtures/run/graph.g2o" -o out.g2o >/dev/null; }
new_graph() {
  command=("$bin/pcl_slam6d_graph" optimize "$fixtures/run/graph.g2o" -o out.g2o --threads 1)
}

old_planes() { "$bin/pcl_slam6d_planes" "$fixtures/others" -o out --quiet >/dev/null; }
new_planes() {
  command=("$bin/pcl_slam6d_planes" "$fixtures/scans" -o out --threads 1 --quiet)
}

old_objects() {
  "$bin/pcl_slam6d_objects" locate "$fixtures/room" -o out --quiet \
    --model "$root/share/models/chair" --proposals clusters
}
new_objects() {
  command=("$bin/pcl_slam6d_objects" locate "$fixtures/room" -o out --threads 1 --quiet
    --model "$root/share/models/table" --proposals clusters)
}

old_semantic_map() { echo old >out.json; }
new_semantic_map() {
  command=("$bin/pcl_slam6d_semantic_map" build "$fixtures/run" -o out.json --quiet)
}

old_render() { echo old >out.png; }
new_render() {
  command=("$bin/pcl_slam6d_render" picture "$fixtures/run" -o out.png --view top --size 320x240)
}

old_report() { echo old >out.html; }
new_report() { command=("$bin/pcl_slam6d_render" report "$fixtures/run" -o out.html --quiet); }

old_doctor() { echo old >out.json; }
new_doctor() {
  command=("$bin/pcl_slam6d_doctor" "$fixtures/scans/scan000.pcd" "$fixtures/scans/scan001.pcd"
    --json out.json --quiet --time-limit 5)
}
