# SPDX-License-Identifier: BSD-3-Clause
# Installs, then moves the tree: what only works at the place of installation fails later.
include(${SETTINGS})
file(REMOVE_RECURSE ${prefix} ${work}/staged)
run(COMMAND ${CMAKE_COMMAND} --install ${build} --prefix ${work}/staged)
file(RENAME ${work}/staged ${prefix})

file(GLOB_RECURSE texts ${prefix}/*.cmake ${prefix}/*.h ${prefix}/*.hpp)
foreach(text IN LISTS texts)
  file(READ ${text} content)
  foreach(folder IN ITEMS ${source} ${build})
    string(FIND "${content}" "${folder}" place)
    if(NOT place EQUAL -1)
      message(FATAL_ERROR "${text} speaks of ${folder}")
    endif()
  endforeach()
endforeach()
