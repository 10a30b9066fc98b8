// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/global_registration/vertical.h>
#include <pcl6d/registration/icp_model.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl6d {

namespace {
/** Numbers of sampled normals; of candidates from normals; of normals for cross products. */
constexpr std::size_t kLookedAt = 2000, kTried = 60, kCrossed = 24;

/** Sines of the angles within which a normal is level or upright: for comparing directions,
 * and, with falling values, for refinement. Normals of rough surfaces and reduced points
 * scatter by 5 deg. */
constexpr double kWithin = 0.087;
constexpr double kRefining[] = {0.2, 0.13, 0.087, 0.087};

/** Share of random normals within 5 deg of a direction or of its plane: the
 * parts of a sphere's surface, 1 - cos 5 deg and sin 5 deg. */
constexpr double kChance = 0.0038 + 0.0872;

/** Cosine of the least angle between different directions: 20 deg. */
constexpr double kOther = 0.94;

/** Least share, relative to the best, of a direction that fits nearly as well. */
constexpr double kNearlyAsGood = 0.8;

/** Cosine of the largest tilt of a levelled or carried sensor: 35 deg. A direction within the
 * tilt needs this share of the best: in a narrow view of one wall, more normals lie across
 * some direction along the wall than are level or upright. The right direction has a share of
 * 0.7 to 0.8 in half of the hand-held scans of hku1, of 0.5 to 0.6 in a street and in a mine.
 * Where the choice is wrong, the alternatives contain the right direction. */
constexpr double kNearExpected = 0.82, kTakenNear = 0.5;

constexpr double kUnitLength = 2e-3;

using Directions = std::vector<Eigen::Vector3d>;

Directions
sampleOf(const Normals& normals)
{
  Directions all;
  for (const auto& n : normals)
    if (n.allFinite() && !n.isZero(0))
      all.push_back(n.cast<double>());
  const std::size_t stride = std::max<std::size_t>(1, all.size() / kLookedAt);
  Directions sample;
  for (std::size_t i = 0; i < all.size(); i += stride)
    sample.push_back(all[i]);
  return sample;
}

double
shareBy(const Eigen::Vector3d& up, const Directions& normals)
{
  const double level = std::sqrt(1 - kWithin * kWithin);
  std::size_t count = 0;
  for (const auto& n : normals) {
    const double along = std::abs(n.dot(up));
    count += along > level || along < kWithin ? 1 : 0;
  }
  return normals.empty()
             ? 0
             : static_cast<double>(count) / static_cast<double>(normals.size());
}

/** Maximises the number of upright normals across the direction, and of level normals along the
 * direction. */
Eigen::Vector3d
refined(Eigen::Vector3d up, const Directions& normals)
{
  for (const double within : kRefining) {
    const double level = std::sqrt(1 - within * within);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const auto& n : normals) {
      const double along = std::abs(n.dot(up));
      if (along > level)
        sum -= n * n.transpose();
      else if (along < within)
        sum += n * n.transpose();
    }
    Eigen::Vector3d best = symmetricEigen<3>(sum).vectors.col(0);
    if (best.dot(up) < 0)
      best = -best;
    if (best.dot(up) < kOther) // converged to another direction
      return up;
    up = best;
  }
  return up;
}

Directions
directionsToTry(const Directions& normals, const Eigen::Vector3d& expected)
{
  Directions directions = {expected};
  const std::size_t stride = std::max<std::size_t>(1, normals.size() / kTried);
  for (std::size_t i = 0; i < normals.size(); i += stride)
    directions.push_back(normals[i]);
  const std::size_t apart = std::max<std::size_t>(1, normals.size() / kCrossed);
  for (std::size_t i = 0; i < normals.size(); i += apart)
    for (std::size_t j = 0; j < i; j += apart) {
      const Eigen::Vector3d across = normals[i].cross(normals[j]);
      if (across.squaredNorm() > 0.25) // sine of 30 deg
        directions.push_back(across.normalized());
    }
  return directions;
}

struct Direction {
  Eigen::Vector3d up;
  double share;
};

bool
areNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double cosine)
{
  return std::abs(a.dot(b)) > cosine;
}

/** The best of each cluster of directions, refined. */
std::vector<Direction>
bestDirections(const Directions& tried, const Directions& normals)
{
  std::vector<Direction> all;
  for (const auto& up : tried)
    all.push_back({up, shareBy(up, normals)});
  const auto isBetter = [](const Direction& a, const Direction& b) {
    return a.share > b.share;
  };
  std::stable_sort(all.begin(), all.end(), isBetter);
  constexpr std::size_t kMost = 4;
  std::vector<Direction> best;
  const auto isNew = [&](const Eigen::Vector3d& up) {
    return std::none_of(best.begin(), best.end(), [&](const Direction& other) {
      return areNear(other.up, up, kOther);
    });
  };
  for (const auto& one : all) {
    if (best.size() == kMost)
      break;
    if (!isNew(one.up))
      continue;
    const Eigen::Vector3d up = refined(one.up, normals);
    if (isNew(up))
      best.push_back({up, shareBy(up, normals)});
  }
  std::stable_sort(best.begin(), best.end(), isBetter);
  return best;
}

void
requireUnit(const Eigen::Vector3d& v, const char* name)
{
  require(std::abs(v.norm() - 1) < kUnitLength, name, v.transpose(), "a unit vector");
}
} // namespace

VerticalEstimate
estimateVertical(const Normals& normals, const Eigen::Vector3d& expected)
{
  requireUnit(expected, "expected");
  VerticalEstimate estimate;
  estimate.up = expected;
  const Directions sample = sampleOf(normals);
  const Directions tried = directionsToTry(sample, expected);
  std::vector<Direction> best = bestDirections(tried, sample);
  if (best.front().share < 2 * kChance) // for example in a heap of leaves
    return estimate;
  Directions cone;
  for (const auto& up : tried)
    if (areNear(up, expected, kNearExpected))
      cone.push_back(up);
  const std::vector<Direction> near = bestDirections(cone, sample);
  const bool is_near =
      near.front().share > std::max(2 * kChance, kTakenNear * best.front().share);
  const Direction up = is_near ? near.front() : best.front();
  estimate.up = up.up.dot(expected) < 0 ? Eigen::Vector3d(-up.up) : up.up;
  estimate.share = up.share;
  for (const auto& other : best)
    if (other.share > kNearlyAsGood * best.front().share &&
        !areNear(other.up, up.up, kOther))
      estimate.others.push_back(other.up);
  estimate.is_sure = estimate.others.empty();
  return estimate;
}

VerticalEstimate
estimateVerticalOfScan(const Points& measured,
                       const Eigen::Vector3d& expected,
                       unsigned int num_threads)
{
  const ScanParameters parameters = deriveScanParameters({}, {measured});
  ReductionOptions reduction;
  reduction.voxel = parameters.voxel.value;
  IcpModel::Options options; // as for place recognition
  options.normals = true;
  options.neighbours = 10;
  options.normal_voxel = 3 * reduction.voxel;
  options.num_threads = num_threads;
  const Points seen =
      gateByRange(measured, parameters.min_range.value, parameters.max_range.value);
  if (seen.size() < 3)
    return estimateVertical({}, expected);
  return estimateVertical(IcpModel(reducePoints(seen, reduction), options).normals(),
                          expected);
}

Eigen::Matrix3d
uprightRotation(const Eigen::Vector3d& up)
{
  requireUnit(up, "up");
  return shortestRotation(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

} // namespace pcl6d
