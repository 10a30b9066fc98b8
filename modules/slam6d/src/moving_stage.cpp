// SPDX-License-Identifier: BSD-3-Clause
#include "moving_stage.h"
#include "registered.h"

#include <pcl6d/common/require.h>

#include <algorithm>

namespace pcl6d::slam6d {

namespace {
/** If a larger share of a scan moved, it may have moved the scan's pose: of 100 pairs one that is
 * wrong by half the distance of pairs shifts a pose by a two-hundredth of it, as noise does. */
constexpr double kNoticeable = 0.01;

/** If a larger share moved, all points of a scan are worth looking at; if less, it is a few false
 * alarms, or one thing, and what is near it is enough. Static scans have up to 0.003. */
constexpr double kWorthAll = 0.005;

/** Scans keep so many points, as addScan() asks for. */
constexpr std::size_t kLeastLeft = 3;

/** Points within so many voxels of a reduced point that moved may belong to it: its own voxel, and
 * those around it. */
constexpr double kAround = 3;

bool
isJudge(const VerifiedScan& scan, const ScanResult& result)
{
  return isRegistered(result) && !scan.abstains();
}

bool
isSame(const std::vector<Eigen::Isometry3d>& poses,
       const std::vector<ScanResult>& scans)
{
  return poses.size() == scans.size() &&
         std::equal(poses.begin(),
                    poses.end(),
                    scans.begin(),
                    [](const Eigen::Isometry3d& pose, const ScanResult& scan) {
                      return pose.matrix() == scan.T_world_scan.matrix();
                    });
}
} // namespace

bool
MovingStage::judge(const std::deque<VerifiedScan>& scans, Slam6DResult& result)
{
  if (isSame(poses_, result.scans))
    return false;
  const std::size_t count = result.scans.size();
  surfaces_.clear();
  for (const VerifiedScan& scan : scans)
    surfaces_.push_back(&scan.surfaces());
  poses_.clear();
  std::vector<SeenScan> seen(count);
  for (std::size_t i = 0; i < count; ++i) {
    poses_.push_back(result.scans[i].T_world_scan);
    seen[i].T_world_scan = poses_.back();
    if (!isJudge(scans[i], result.scans[i]))
      continue;
    seen[i].rays = &scans[i].rays();
    seen[i].surface = &surfaces_[i]->points();
    seen[i].normals = &surfaces_[i]->normals();
    seen[i].tree = &surfaces_[i]->tree();
    seen[i].voxel = scans[i].voxel();
    reach_ = kAround * scans[i].voxel();
  }
  MovingPointsOptions options;
  options.num_threads = num_threads_;
  judges_.emplace(std::move(seen), options);
  motion_.assign(count, {});
  moving_.assign(count, {});
  near_.assign(count, PointTree());
  result.moving = MovingSummary();
  result.moving->background = judges_->background();
  result.moving->blind = judges_->isBlind();
  for (std::size_t i = 0; i < count; ++i) {
    const Points& points = surfaces_[i]->points();
    motion_[i] = isJudge(scans[i], result.scans[i])
                     ? judges_->judge(i, points)
                     : std::vector<PointMotion>(points.size(), PointMotion::kUnknown);
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (motion_[i][p] == PointMotion::kDynamic)
        moving_[i].push_back(points[p]);
      result.moving->unknown += motion_[i][p] == PointMotion::kUnknown ? 1 : 0;
    }
    result.moving->judged += points.size();
    result.moving->moving += moving_[i].size();
    near_[i] = PointTree(moving_[i], num_threads_);
  }
  return true;
}

/** \return of its reduced points, those that moved */
double
MovingStage::shareOf(std::size_t scan) const
{
  return moving_[scan].empty() ? 0
                               : static_cast<double>(moving_[scan].size()) /
                                     static_cast<double>(motion_[scan].size());
}

bool
MovingStage::isNoticeable() const
{
  for (std::size_t i = 0; i < moving_.size(); ++i)
    if (shareOf(i) > kNoticeable)
      return true;
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
        points.push_back(surfaces_[i]->points()[p]);
        normals.push_back(surfaces_[i]->normals()[p]);
      }
    still[i].emplace(std::move(points), std::move(normals), model);
  }
  return still;
}

std::vector<PointMotion>
MovingStage::motionOf(std::size_t scan, const Points& points) const
{
  require(
      scan < moving_.size(), "scan", scan, std::to_string(moving_.size()) + " judged");
  std::vector<PointMotion> motion(points.size(), PointMotion::kStatic);
  if (moving_[scan].empty())
    return motion;
  if (shareOf(scan) > kWorthAll)
    return judges_->judge(scan, points);
  const auto reach = static_cast<float>(reach_ * reach_);
  Points close;
  std::vector<std::size_t> places;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (near_[scan].hasNeighbour(points[p], reach)) {
      close.push_back(points[p]);
      places.push_back(p);
    }
  const auto judged = judges_->judge(scan, close);
  for (std::size_t k = 0; k < places.size(); ++k)
    motion[places[k]] = judged[k];
  return motion;
}

} // namespace pcl6d::slam6d
