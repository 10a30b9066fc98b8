// SPDX-License-Identifier: BSD-3-Clause
#include "surface_directions.h"

#include <pcl6d/common/decompositions.h>

#include <cmath>

namespace pcl6d {
using verification::Matrix6;
using verification::PairExtent;
using verification::SurfacePair;

namespace {
/** \return B^-1/2: from turns with a displacement of the pairs of 1 m (rms) to turns [rad], defined
 * by localizabilityOf(). With the spread of the pairs alone, a roll about the long axis of an
 * elongated scan would count as unobserved, because its levers are short. Turns about a line of
 * pairs use a thickness of a thousandth of its length. */
Eigen::Matrix3d
unitTurns(const std::vector<SurfacePair>& pairs, const PairExtent& extent)
{
  if (!(extent.spread > 0))
    return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const SurfacePair& pair : pairs) {
    const Eigen::Vector3d lever = pair.place - extent.centroid;
    scatter += lever * lever.transpose() / static_cast<double>(pairs.size());
  }
  const auto eigen = symmetricEigen<3>(
      Eigen::Matrix3d(scatter.trace() * Eigen::Matrix3d::Identity() - scatter));
  const Eigen::Vector3d squares =
      eigen.values.cwiseMax(1e-6 * eigen.values(2)).cwiseSqrt().cwiseInverse();
  return eigen.vectors * squares.asDiagonal() * eigen.vectors.transpose();
}
} // namespace

PairExtent
verification::extentOf(const std::vector<SurfacePair>& pairs)
{
  PairExtent extent;
  const auto count = static_cast<double>(pairs.size());
  for (const SurfacePair& pair : pairs)
    extent.centroid += pair.place / count;
  double residual_sq = 0, spread_sq = 0;
  for (const SurfacePair& pair : pairs) {
    residual_sq += pair.residual * pair.residual;
    spread_sq += (pair.place - extent.centroid).squaredNorm();
  }
  extent.residual = std::sqrt(residual_sq / count);
  extent.spread = std::sqrt(spread_sq / count);
  return extent;
}

verification::FitDirections
verification::directionsOf(const std::vector<SurfacePair>& pairs,
                           const PairExtent& extent,
                           double open)
{
  Matrix6 H = Matrix6::Zero();
  Twist b = Twist::Zero();
  double count = 0;
  for (const SurfacePair& pair : pairs) {
    const Twist j = jacobianOf(pair.place, pair.normal, extent.centroid);
    H += pair.weight * j * j.transpose();
    b += pair.weight * pair.residual * j;
    count += pair.weight;
  }
  Matrix6 unit = Matrix6::Identity(); // turns as motions of the pairs
  unit.bottomRightCorner<3, 3>() = unitTurns(pairs, extent);
  const auto eigen = symmetricEigen<6>(Matrix6(unit * H * unit / count));
  FitDirections directions;
  directions.axes = unit * eigen.vectors;
  directions.mean_square = eigen.values;
  for (int k = 0; k < 6; ++k)
    directions.inverse(k) = eigen.values(k) < open ? 0 : 1 / (eigen.values(k) * count);
  directions.step = directions.inverse.cwiseProduct(directions.axes.transpose() * b);
  return directions;
}

} // namespace pcl6d
