// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module slam6d. The whole chain in a class: scans and rough
 * poses in, a map with a verdict out. Left out: plugin.h, which a plug-in includes itself
 * (share/doc/plugins.md). */
#include <pcl6d/slam6d/plugins.h>
#include <pcl6d/slam6d/slam6d.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>
#include <pcl6d/slam6d/slam_stage.h>
