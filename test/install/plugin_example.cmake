# SPDX-License-Identifier: BSD-3-Clause
# The example plug-in, built against the installed tree, in the installed program.
include(${SETTINGS})
file(REMOVE_RECURSE ${work}/plugin)
file(MAKE_DIRECTORY ${work}/plugin)
set(simulated ${work}/plugin/simulated)
set(scans ${work}/plugin/scans)
run(COMMAND env -i ${prefix}/bin/pcl_slam6d_simulate corridor -o ${simulated} --scans 40
  --quiet)
run(COMMAND env -i ${prefix}/bin/pcl_slam6d_convert scans ${simulated} -o ${scans}
  --format xyz --last 3 --quiet)
file(STRINGS ${simulated}/odometry.txt rows LIMIT_COUNT 4)
list(JOIN rows "\n" text)
set(poses ${work}/plugin/odometry.txt)
file(WRITE ${poses} "${text}\n")

# The same rows as CSV.
file(GLOB files RELATIVE ${scans} ${scans}/*.xyz)
foreach(file IN LISTS files)
  file(STRINGS ${scans}/${file} rows)
  list(TRANSFORM rows REPLACE "^([^ ]+) ([^ ]+) ([^ ]+).*" "\\1,\\2,\\3,1")
  list(JOIN rows "\n" text)
  string(REPLACE ".xyz" ".csv" file ${file})
  file(WRITE ${scans}/${file} "x,y,z,intensity\n${text}\n")
endforeach()

set(plugin ${work}/examples_build/libslam6d_plugin.so)
run(COMMAND env -i ${prefix}/bin/pcl_slam6d ${scans} -o ${work}/plugin/out --no-picture
  --poses ${poses} --plugin ${plugin} --format csv --metric point
  --minimiser level
  PRINTS "plug-in level scanners and CSV files .*minimiser level, reader csv"
    "4 scans")
file(READ ${work}/plugin/out/summary.json summary)
foreach(pair IN ITEMS minimiser:level format:csv)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 option)
  list(GET pair 1 word)
  string(JSON value GET "${summary}" options ${option} value)
  if(NOT value STREQUAL word)
    message(FATAL_ERROR "--${option} is ${value} in the summary")
  endif()
endforeach()

file(WRITE ${scans}/scan002.csv "x,y,z,intensity\n1,2,three,4\n")
run(COMMAND env -i ${prefix}/bin/pcl_slam6d ${scans} -o ${work}/plugin/broken --no-picture
  --poses ${poses} --plugin ${plugin} --format csv EXIT 1
  PRINTS "error: .*scan002.csv: format csv: .*line 2: expected x,y,z,intensity")
