// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A straight piece of wall in a plan, seen from above. \ingroup common */
struct Segment {
  Eigen::Vector2d a = Eigen::Vector2d::Zero(); ///< one end [m]
  Eigen::Vector2d b = Eigen::Vector2d::Zero(); ///< the second end point [m]
};

using Segments = std::vector<Segment>;

} // namespace pcl6d
