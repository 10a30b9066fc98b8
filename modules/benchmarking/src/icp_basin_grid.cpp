// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/icp_basin.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>

#include <cmath>

namespace pcl6d {

namespace {
void
requirePositive(const char* name, double value)
{
  require(std::isfinite(value) && value > 0, name, value, "finite and > 0");
}

void
requireSteps(const char* name, int steps)
{
  require(steps >= 1 && steps % 2 == 1,
          name,
          steps,
          "odd, so that 0 is among the offsets, and >= 1");
}

void
requireSmall(int steps_xy, int steps_yaw)
{
  constexpr double kMostStarts = 1e5; // they are kept
  const double starts = 1.0 * steps_xy * steps_xy * steps_yaw;
  require(starts <= kMostStarts,
          "steps_xy",
          steps_xy,
          "so small that there are at most 100000 starts");
}
} // namespace

void
IcpBasinOptions::validate() const
{
  requirePositive("offset_xy", offset_xy);
  require(offset_yaw > 0 && offset_yaw <= M_PI, "offset_yaw", offset_yaw, "in (0, pi]");
  requireSteps("steps_xy", steps_xy);
  requireSteps("steps_yaw", steps_yaw);
  requireSmall(steps_xy, steps_yaw);
  requirePositive("sigmas", sigmas);
  requirePositive("disagreement_sigmas", disagreement_sigmas);
  requirePositive("min_sigma_position", min_sigma_position);
  requirePositive("min_sigma_orientation", min_sigma_orientation);
  requirePositive("sigma_position", sigma_position.value_or(1));
  requirePositive("sigma_orientation", sigma_orientation.value_or(1));
  require(
      min_overlap >= 0 && min_overlap <= 1, "min_overlap", min_overlap, "in [0, 1]");
  require(max_rms_share > 0, "max_rms_share", max_rms_share, "> 0");
  require(normal_neighbours >= 3 && normal_neighbours <= 64,
          "normal_neighbours",
          normal_neighbours,
          "in [3, 64]");
  icp.validate();
}

std::vector<double>
gridValues(double offset, int steps)
{
  std::vector<double> values(static_cast<std::size_t>(steps), 0.0);
  for (int i = 0; i < steps && steps > 1; ++i) // exactly 0 and +-offset
    values[static_cast<std::size_t>(i)] = offset * (2 * i - (steps - 1)) / (steps - 1);
  return values;
}

std::vector<IcpStart>
icpStarts(const IcpBasinOptions& options)
{
  std::vector<IcpStart> starts;
  for (const double yaw : gridValues(options.offset_yaw, options.steps_yaw))
    for (const double y : gridValues(options.offset_xy, options.steps_xy))
      for (const double x : gridValues(options.offset_xy, options.steps_xy))
        starts.push_back({x, y, yaw});
  return starts;
}

Eigen::Isometry3d
perturbed(const Eigen::Isometry3d& best, const IcpStart& start)
{
  Eigen::Isometry3d pose = best;
  pose.linear() = rotationFromEuler({0, 0, start.yaw}) * best.linear();
  pose.translation() += Eigen::Vector3d(start.x, start.y, 0);
  return pose;
}

} // namespace pcl6d
