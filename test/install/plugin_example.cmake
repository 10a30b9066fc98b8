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

# The same points in polar coordinates: azimuth, elevation, range.
find_program(python python3 REQUIRED)
file(WRITE ${work}/plugin/polar.py "
import math, pathlib, sys
for file in pathlib.Path(sys.argv[1]).glob('*.xyz'):
    rows = ['azimuth,elevation,range,intensity']
    for line in file.read_text().splitlines():
        if line.startswith('#'):
            continue
        x, y, z = map(float, line.split()[:3])
        flat = math.hypot(x, y)
        rows.append('%.7f,%.7f,%.7f,1' % (math.degrees(math.atan2(y, x)),
                    math.degrees(math.atan2(z, flat)), math.hypot(flat, z)))
    file.with_suffix('.polar').write_text('\\n'.join(rows) + '\\n')
")
run(COMMAND ${python} ${work}/plugin/polar.py ${scans})

set(plugin ${work}/examples_build/libslam6d_plugin.so)
run(COMMAND env -i ${prefix}/bin/pcl_slam6d ${scans} -o ${work}/plugin/out --no-picture
  --poses ${poses} --plugin ${plugin} --format polar --metric point
  --minimiser level
  PRINTS "plug-in level scanners and polar files .*minimiser level, reader polar"
    "4 scans")
file(READ ${work}/plugin/out/summary.json summary)
foreach(pair IN ITEMS minimiser:level format:polar)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 option)
  list(GET pair 1 word)
  string(JSON value GET "${summary}" options ${option} value)
  if(NOT value STREQUAL word)
    message(FATAL_ERROR "--${option} is ${value} in the summary")
  endif()
endforeach()

file(WRITE ${scans}/scan002.polar "azimuth,elevation,range,intensity\n1,2,three,4\n")
run(COMMAND env -i ${prefix}/bin/pcl_slam6d ${scans} -o ${work}/plugin/broken --no-picture
  --poses ${poses} --plugin ${plugin} --format polar EXIT 1
  PRINTS "error: .*scan002.polar: format polar: .*line 2: expected azimuth,elevation,range,intensity")
