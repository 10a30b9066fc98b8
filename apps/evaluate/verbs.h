// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/verbs.h"

namespace pcl6d::app {

constexpr const char* kEvaluate = "pcl_slam6d_evaluate"; ///< the program's name

/** \file The verbs are described in the table of pcl_slam6d_evaluate.cpp. */
int
runChanges(const Arguments& arguments);
int
runTrajectory(const Arguments& arguments);
int
runIcp(const Arguments& arguments);
int
runLengths(const Arguments& arguments);
int
runMap(const Arguments& arguments);
int
runMcl(const Arguments& arguments);
int
runPlace(const Arguments& arguments);
int
runSuite(const Arguments& arguments);
int
runVerify(const Arguments& arguments);

} // namespace pcl6d::app
