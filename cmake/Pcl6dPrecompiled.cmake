# SPDX-License-Identifier: BSD-3-Clause
# A precompiled header of the tests: GoogleTest, Eigen's matrices and PCL's clouds, 4 s of parsing
# a file. Sources still include what they use: they also compile with
# PCL6D_PRECOMPILED_HEADERS=OFF. Libraries and programs have none: of several sources as one it
# saves less than a second, and g++ takes the optimisation from it, whatever the target asks for.
option(PCL6D_PRECOMPILED_HEADERS "Compile the headers that most tests include once" ON)

# pcl6d_precompile(TARGET)
function(pcl6d_precompile target)
  if(NOT PCL6D_PRECOMPILED_HEADERS)
    return()
  endif()
  set(owner pcl6d_precompiled_test)
  if(NOT TARGET ${owner})
    _pcl6d_add_precompiled(${owner})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

function(_pcl6d_add_precompiled owner)
  set(source ${PROJECT_BINARY_DIR}/${owner}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Owns the precompiled header.\n")
  add_library(${owner} OBJECT ${source})
  target_compile_features(${owner} PUBLIC cxx_std_17)
  _pcl6d_compile_rules(${owner})
  target_compile_options(${owner} PRIVATE -fPIC ${PCL6D_COOL_OPTIMISATION})
  target_link_libraries(${owner} PRIVATE pcl_common Eigen3::Eigen GTest::gtest)
  target_precompile_headers(${owner} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <iostream>
    <map> <memory> <optional> <set> <sstream> <string> <utility> <vector>
    <Eigen/Core> <Eigen/Geometry>
    <pcl/exceptions.h> <pcl/point_cloud.h> <pcl/types.h>
    <gtest/gtest.h>)
endfunction()
