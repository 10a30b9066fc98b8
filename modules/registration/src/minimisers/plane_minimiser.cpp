// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/registration/plane_minimiser.h>

#include <cmath>

namespace pcl6d {

namespace {
/** Ratio of eigenvalues, squares of lengths, below which a motion counts as free. */
constexpr double kPlaneRankTolerance = 1e-12;

constexpr Named<RigidEstimate (*)(const PlaneSums&)> kPlaneMinimisers[] = {
    {planeStepByLinear, "linear"},
    {planeStepByHelix, "helix"}};

struct TwistEstimate {
  Status status = Status::kTooFewPairs;
  Twist twist = Twist::Zero(); ///< about the centroid
};

/** Pseudo-inverse, with turns scaled to the motion of the points. */
TwistEstimate
solve(const PlaneSums& sums)
{
  if (sums.count == 0)
    return {};
  if (!sums.A.allFinite() || !sums.b.allFinite() || !sums.mean_source.allFinite())
    return {Status::kDiverged};
  const double spread_sq = sums.sourceSq() / sums.weight;
  Twist unit = Twist::Ones();
  unit.tail<3>().setConstant(spread_sq > 1e-18 ? 1 / std::sqrt(spread_sq) : 1);

  const PlaneSums::Matrix scaled = unit.asDiagonal() * sums.A * unit.asDiagonal();
  const auto eigen = symmetricEigen<6>(scaled);
  const Twist rhs = eigen.vectors.transpose() * unit.cwiseProduct(sums.b);
  TwistEstimate estimate{Status::kOk};
  Twist along = Twist::Zero(); // the solution along the eigenvectors
  for (int i = 0; i < 6; ++i) {
    if (eigen.values(i) > kPlaneRankTolerance * eigen.values(5))
      along(i) = rhs(i) / eigen.values(i);
    else
      estimate.status = Status::kRankDeficient;
  }
  estimate.twist = unit.cwiseProduct(eigen.vectors * along);
  return estimate;
}

/** \param[in] motion about the centroid */
RigidEstimate
aboutCentroid(const PlaneSums& sums, Status status, const Eigen::Isometry3d& motion)
{
  RigidEstimate estimate{status, motion};
  if (status != Status::kTooFewPairs && status != Status::kDiverged)
    estimate.transform.translation() +=
        sums.mean_source - motion.linear() * sums.mean_source;
  return estimate;
}
} // namespace

RigidEstimate
planeStepByLinear(const PlaneSums& sums)
{
  const auto [status, twist] = solve(sums);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = rotationFromEuler({twist(3), twist(4), twist(5)});
  motion.translation() = twist.head<3>();
  return aboutCentroid(sums, status, motion);
}

RigidEstimate
planeStepByHelix(const PlaneSums& sums)
{
  const auto [status, twist] = solve(sums);
  return aboutCentroid(sums, status, motionFromTwist(twist));
}

std::vector<std::string>
planeMinimiserNames()
{
  return namesOf(kPlaneMinimisers);
}

PlaneMinimiser
planeMinimiserFromName(const std::string& name)
{
  return fromName(kPlaneMinimisers, "plane minimiser", name);
}

} // namespace pcl6d
