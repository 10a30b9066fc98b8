// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/verbs.h"

namespace pcl6d::app {

constexpr const char* kGraph = "pcl_slam6d_graph"; ///< the program's name

/** \file The verbs are described in the table of pcl_slam6d_graph.cpp. */
int
runOptimize(const Arguments& arguments);
int
runConvert(const Arguments& arguments);
int
runInfo(const Arguments& arguments);

} // namespace pcl6d::app
