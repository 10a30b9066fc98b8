// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/peers/align_as_user.h"

#include <pcl/registration/gicp.h>

namespace pcl6d::app {

void
alignPclGicp(const ClassSettings& s, const ClassInput& input, ClassOutcome& out)
{
  using Point = pcl::PointXYZ;
  Counting<pcl::GeneralizedIterativeClosestPoint<Point, Point>> icp;
  if (s.max_distance)
    icp.setMaxCorrespondenceDistance(*s.max_distance);
  if (s.iterations)
    icp.setMaximumIterations(*s.iterations);
  if (s.at_rest) {
    icp.setTransformationEpsilon(*s.at_rest); // here not squared
    icp.setRotationEpsilon(*s.at_rest / s.reach);
  }
  alignAsUser<Point>(icp, input, out);
}

} // namespace pcl6d::app
