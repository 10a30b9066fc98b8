# SPDX-License-Identifier: BSD-3-Clause
# Not run here: see ../README.md. The sources are those of this checkout.
get_filename_component(SOURCE_PATH ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
vcpkg_cmake_configure(SOURCE_PATH ${SOURCE_PATH}
  OPTIONS -DPCL6D_BUILD_TESTS=OFF -DPCL6D_BUILD_APPS=OFF -DPCL6D_BUILD_PYTHON=OFF -DPCL6D_MPI=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/pcl6d)
file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/debug/include)
vcpkg_install_copyright(FILE_LIST ${SOURCE_PATH}/LICENSE)
