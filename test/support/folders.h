// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Written by CMake: PCL6D_BIN_DIR has the programs, PCL6D_BUILD_DIR is that of the build,
// PCL6D_SOURCE_DIR that of the sources. In a header and not on the command line of each
// compilation, as ccache would take the same test in another clone for another one.
#include "pcl6d_test_folders.h"
