// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/verbs.h"

namespace pcl6d::app {

constexpr const char* kConvert = "pcl_slam6d_convert"; ///< the program's name

/** \file The verbs are described in the table of pcl_slam6d_convert.cpp. */
int
runCalibrate(const Arguments& arguments);
int
runDepth(const Arguments& arguments);
int
runInfo(const Arguments& arguments);
int
runLines(const Arguments& arguments);
int
runMap(const Arguments& arguments);
int
runPoses(const Arguments& arguments);
int
runScans(const Arguments& arguments);
int
runStereo(const Arguments& arguments);
int
runTrajectory(const Arguments& arguments);

} // namespace pcl6d::app
