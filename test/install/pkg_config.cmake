# SPDX-License-Identifier: BSD-3-Clause
# A program is compiled by the flags of pkg-config alone, from the tree that was moved.
include(${SETTINGS})
find_program(pkg_config pkg-config REQUIRED)
set(ENV{PKG_CONFIG_PATH} ${prefix}/lib/pkgconfig)
run(COMMAND ${pkg_config} --modversion pcl6d PRINTS "^${version} $")
execute_process(COMMAND ${pkg_config} --cflags --libs pcl6d
  OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
string(FIND "${flags}" "-I${prefix}/lib/pkgconfig/../../include" place)
if(place EQUAL -1)
  message(FATAL_ERROR "the headers are looked for elsewhere: ${flags}")
endif()
separate_arguments(flags UNIX_COMMAND "${flags}")
file(MAKE_DIRECTORY ${work}/pkg_config)
file(WRITE ${work}/pkg_config/main.cpp [[
#include <pcl6d/slam6d/slam6d.h>
#include <cstdio>
int
main()
{
  std::printf("%zu scans\n", pcl6d::Slam6D().result().scans.size());
}
]])
run(COMMAND ${compiler} ${work}/pkg_config/main.cpp -o ${work}/pkg_config/main ${flags}
  -Wl,-rpath,${prefix}/lib)
run(COMMAND ${work}/pkg_config/main PRINTS "^0 scans $")
