# SPDX-License-Identifier: BSD-3-Clause
# Writes the DOCUMENT of the TABLE of PCL's classes (JSON: sections of rows); CHECK: only
# compares. test/pcl_classes compiles the same rows.
file(READ ${TABLE} table)

# text_of(VARIABLE OBJECT KEY): the text of a key, empty if there is none.
function(text_of variable object key)
  string(JSON text ERROR_VARIABLE none GET "${object}" ${key})
  if(none)
    set(text "")
  endif()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# code_of(VARIABLE TEXT): each name of a list with commas as code; "-" stays.
function(code_of variable text)
  if(NOT text STREQUAL "-" AND NOT text STREQUAL "")
    string(REGEX REPLACE ", ([a-z])" "`, `\\1" text "${text}") # not within <S, T>
    string(PREPEND text "`")
    string(APPEND text "`")
  endif()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

set(wanted "# Classes of PCL and their counterparts

Our class for each class of PCL, and the differences. Each derives from PCL's base class, so you can use it everywhere PCL takes the base class. The last
column names a program in [share/examples](../examples).

How: *one name* - the program compiles and runs after a change of this name only; *with setters* - other settings are
needed; *new* - PCL has no such class; *no counterpart* - take PCL's. On your own two clouds, `pcl_slam6d_doctor` shows the differences
([doctor.md](doctor.md)).

This page is made from `pcl_classes.json` by `cmake --build build/release --target pcl_classes`. The test `test_pcl_classes` compiles and
runs the same code with both names of each row with *one name*, and compares the results.
")
string(JSON sections LENGTH "${table}" sections)
math(EXPR last_section "${sections} - 1")
foreach(s RANGE ${last_section})
  string(JSON section GET "${table}" sections ${s})
  text_of(title "${section}" title)
  text_of(intro "${section}" intro)
  string(APPEND wanted "\n## ${title}\n")
  if(intro)
    string(APPEND wanted "\n${intro}\n")
  endif()
  string(APPEND wanted "\n| PCL 1.13 | ours | how | what changes | example |\n|---|---|---|---|---|\n")
  string(JSON rows LENGTH "${section}" rows)
  math(EXPR last_row "${rows} - 1")
  foreach(r RANGE ${last_row})
    string(JSON row GET "${section}" rows ${r})
    foreach(key pcl ours how changes example)
      text_of(${key} "${row}" ${key})
    endforeach()
    foreach(key pcl ours example)
      code_of(${key} "${${key}}")
    endforeach()
    string(APPEND wanted "| ${pcl} | ${ours} | ${how} | ${changes} | ${example} |\n")
  endforeach()
endforeach()

set(text "")
if(EXISTS ${DOCUMENT})
  file(READ ${DOCUMENT} text)
endif()
if(CHECK AND NOT wanted STREQUAL text)
  message(FATAL_ERROR "${DOCUMENT} is not made of ${TABLE}; "
    "cmake --build build/release --target pcl_classes writes it")
elseif(NOT wanted STREQUAL text)
  file(WRITE ${DOCUMENT} "${wanted}")
endif()
