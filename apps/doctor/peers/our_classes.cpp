// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/peers/align_as_user.h"

#include <pcl6d/registration/pcl/icp6d.h>
#include <pcl6d/registration/pcl/ndt6d.h>

#include <pcl/point_types.h>

namespace pcl6d::app {

namespace {
using Point = pcl::PointXYZ;

/** Results specific to our classes, and the pose in double. */
template <typename Class>
void
takeResult(const Class& registration, ClassOutcome& out)
{
  const auto& result = registration.result();
  out.at_limit = result.stop == IcpStop::kIterationLimit;
  out.state = toString(result.stop);
  if (result.stop == IcpStop::kAtRest && !registration.hasConverged())
    out.state += std::string(", ") + toString(result.status);
  takePose(result.T_target_source.matrix(), out);
}

template <typename PointT, typename Icp>
void
alignIcp(const ClassSettings& s, const ClassInput& input, ClassOutcome& out)
{
  Counting<Icp> icp;
  icp.setNumberOfThreads(1); // as PCL's
  if (s.max_distance)
    icp.setMaxCorrespondenceDistance(*s.max_distance);
  if (s.iterations)
    icp.setMaximumIterations(*s.iterations);
  if (s.at_rest)
    icp.setMotionEpsilon(*s.at_rest, *s.at_rest / s.reach);
  alignAsUser<PointT>(icp, input, out);
  takeResult(icp, out);
}

void
alignNdt(const ClassSettings& s, const ClassInput& input, ClassOutcome& out)
{
  Counting<NDT6D<Point, Point>> ndt;
  ndt.setNumberOfThreads(1);
  if (s.resolution) {
    ndt.setResolution(static_cast<float>(*s.resolution));
    ndt.setStepSize(0.1 * *s.resolution);
  }
  if (s.iterations)
    ndt.setMaximumIterations(*s.iterations);
  if (s.at_rest)
    ndt.setTransformationEpsilon(*s.at_rest);
  alignAsUser<Point>(ndt, input, out);
  takeResult(ndt, out);
}
} // namespace

void
alignOurs(RegistrationClass method,
          const ClassSettings& settings,
          const ClassInput& input,
          ClassOutcome& out)
{
  using PointWithNormal = pcl::PointNormal;
  if (method == RegistrationClass::kIcp6d)
    alignIcp<Point, ICP6D<Point, Point>>(settings, input, out);
  else if (method == RegistrationClass::kIcp6dWithNormals)
    alignIcp<PointWithNormal, ICP6DWithNormals<PointWithNormal, PointWithNormal>>(
        settings, input, out);
  else if (method == RegistrationClass::kGicp6d)
    alignIcp<Point, GICP6D<Point, Point>>(settings, input, out);
  else
    alignNdt(settings, input, out);
}

} // namespace pcl6d::app
