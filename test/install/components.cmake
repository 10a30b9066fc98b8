# SPDX-License-Identifier: BSD-3-Clause
# Every component is found, linked and loaded alone, without what only others need: VTK
# and Embree are private to their modules. Unknown ones are refused by name.
include(${SETTINGS})

foreach(module IN LISTS modules)
  set(folder ${work}/consumer_${module})
  configure(${here}/consumer ${folder} -D COMPONENTS=${module}
    -D CMAKE_DISABLE_FIND_PACKAGE_VTK=ON -D CMAKE_DISABLE_FIND_PACKAGE_embree=ON
    PRINTS "${module} found: TRUE")
  build(${folder})
  run(COMMAND ${folder}/consumer PRINTS "^ok")
endforeach()

# No more than the component and what is below it.
string(REPLACE ";" "," all "${modules}")
configure(${here}/consumer ${work}/consumer_targets
  -D COMPONENTS=registration -D MODULES=${all})
string(REGEX MATCHALL "pcl6d::[a-z0-9_]+" targets "${output}")
if(NOT targets STREQUAL "pcl6d::common;pcl6d::io;pcl6d::search;pcl6d::filters;pcl6d::visibility;pcl6d::registration")
  message(FATAL_ERROR "targets of COMPONENTS registration: ${targets}")
endif()

list(JOIN modules ", " known)
configure(${here}/consumer ${work}/consumer_unknown -D COMPONENTS=regstration EXIT 1
  PRINTS "pcl6d has no component regstration. it has: ${known}")
configure(${here}/consumer ${work}/consumer_unknown
  -D COMPONENTS=common -D OPTIONAL=regstration
  PRINTS "common found: TRUE" "regstration found: --")
