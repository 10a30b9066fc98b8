// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/verbs.h"

namespace pcl6d::app {

constexpr const char* kRender = "pcl_slam6d_render"; ///< the program's name

/** \file The verbs are described in the table of pcl_slam6d_render.cpp. */
int
runAnimation(const Arguments& arguments);
int
runPicture(const Arguments& arguments);
int
runReport(const Arguments& arguments);

} // namespace pcl6d::app
