# SPDX-License-Identifier: BSD-3-Clause
# The target deb: Debian packages from this build tree, below deb/ in it (recipe: share/packaging/debian).

function(pcl6d_add_debs)
  find_program(PCL6D_DH dh)
  mark_as_advanced(PCL6D_DH)
  if(NOT PCL6D_DH OR NOT BUILD_SHARED_LIBS OR NOT PCL6D_BUILD_APPS OR NOT TARGET pcl6d_python)
    return() # no debhelper, or not all that is packaged
  endif()
  get_property(modules GLOBAL PROPERTY PCL6D_MODULES)
  get_property(apps GLOBAL PROPERTY PCL6D_APPS)
  get_property(late GLOBAL PROPERTY PCL6D_LATE_LIBRARIES)
  set(parts ${apps} ${late} pcl6d_python man_pages)
  foreach(module IN LISTS modules)
    list(APPEND parts pcl6d_${module})
    if(TARGET pcl6d_${module}_pcl)
      list(APPEND parts pcl6d_${module}_pcl)
    endif()
  endforeach()
  add_custom_target(deb
    COMMAND ${PROJECT_SOURCE_DIR}/cmake/make_debs.sh ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}
    USES_TERMINAL)
  add_dependencies(deb ${parts})
endfunction()
