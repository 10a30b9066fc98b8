// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/peers/align_as_user.h"

#include <pcl/registration/icp.h>

namespace pcl6d::app {

namespace {
/** \return PCL's reason for stopping \param[out] at_limit whether at the iteration limit */
template <typename Criteria>
std::string
stateOf(Criteria& criteria, bool& at_limit)
{
  const auto state = criteria.getConvergenceState();
  at_limit = state == Criteria::CONVERGENCE_CRITERIA_ITERATIONS;
  switch (state) {
  case Criteria::CONVERGENCE_CRITERIA_ITERATIONS:
    return "iteration limit";
  case Criteria::CONVERGENCE_CRITERIA_TRANSFORM:
    return "small motion";
  case Criteria::CONVERGENCE_CRITERIA_ABS_MSE:
    return "error hardly changes";
  case Criteria::CONVERGENCE_CRITERIA_REL_MSE:
    return "error hardly changes, as share";
  case Criteria::CONVERGENCE_CRITERIA_NO_CORRESPONDENCES:
    return "no correspondences";
  case Criteria::CONVERGENCE_CRITERIA_FAILURE_AFTER_MAX_ITERATIONS:
    return "failure at the iteration limit";
  case Criteria::CONVERGENCE_CRITERIA_NOT_CONVERGED:
    break;
  }
  return "not converged";
}

template <typename PointT, typename Icp>
void
alignIcp(Counting<Icp>& icp,
         const ClassSettings& s,
         const ClassInput& input,
         ClassOutcome& out)
{
  if (s.max_distance)
    icp.setMaxCorrespondenceDistance(*s.max_distance);
  if (s.iterations)
    icp.setMaximumIterations(*s.iterations);
  if (s.at_rest)
    icp.setTransformationEpsilon(*s.at_rest * *s.at_rest); // squared, in PCL
  alignAsUser<PointT>(icp, input, out);
  out.state = stateOf(*icp.getConvergeCriteria(), out.at_limit);
}
} // namespace

void
alignPclIcp(const ClassSettings& settings, const ClassInput& input, ClassOutcome& out)
{
  using Point = pcl::PointXYZ;
  Counting<pcl::IterativeClosestPoint<Point, Point>> icp;
  alignIcp<Point>(icp, settings, input, out);
}

void
alignPclIcpWithNormals(const ClassSettings& settings,
                       const ClassInput& input,
                       ClassOutcome& out)
{
  using Point = pcl::PointNormal;
  Counting<pcl::IterativeClosestPointWithNormals<Point, Point>> icp;
  alignIcp<Point>(icp, settings, input, out);
}

} // namespace pcl6d::app
