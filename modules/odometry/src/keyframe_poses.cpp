// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_motion.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/odometry/keyframe_poses.h>

#include <string>

namespace pcl6d {

namespace {
void
requireKeyframes(std::size_t num_sweeps,
                 const std::vector<std::size_t>& keyframes,
                 std::size_t num_corrected)
{
  require(!keyframes.empty(), "keyframes", keyframes.size(), "> 0");
  require(num_corrected == keyframes.size(),
          "corrected poses",
          num_corrected,
          "one per keyframe");
  for (std::size_t k = 0; k < keyframes.size(); ++k)
    require(keyframes[k] < num_sweeps && (k == 0 || keyframes[k] > keyframes[k - 1]),
            "keyframe",
            keyframes[k],
            "increasing, and one of " + std::to_string(num_sweeps) + " sweeps");
}

Eigen::Isometry3d
poseBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double share)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = (1 - share) * a.translation() + share * b.translation();
  pose.linear() = slerp(a.linear(), b.linear(), share);
  return pose;
}
} // namespace

std::vector<std::size_t>
keyframesAlong(const std::vector<Eigen::Isometry3d>& poses, double way, double turn)
{
  require(!poses.empty(), "poses", poses.size(), "> 0");
  require(way > 0, "way", way, "> 0");
  require(turn > 0, "turn", turn, "> 0");
  std::vector<std::size_t> keyframes = {0};
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const auto apart = distanceBetween(poses[keyframes.back()], poses[i]);
    if (apart.translation >= way || apart.rotation >= turn || i + 1 == poses.size())
      keyframes.push_back(i);
  }
  return keyframes;
}

std::vector<Eigen::Isometry3d>
posesByKeyframes(const std::vector<Eigen::Isometry3d>& tracked,
                 const std::vector<std::size_t>& keyframes,
                 const std::vector<Eigen::Isometry3d>& corrected)
{
  requireKeyframes(tracked.size(), keyframes, corrected.size());
  const auto by = [&](std::size_t key, std::size_t sweep) {
    return exactlyRigid(corrected[key] *
                        (tracked[keyframes[key]].inverse() * tracked[sweep]));
  };
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(tracked.size());
  std::size_t next = 0; // the first keyframe at or behind the sweep
  for (std::size_t sweep = 0; sweep < tracked.size(); ++sweep) {
    while (next < keyframes.size() && keyframes[next] < sweep)
      ++next;
    if (next < keyframes.size() && keyframes[next] == sweep) {
      poses.push_back(corrected[next]);
    }
    else if (next == 0 || next == keyframes.size()) {
      poses.push_back(by(next == 0 ? 0 : next - 1, sweep));
    }
    else {
      const std::size_t before = keyframes[next - 1];
      const double share = static_cast<double>(sweep - before) /
                           static_cast<double>(keyframes[next] - before);
      poses.push_back(poseBetween(by(next - 1, sweep), by(next, sweep), share));
    }
  }
  return poses;
}

} // namespace pcl6d
