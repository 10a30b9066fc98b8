// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/registration/localizability.h>

#include <cmath>

namespace pcl6d {

int
Localizability::openDirections(double threshold) const
{
  return static_cast<int>((eigenvalues.array() < threshold).count());
}

namespace {
/** \return B^-1/2: maps coordinates in which the length of a motion is the rms motion
 * of the points to twists. For turns that move no point (about a line of points) the
 * line gets a thickness of a thousandth of its length. */
PlaneSums::Matrix
unitMotions(const PlaneSums& sums)
{
  const Eigen::Matrix3d turning =
      (sums.sourceSq() * Eigen::Matrix3d::Identity() - sums.scatter) / sums.weight;
  const auto eigen = symmetricEigen<3>(turning);
  const Eigen::Vector3d& squares = eigen.values;
  const double least = squares(2) > 0 ? 1e-6 * squares(2) : 1;
  PlaneSums::Matrix unit = PlaneSums::Matrix::Identity();
  unit.bottomRightCorner<3, 3>() =
      eigen.vectors * squares.cwiseMax(least).cwiseSqrt().cwiseInverse().asDiagonal() *
      eigen.vectors.transpose();
  return unit;
}
} // namespace

Localizability
localizabilityOf(const PlaneSums& sums)
{
  Localizability found;
  if (sums.count == 0 || !sums.A.allFinite() || !sums.scatter.allFinite())
    return found;
  found.centroid = sums.mean_source;
  const PlaneSums::Matrix unit = unitMotions(sums);
  const PlaneSums::Matrix scaled = unit * sums.A * unit / sums.weight;
  const auto eigen = symmetricEigen<6>(scaled);
  found.eigenvalues = eigen.values.cwiseMax(0).cwiseMin(1);
  found.directions = unit * eigen.vectors;
  return found;
}

} // namespace pcl6d
