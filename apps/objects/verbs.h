// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/verbs.h"

namespace pcl6d::app {

constexpr const char* kObjects = "pcl_slam6d_objects"; ///< the program's name

/** \file The verbs; their descriptions are in the table of pcl_slam6d_objects.cpp. */
int
runLocate(const Arguments& arguments);
int
runTargets(const Arguments& arguments);
int
runTrain(const Arguments& arguments);

} // namespace pcl6d::app
