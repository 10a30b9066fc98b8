# SPDX-License-Identifier: BSD-3-Clause
# Precompiled headers: the standard library, Eigen's matrices and PCL's clouds, which most
# files include, are parsed once for each kind of target instead of once a file. Sources
# still include what they use: they also compile with PCL6D_PRECOMPILED_HEADERS=OFF.
option(PCL6D_PRECOMPILED_HEADERS "Compile the headers that most files include once" ON)

# pcl6d_precompile(TARGET library|program|test): the kinds differ in position-independent
# code and in what they include.
function(pcl6d_precompile target kind)
  if(NOT PCL6D_PRECOMPILED_HEADERS)
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
  target_link_libraries(${owner} PRIVATE pcl_common Eigen3::Eigen)
  target_precompile_headers(${owner} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <iostream>
    <map> <memory> <optional> <set> <sstream> <string> <utility> <vector>
    <Eigen/Core> <Eigen/Geometry>
    <pcl/exceptions.h> <pcl/point_cloud.h> <pcl/types.h>)
  if(kind STREQUAL "library")
    set_target_properties(${owner} PROPERTIES
      POSITION_INDEPENDENT_CODE ON
      CXX_VISIBILITY_PRESET hidden
      VISIBILITY_INLINES_HIDDEN ON)
  elseif(kind STREQUAL "test")
    target_link_libraries(${owner} PRIVATE GTest::gtest)
    target_compile_options(${owner} PRIVATE -fPIC ${PCL6D_TEST_OPTIMISATION})
    target_precompile_headers(${owner} PRIVATE <gtest/gtest.h>)
  endif()
endfunction()
