// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl6d::test {

constexpr const char* kSlam6d = "pcl_slam6d";
constexpr const char* kEvaluate = "pcl_slam6d_evaluate";
constexpr const char* kRender = "pcl_slam6d_render";
constexpr const char* kSimulate = "pcl_slam6d_simulate";

} // namespace pcl6d::test
