// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module sources. Where scans come from: folders, E57 and PTX
 * files, recordings of robots, lists of files, all opened by openSource(). */
#include <pcl6d/sources/open_source.h>
