# SPDX-License-Identifier: BSD-3-Clause
# The library OctoMap as the target OctoMap::OctoMap: OctoMap_FOUND. Debian's package:
# liboctomap-dev.
find_path(OctoMap_INCLUDE_DIR octomap/OcTree.h)
find_library(OctoMap_LIBRARY octomap)
find_library(OctoMap_MATH_LIBRARY octomath)
mark_as_advanced(OctoMap_INCLUDE_DIR OctoMap_LIBRARY OctoMap_MATH_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OctoMap
  REQUIRED_VARS OctoMap_LIBRARY OctoMap_MATH_LIBRARY OctoMap_INCLUDE_DIR)
if(OctoMap_FOUND AND NOT TARGET OctoMap::OctoMap)
  add_library(OctoMap::OctoMap UNKNOWN IMPORTED)
  set_target_properties(OctoMap::OctoMap PROPERTIES
    IMPORTED_LOCATION ${OctoMap_LIBRARY}
    INTERFACE_LINK_LIBRARIES ${OctoMap_MATH_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${OctoMap_INCLUDE_DIR})
endif()
