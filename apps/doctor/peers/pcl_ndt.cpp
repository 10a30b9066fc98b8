// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/peers/align_as_user.h"

#include <pcl/registration/ndt.h>

namespace pcl6d::app {

void
alignPclNdt(const ClassSettings& s, const ClassInput& input, ClassOutcome& out)
{
  using Point = pcl::PointXYZ;
  Counting<pcl::NormalDistributionsTransform<Point, Point>> ndt;
  if (s.resolution) {
    ndt.setResolution(static_cast<float>(*s.resolution));
    ndt.setStepSize(0.1 * *s.resolution); // PCL's default is 0.1 m for cells of 1 m
  }
  if (s.iterations)
    ndt.setMaximumIterations(*s.iterations);
  if (s.at_rest)
    ndt.setTransformationEpsilon(*s.at_rest * *s.at_rest); // compared with squares
  alignAsUser<Point>(ndt, input, out);
}

} // namespace pcl6d::app
