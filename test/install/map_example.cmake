# SPDX-License-Identifier: BSD-3-Clause
# From the installed simulator to a map by the example program.
include(${SETTINGS})
file(REMOVE_RECURSE ${work}/scans ${work}/map.pcd ${work}/planes_of_scan ${work}/map_of_folder)
run(COMMAND env -i ${prefix}/bin/pcl_slam6d_simulate corridor -o ${work}/scans --scans 14
  --quiet)
# The libraries that are opened when they are asked for.
run(COMMAND env -i ${prefix}/bin/pcl_slam6d ${work}/scans -o ${work}/planes --last 0 --planes
  --no-picture --force)
if(NOT EXISTS ${work}/planes/planes.json)
  message(FATAL_ERROR "--planes leaves no planes.json")
endif()
run(COMMAND env -i ${prefix}/bin/pcl_slam6d_simulate rooms -o ${work}/rooms --scans 2 --force
  --quiet)
set(example ${work}/examples_build/map_in_20_lines)
run(COMMAND ${example} ${work}/scans ${work}/map.pcd OUTPUT text
  PRINTS "13 of 13 scans matched to the first, [1-9][0-9]+ points in")

string(REGEX MATCH "[0-9]+ points" points "${text}")
string(REPLACE " points" "" points "${points}")
file(STRINGS ${work}/map.pcd header LIMIT_COUNT 11)
if(NOT header MATCHES "FIELDS x y z" OR NOT header MATCHES "POINTS ${points}")
  message(FATAL_ERROR "map.pcd has another header: ${header}")
endif()

run(COMMAND ${example} EXIT 1 PRINTS "usage: map_in_20_lines SCAN_DIR MAP.pcd")
run(COMMAND ${example} ${work}/nowhere ${work}/map.pcd EXIT 1 PRINTS "error: .*nowhere")

# The same tasks by programs and by C++: the pages of the site show these files.
set(ENV{PATH} "${prefix}/bin:$ENV{PATH}")
set(scan ${work}/scans/scan000.pcd)
run(COMMAND ${work}/examples_build/find_planes ${scan} PRINTS "^[1-9][0-9.]* m.2, [0-9]+ points, normal")
run(COMMAND ${work}/examples_build/find_planes ${work}/nowhere.pcd EXIT 1 PRINTS "error: .*nowhere")
run(COMMAND ${source}/share/examples/find_planes.sh ${scan} ${work}/planes_of_scan PRINTS "planes in")
set(pair ${scan} ${work}/scans/scan001.pcd)
run(COMMAND ${work}/examples_build/register_two_scans ${pair} PRINTS "^unique ")
run(COMMAND ${work}/examples_build/register_two_scans ${scan} EXIT 1 PRINTS "usage: register_two_scans TARGET SOURCE")
run(COMMAND ${source}/share/examples/register_two_scans.sh ${pair} PRINTS "unique")
run(COMMAND ${source}/share/examples/map_folder.sh ${work}/scans ${work}/map_of_folder)
if(NOT EXISTS ${work}/map_of_folder/report.html)
  message(FATAL_ERROR "map_folder.sh leaves no report.html")
endif()
