// SPDX-License-Identifier: BSD-3-Clause
#include "dynamic/moving_stage.h"
#include "registered.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl6d::slam6d {

namespace {
/** Share of dynamic points above which every point of a scan is tested. Below, the points are a few
 * false alarms or a single object, and testing their surroundings is enough. Static scans have up
 * to 0.003. */
constexpr double kWorthAll = 0.005;

/** Fewest points of a scan, like in addScan(). */
constexpr std::size_t kLeastLeft = 3;

/** [voxels] A point this near to a dynamic reduced point may be dynamic: the point's own voxel and
 * the voxels around. */
constexpr double kAround = 3;

/** Share of the range noise. Poses that move a scan's points by less, and any two scans by less
 * than the noise, give equal results: an observer tolerates three times the noise. */
constexpr double kSamePlace = 0.5;

/** Shifts by dynamic points below this number of standard deviations of the pose are negligible. */
constexpr double kNoticedSigmas = 3;

bool
isJudge(const VerifiedScan& scan, const ScanResult& result)
{
  return isInMap(result) && !scan.abstains();
}

/** \return [m^2] mean square distance by which a change of pose moves points */
double
meanSquareMoved(const Points& points,
                const Eigen::Isometry3d& before,
                const Eigen::Isometry3d& after)
{
  if (points.empty())
    return 0;
  const Eigen::Isometry3d change = before.inverse() * after;
  double sum = 0;
  for (const Eigen::Vector3f& p : points)
    sum += (change * p.cast<double>() - p.cast<double>()).squaredNorm();
  return sum / static_cast<double>(points.size());
}
} // namespace

/** Whether the observers are unchanged and each scan is at its tested pose, within what rays can
 * detect. */
bool
MovingStage::isJudged(const std::deque<VerifiedScan>& scans,
                      const std::vector<ScanResult>& results) const
{
  if (poses_.size() != scans.size())
    return false;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const double nothing = kSamePlace * scans[i].rays().noise();
    const Points& points = scans[i].surfaces().points();
    if (scans_[i] != &scans[i] || is_judge_[i] != isJudge(scans[i], results[i]) ||
        meanSquareMoved(points, poses_[i], results[i].T_world_scan) > nothing * nothing)
      return false;
  }
  return true;
}

bool
MovingStage::classify(const std::deque<VerifiedScan>& scans, Slam6DResult& result)
{
  if (isJudged(scans, result.scans))
    return false;
  const std::size_t count = result.scans.size();
  empanel(scans, result.scans);
  motion_.assign(count, {});
  moving_.assign(count, {});
  near_.assign(count, PointTree());
  parallelFor(count, num_threads_, [&](std::size_t i) {
    const Points& points = scans[i].surfaces().points();
    motion_[i] = is_judge_[i]
                     ? moving_points_->classify(i, points)
                     : std::vector<PointMotion>(points.size(), PointMotion::kUnknown);
    for (std::size_t p = 0; p < points.size(); ++p)
      if (motion_[i][p] == PointMotion::kDynamic)
        moving_[i].push_back(points[p]);
    near_[i] = PointTree(moving_[i], num_threads_);
  });
  result.moving = MovingSummary();
  result.moving->background = moving_points_->background();
  result.moving->blind = moving_points_->isBlind();
  for (std::size_t i = 0; i < count; ++i) {
    const auto unknown =
        std::count(motion_[i].begin(), motion_[i].end(), PointMotion::kUnknown);
    result.moving->unknown += static_cast<std::size_t>(unknown);
    result.moving->evaluated += motion_[i].size();
    result.moving->moving += moving_[i].size();
  }
  return true;
}

/** Makes the scans at their poses observers of each other. */
void
MovingStage::empanel(const std::deque<VerifiedScan>& scans,
                     const std::vector<ScanResult>& results)
{
  scans_.clear();
  is_judge_.clear();
  poses_.clear();
  std::vector<SeenScan> seen(results.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const IcpModel& surfaces = scans[i].surfaces();
    scans_.push_back(&scans[i]);
    poses_.push_back(results[i].T_world_scan);
    seen[i].T_world_scan = poses_.back();
    is_judge_.push_back(isJudge(scans[i], results[i]));
    if (!is_judge_[i])
      continue;
    seen[i].rays = &scans[i].rays();
    seen[i].surface = &surfaces.points();
    seen[i].normals = &surfaces.normals();
    seen[i].tree = &surfaces.tree();
    seen[i].voxel = scans[i].voxel();
    reach_ = kAround * scans[i].voxel();
  }
  MovingPointsOptions options;
  options.num_threads = num_threads_;
  moving_points_.emplace(std::move(seen), options);
}

