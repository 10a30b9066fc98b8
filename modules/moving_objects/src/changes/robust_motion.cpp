// SPDX-License-Identifier: BSD-3-Clause
#include "robust_motion.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::moving_objects {

namespace {
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = MotionCovariance;

/** A direction with less information per pair is open, as in Localizability::kOpen. */
constexpr double kOpen = 0.01;

/** Steps of reweighting: after four steps, weights change by less than 1 %. */
constexpr int kReweightings = 5;

Vector6
jacobianOf(const PlanePair& pair, const Eigen::Vector3d& centre)
{
  Vector6 j;
  j.head<3>() = pair.normal;
  j.tail<3>() = (pair.place - centre).cross(pair.normal);
  return j;
}

/** Geman and McClure; the weight is a half at two standard deviations. */
double
weightOf(double left, double scale)
{
  const double share = left / (2 * scale);
  const double w = 1 / (1 + share * share);
  return w * w;
}

double
scaleOf(const std::vector<PlanePair>& pairs, const RobustMotion& fit)
{
  constexpr double kOfMedian = 1.4826; // of a normal distribution
  constexpr double kLeast = 1e-6;      // [m] exact points need weights, too
  std::vector<double> sizes;
  sizes.reserve(pairs.size());
  for (const PlanePair& pair : pairs)
    sizes.push_back(
        std::abs(pair.residual - jacobianOf(pair, fit.centre).dot(fit.step)));
  return std::max(kLeast, kOfMedian * upperMedian(std::move(sizes)));
}

/** Inverse and open directions of an information matrix. */
struct Directions {
  Matrix6 inverse; ///< of the information, without open directions
  Matrix6 open;    ///< covariance of the open directions
};

Directions
directionsOf(const Matrix6& H, double weights, double spread)
{
  Vector6 unit = Vector6::Ones(); // rotations as motions of the points
  unit.tail<3>().setConstant(spread > 0 ? 1 / spread : 1);
  const auto eigen =
      symmetricEigen<6>(unit.asDiagonal() * H * unit.asDiagonal() / weights);
  Vector6 inverse = Vector6::Zero(), open = Vector6::Zero();
  for (int k = 0; k < 6; ++k)
    if (eigen.values(k) < kOpen)
      open(k) = spread * spread;
    else
      inverse(k) = 1 / (eigen.values(k) * weights);
  const Matrix6 V = unit.asDiagonal() * eigen.vectors;
  return {V * inverse.asDiagonal() * V.transpose(),
          V * open.asDiagonal() * V.transpose()};
}

/** \return sum over cubes of g g^T, with the factor for few cubes */
Matrix6
clustered(const std::vector<PlanePair>& pairs, const RobustMotion& fit, double cube)
{
  VoxelNumbers cubes;
  std::vector<Vector6> gradients;
  for (const PlanePair& pair : pairs) {
    const Vector6 j = jacobianOf(pair, fit.centre);
    const double left = pair.residual - j.dot(fit.step);
    const Eigen::Vector3d place = pair.place - fit.centre;
    const auto [number, is_new] = cubes.add(voxelKey(place.cast<float>(), cube));
    if (is_new)
      gradients.emplace_back(Vector6::Zero());
    gradients[number] += weightOf(left, fit.scale) * left * j;
  }
  Matrix6 sum = Matrix6::Zero();
  for (const Vector6& gradient : gradients)
    sum += gradient * gradient.transpose();
  const auto count = static_cast<double>(gradients.size());
  return sum * (count / std::max(count - 6, 1.0));
}

double
spreadOf(const std::vector<PlanePair>& pairs, const Eigen::Vector3d& centre)
{
  double sum = 0;
  for (const PlanePair& pair : pairs)
    sum += (pair.place - centre).squaredNorm();
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}
} // namespace

Eigen::Isometry3d
RobustMotion::motion() const
{
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() = rotationFromVector(step.tail<3>());
  moved.translation() = centre + step.head<3>() - moved.linear() * centre;
  return moved;
}

MotionCovariance
RobustMotion::uncertaintyAbout(const Eigen::Vector3d& place) const
{
  Matrix6 shift = Matrix6::Identity();
  shift.topRightCorner<3, 3>() = -skew(place - centre);
  return shift * (covariance + step * step.transpose()) * shift.transpose();
}

RobustMotion
robustMotion(const std::vector<PlanePair>& pairs, double cube)
{
  constexpr std::size_t kLeastPairs = 12; // two for each direction
  RobustMotion fit;
  if (pairs.size() < kLeastPairs)
    return fit;
  fit.pairs = pairs.size();
  for (const PlanePair& pair : pairs)
    fit.centre += pair.place / static_cast<double>(pairs.size());
  const double spread = spreadOf(pairs, fit.centre);
  Directions known;
  Matrix6 H;
  for (int k = 0; k < kReweightings; ++k) {
    fit.scale = scaleOf(pairs, fit);
    H.setZero();
    Vector6 b = Vector6::Zero();
    double weights = 0;
    for (const PlanePair& pair : pairs) {
      const Vector6 j = jacobianOf(pair, fit.centre);
      const double w = weightOf(pair.residual - j.dot(fit.step), fit.scale);
      H += w * j * j.transpose();
      b += w * pair.residual * j;
      weights += w;
    }
    known = directionsOf(H, weights, spread);
    fit.step = known.inverse * b;
  }
  // Few cubes may show no error in a direction: take a tenth of the independent error.
  const Matrix6 gradients =
      clustered(pairs, fit, cube) + 0.1 * fit.scale * fit.scale * H;
  fit.covariance = known.inverse * gradients * known.inverse + known.open;
  return fit;
}

} // namespace pcl6d::moving_objects
