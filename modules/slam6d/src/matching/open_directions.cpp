// SPDX-License-Identifier: BSD-3-Clause
#include "matching/open_directions.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace pcl6d::slam6d {

namespace {
/** Number of points that measure a motion, as for localizability. */
constexpr std::size_t kMeasuring = 3000;

/** Edge of a cube whose pairs count as one observation [max_distance]: 16 voxels, with pairs up to
 * 1.7 voxels (share/doc/trust.md, Surfaces). */
constexpr double kCubeOfPairs = 16 / 1.7;

/** Standard deviations above zero of a constraint that is measured: one pose in thousands by chance,
 * as few cubes estimate the deviation. */
constexpr double kSurely = 4;

/** \return the normal of the nearest target point, zero beyond a distance; nothing if a part has no
 * tree or no normals */
std::optional<Eigen::Vector3d>
normalNear(const IcpTarget& target, const Eigen::Vector3d& place, double max_distance)
{
  auto least_sq = static_cast<float>(max_distance * max_distance);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const IcpTargetPart& part : target) {
    if (!part.tree || !part.normals)
      return std::nullopt;
    const Neighbour near = part.tree->nearest(
        (part.T_target_part.inverse() * place).cast<float>(), least_sq);
    if (near.index < 0)
      continue;
    least_sq = near.distance_sq;
    normal = part.T_target_part.linear() *
             (*part.normals)[static_cast<std::size_t>(near.index)].cast<double>();
  }
  return normal;
}

/** Products of the cosines between a motion and both normals of pairs. */
class Products {
public:
  /** \param[in] cube [m] edge of the cubes whose pairs count as one observation */
  explicit Products(double cube) : cube_(cube) {}

  void
  add(double product, const Eigen::Vector3d& place)
  {
    const auto [number, is_new] = cubes_.add(voxelKey(place.cast<float>(), cube_));
    if (is_new)
      sums_.emplace_back(0, 0);
    sums_[number].first += product;
    sums_[number].second += 1;
    sum_ += product;
    count_ += 1;
  }

  /** \return whether the mean is too small for a constraint, and might be zero */
  bool
  isOpen() const
  {
    const double mean = sum_ / count_;
    double variance = 0; // of the sum
    for (const auto& [sum, count] : sums_)
      variance += std::pow(sum - count * mean, 2);
    return count_ > 0 && mean < Localizability::kOpen &&
           sum_ < kSurely * std::sqrt(variance);
  }

  double
  mean() const
  {
    return sum_ / count_;
  }

private:
  double cube_;
  VoxelNumbers cubes_;
  std::vector<std::pair<double, double>> sums_; ///< of each cube, and number of pairs
  double sum_ = 0, count_ = 0;
};

/** \return the products of an even selection of points with their partners; nothing if they cannot be
 * measured */
std::optional<Products>
productsOf(const Localizability& fixed,
           const IcpTarget& target,
           const IcpSource& source,
           const Eigen::Isometry3d& T_target_source,
           double max_distance)
{
  const Twist weakest = fixed.directions.col(0);
  const std::size_t stride =
      std::max<std::size_t>(1, source.points->size() / kMeasuring);
  Products products(kCubeOfPairs * max_distance);
  for (std::size_t i = stride / 2; i < source.points->size(); i += stride) {
    const Eigen::Vector3d place = T_target_source * (*source.points)[i].cast<double>();
    const Eigen::Vector3d normal =
        T_target_source.linear() * (*source.normals)[i].cast<double>();
    if (!place.allFinite() || !normal.allFinite())
      continue;
    const auto other = normalNear(target, place, max_distance);
    if (!other)
      return std::nullopt;
    if (!(normal.dot(*other) > 0))
      continue;
    const Eigen::Vector3d motion =
        weakest.head<3>() +
        Eigen::Vector3d(weakest.tail<3>()).cross(place - fixed.centroid);
    products.add(motion.dot(normal) * motion.dot(*other), place);
  }
  return products;
}
} // namespace

bool
measureWeakest(const IcpTarget& target,
               const IcpSource& source,
               double max_distance,
               IcpResult& found)
{
  if (!found.localizability || found.localizability->openDirections() > 0 ||
      !source.normals || source.normals->size() != source.points->size())
    return false;
  Localizability& fixed = *found.localizability;
  const auto products =
      productsOf(fixed, target, source, found.T_target_source, max_distance);
  if (!products || !products->isOpen())
    return false;
  fixed.eigenvalues(0) =
      std::min(fixed.eigenvalues(0), std::max(products->mean(), 0.0));
  if (found.status == Status::kOk)
    found.status = Status::kRankDeficient;
  found.covariance.reset();
  return true;
}

bool
holdOpenDirections(const Eigen::Isometry3d& predicted, IcpResult& found)
{
  if (!found.localizability)
    return false;
  if (found.localizability->openDirections() != 1)
    return false;
  const Eigen::Translation3d centre(found.localizability->centroid);
  const Eigen::Isometry3d correction =
      centre.inverse() * (found.T_target_source * predicted.inverse()) * centre;
  const PlaneSums::Matrix& directions = found.localizability->directions;
  // Shift and turn apart: along the screw of both, a turn would carry a part of the open shift
  // across.
  Twist motion;
  motion << correction.translation(), rotationVector(correction.linear());
  Twist shares = inverted<6>(directions) * motion;
  shares(0) = 0; // ascending: the open motion is the first
  motion = directions * shares;
  Eigen::Isometry3d kept(rotationFromVector(motion.tail<3>()));
  kept.pretranslate(motion.head<3>());
  found.T_target_source = centre * kept * centre.inverse() * predicted;
  found.status = Status::kRankDeficient;
  found.covariance.reset();
  return true;
}

} // namespace pcl6d::slam6d
