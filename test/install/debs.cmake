# SPDX-License-Identifier: BSD-3-Clause
# The target deb makes the same bytes twice, and lintian finds no error in them.
include(${SETTINGS})
set(debs ${source}/cmake/make_debs.sh ${source} ${build})
run(COMMAND ${debs} OUTPUT first)
run(COMMAND ${debs} OUTPUT second)
if(NOT first STREQUAL second OR NOT first MATCHES "pcl6d-tools_${version}")
  message(FATAL_ERROR "the packages differ:\n${first}\n${second}")
endif()
file(GLOB files ${build}/deb/*.deb)
run(COMMAND lintian --allow-root --fail-on error ${files})
