# SPDX-License-Identifier: BSD-3-Clause
# From the installed simulator to a map by the example program.
include(${SETTINGS})
file(REMOVE_RECURSE ${work}/scans ${work}/map.pcd)
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
