# SPDX-License-Identifier: BSD-3-Clause
# Language, folders and build-wide settings.
include(GNUInstallDirs)

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT multi_config AND NOT CMAKE_BUILD_TYPE)
  message(STATUS "No CMAKE_BUILD_TYPE given: code will be slow. Use --preset release.")
endif()

# Where no loops over points are, a fifth of the compiling buys nothing: text, files, pictures,
# programs, tests.
set(PCL6D_COOL_OPTIMISATION $<$<CONFIG:Release>:-O1>)

# So many sources at most are compiled as one, where a target does not say more: a unit takes 4 to
# 6 s before its first own function. test/build_cost.sh names the units above 40 s of processor time or 1 GB.
set(PCL6D_BATCH 12)

# g++ looks for garbage as soon as 256 MB are in use, which every file with Eigen reaches, and
# takes a tenth of its time for it. With this it begins at 1.6 x 480 = 768 MB, and looks again when
# 1.6 times of what was left is in use, so that a unit stays below 1 GB.
set(PCL6D_FEWER_COLLECTIONS "")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(PCL6D_FEWER_COLLECTIONS
    "SHELL:--param ggc-min-heapsize=491520" "SHELL:--param ggc-min-expand=60")
endif()

# Programs stand together, so that a user finds them and they find their libraries.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR};$ORIGIN")

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # What a precompiled header defines is part of it, and its time is not its content. What one
  # clone has compiled another one need not: paths count from the folder of the sources.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${CCACHE_PROGRAM})
endif()
