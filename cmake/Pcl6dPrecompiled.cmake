# SPDX-License-Identifier: BSD-3-Clause
# Precompiled headers: the standard library and Eigen's matrices, a second of parsing a unit; for
# tests GoogleTest and PCL's clouds as well, 4 s a unit. Sources still include what they use: they
# also compile with PCL6D_PRECOMPILED_HEADERS=OFF. g++ takes the optimisation from the header,
# whatever the target or the source asks for, so each optimisation has its own, and a source with
# options of its own must have none (SKIP_PRECOMPILE_HEADERS).
option(PCL6D_PRECOMPILED_HEADERS "Compile the headers that most sources include once" ON)

# pcl6d_precompile(TARGET hot|cool|test): hot: a library with loops over points; cool: a
# library or program that is compiled with PCL6D_COOL_OPTIMISATION; test: of pcl6d_add_test.
function(pcl6d_precompile target kind)
  # clang refuses a header whose options differ in what g++ does not mind.
  if(NOT PCL6D_PRECOMPILED_HEADERS OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    return()
  endif()
  set(owner pcl6d_precompiled_${kind})
  if(NOT TARGET ${owner})
    _pcl6d_add_precompiled(${owner} ${kind})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

function(_pcl6d_add_precompiled owner kind)
  set(source ${PROJECT_BINARY_DIR}/${owner}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Owns the precompiled header.\n")
  add_library(${owner} OBJECT ${source})
  target_compile_features(${owner} PUBLIC cxx_std_17)
  _pcl6d_compile_rules(${owner})
  target_compile_options(${owner} PRIVATE -fPIC)
  target_link_libraries(${owner} PRIVATE Eigen3::Eigen)
  set(headers
    <algorithm> <array> <charconv> <cmath> <cstdint> <filesystem> <fstream> <functional>
    <iomanip> <iostream> <limits> <map> <memory> <numeric> <optional> <set> <sstream>
    <stdexcept> <string> <string_view> <unordered_map> <utility> <vector>
    <Eigen/Core> <Eigen/Geometry>)
  if(kind STREQUAL "test")
    target_link_libraries(${owner} PRIVATE pcl_common GTest::gtest)
    list(APPEND headers
      <pcl/exceptions.h> <pcl/point_cloud.h> <pcl/types.h> <gtest/gtest.h>)
  else()
    # What libraries hide of Eigen's functions is hidden in the header.
    set_target_properties(${owner} PROPERTIES
      CXX_VISIBILITY_PRESET hidden
      VISIBILITY_INLINES_HIDDEN ON)
  endif()
  if(NOT kind STREQUAL "hot")
    target_compile_options(${owner} PRIVATE ${PCL6D_COOL_OPTIMISATION})
  endif()
  target_precompile_headers(${owner} PRIVATE ${headers})
endfunction()
