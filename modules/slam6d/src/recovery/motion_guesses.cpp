// SPDX-License-Identifier: BSD-3-Clause
#include "recovery/motion_guesses.h"
#include "registered.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/vertical.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** Number of scans from which the deviation of the odometry is estimated. */
constexpr std::size_t kCorrections = 20;

/** Turns [rad] tried from the prediction. The spacing is half the basin of ICP, which is 15 to 20
 * deg about each start (book, 4.2). */
constexpr double kTurns[] = {0, 0.35, -0.35, 0.7, -0.7};

/** Rodrigues' formula, with equal bits on every machine. */
Eigen::Matrix3d
turnAbout(const Eigen::Vector3d& axis, double angle)
{
  const SinCos turn = portableSinCos(angle);
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return Eigen::Matrix3d::Identity() + turn.sin * cross +
         (1 - turn.cos) * cross * cross;
}
} // namespace

Eigen::Isometry3d
repeated(const Eigen::Isometry3d& motion, std::size_t count)
{
  Eigen::Isometry3d all = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < count; ++i)
    all = all * motion;
  return all;
}

double
deviationOfStep(const std::vector<ScanResult>& scans, std::size_t before, double least)
{
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = before; i-- > 0 && count < kCorrections;)
    if (isRegistered(scans[i]) && scans[i].state != ScanState::kFixed &&
        scans[i].recovered == RecoveredBy::kNone) {
      sum += scans[i].correction * scans[i].correction;
      ++count;
    }
  return std::max(least, count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0);
}

std::optional<MotionSinceLast>
motionSinceLast(std::size_t scan, const std::vector<ScanResult>& scans, double voxel)
{
  MotionSinceLast way;
  std::vector<std::size_t> accepted; // the last two
  for (std::size_t i = scan; i-- > 0 && accepted.size() < 2;)
    if (isRegistered(scans[i]))
      accepted.push_back(i);
  if (accepted.empty())
    return std::nullopt;
  way.last = accepted[0];
  way.steps = scan - way.last;
  way.T_world_last = scans[way.last].T_world_scan;
  way.odometry = way.T_world_last.inverse() * scans[scan].T_world_scan;
  way.carried = way.odometry;
  if (accepted.size() == 2 && accepted[0] == accepted[1] + 1)
    way.carried = repeated(scans[accepted[1]].T_world_scan.inverse() * way.T_world_last,
                           way.steps);
  way.deviation =
      deviationOfStep(scans, scan, voxel) * std::sqrt(static_cast<double>(way.steps));
  return way;
}

std::vector<Eigen::Isometry3d>
posesByMotion(const MotionSinceLast& way)
{
  Eigen::Isometry3d turned = way.carried, moved = way.odometry;
  turned.translation() = way.odometry.translation();
  moved.translation() = way.carried.translation();
  std::vector<Eigen::Isometry3d> guesses;
  for (const auto& motion : {way.odometry,
                             turned,
                             way.carried,
                             moved,
                             Eigen::Isometry3d(Eigen::Isometry3d::Identity())})
    guesses.push_back(way.T_world_last * motion);
  return guesses;
}

std::vector<Eigen::Isometry3d>
posesAround(const Eigen::Isometry3d& about, const Eigen::Vector3d& up, double by)
{
  const Eigen::Matrix3d level = uprightRotation(up).transpose(); // columns: axes
  std::vector<Eigen::Isometry3d> poses;
  for (const double turn : kTurns)
    for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      Eigen::Isometry3d pose = about;
      pose.translation() += about.linear() * level * Eigen::Vector3d(x * by, y * by, 0);
      pose.linear() = about.linear() * turnAbout(up, turn);
      poses.push_back(pose);
    }
  return poses;
}

} // namespace pcl6d::slam6d
