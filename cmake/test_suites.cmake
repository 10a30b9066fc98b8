# SPDX-License-Identifier: BSD-3-Clause
# Writes FILE, which adds each test suite of the GoogleTest program PROGRAM to CTest as
# NAME.SUITE, with the test properties PROPERTIES.
# usage: cmake -D PROGRAM= -D NAME= -D FILE= -D PROPERTIES= -P test_suites.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
  OUTPUT_VARIABLE listed ERROR_VARIABLE listed_error RESULT_VARIABLE failed TIMEOUT 120)
if(failed)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests: ${failed}\n${listed}\n${listed_error}")
endif()
# A line `Suite.` or `Suite.  # TypeParam = ...`, then its tests, each after two blanks.
string(REPLACE ";" "," listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")
# All of a suite are skipped, such as without recorded data: it was not run. What failed
# would stand behind.
set(skipped "\\[  PASSED  \\] 0 tests\\.\n(\\[  SKIPPED \\] [^\n]*\n)+$")
set(code "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.( .*)?$")
    set(suite ${CMAKE_MATCH_1})
    string(APPEND code "add_test([==[${NAME}.${suite}]==] [==[${PROGRAM}]==] "
      "[==[--gtest_filter=${suite}.*]==])\n"
      "set_tests_properties([==[${NAME}.${suite}]==] PROPERTIES ${PROPERTIES} "
      "SKIP_REGULAR_EXPRESSION [==[${skipped}]==])\n")
  endif()
endforeach()
if(NOT code)
  message(FATAL_ERROR "${PROGRAM}: no test suite in\n${listed}")
endif()
file(WRITE ${FILE} "${code}")