/** \return the share of dynamic points among the reduced points */
double
MovingStage::shareOf(std::size_t scan) const
{
  return moving_[scan].empty() ? 0
                               : static_cast<double>(moving_[scan].size()) /
                                     static_cast<double>(motion_[scan].size());
}

/** \return [m] sum of the distances between the dynamic points of a scan and another scan's
 * surface, along the normal */
double
MovingStage::sumOfPairs(std::size_t scan, std::size_t other, double max_distance) const
{
  const Eigen::Isometry3f T_other_scan =
      (poses_[other].inverse() * poses_[scan]).cast<float>();
  const IcpModel& surfaces = scans_[other]->surfaces();
  const auto reach = static_cast<float>(max_distance * max_distance);
  double sum = 0;
  for (const Eigen::Vector3f& place : moving_[scan]) {
    const Eigen::Vector3f seen = T_other_scan * place;
    const Neighbour nearest = surfaces.tree().nearest(seen, reach);
    if (nearest.index < 0)
      continue;
    const auto at = static_cast<std::size_t>(nearest.index);
    sum += std::abs(surfaces.normals()[at].dot(seen - surfaces.points()[at]));
  }
  return sum;
}

/** Dynamic points pull a scan by the mean of their distances over all its pairs, if all pull in one
 * direction. The noise of its n points fixes a scan to noise / sqrt(n / 3), as a third of them
 * fixes each direction. */
bool
MovingStage::isNoticeable(const Slam6DResult& result) const
{
  const double reach = result.parameters.max_distance.value;
  std::vector<double> wrong(scans_.size(), 0), pairs(scans_.size(), 0);
  for (const ScanLink& link : result.links) {
    const double sum =
        sumOfPairs(link.from, link.to, reach) + sumOfPairs(link.to, link.from, reach);
    const std::size_t points = motion_[link.from].size() + motion_[link.to].size();
    for (const std::size_t scan : {link.from, link.to}) {
      wrong[scan] += sum;
      pairs[scan] += link.overlap * static_cast<double>(points);
    }
  }
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const double a_third = static_cast<double>(motion_[i].size()) / 3;
    const double sigma = scans_[i]->rays().noise() / std::sqrt(a_third);
    if (wrong[i] > pairs[i] * kNoticedSigmas * sigma)
      return true;
  }
  return false;
}

std::deque<std::optional<IcpModel>>
MovingStage::still(const IcpModel::Options& model) const
{
  std::deque<std::optional<IcpModel>> still(motion_.size());
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    if (moving_[i].empty() || motion_[i].size() < moving_[i].size() + kLeastLeft)
      continue;
    Points points;
    Normals normals;
    for (std::size_t p = 0; p < motion_[i].size(); ++p)
      if (motion_[i][p] != PointMotion::kDynamic) {
        points.push_back(scans_[i]->surfaces().points()[p]);
        normals.push_back(scans_[i]->surfaces().normals()[p]);
      }
    still[i].emplace(std::move(points), std::move(normals), model);
  }
  return still;
}

std::vector<PointMotion>
MovingStage::motionOf(std::size_t scan, const Points& points) const
{
  require(
      scan < moving_.size(), "scan", scan, std::to_string(moving_.size()) + " tested");
  std::vector<PointMotion> motion(points.size(), PointMotion::kStatic);
  if (moving_[scan].empty())
    return motion;
  if (shareOf(scan) > kWorthAll)
    return moving_points_->classify(scan, points);
  const auto reach = static_cast<float>(reach_ * reach_);
  Points close;
  std::vector<std::size_t> places;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (near_[scan].hasNeighbour(points[p], reach)) {
      close.push_back(points[p]);
      places.push_back(p);
    }
  const auto evaluated = moving_points_->classify(scan, close);
  for (std::size_t k = 0; k < places.size(); ++k)
    motion[places[k]] = evaluated[k];
  return motion;
}

} // namespace pcl6d::slam6d
