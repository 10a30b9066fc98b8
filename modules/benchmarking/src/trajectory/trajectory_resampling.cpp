// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/trajectory_resampling.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
void
checkStamps(const std::vector<double>& stamps, const char* what)
{
  for (std::size_t i = 0; i < stamps.size(); ++i)
    require(std::isfinite(stamps[i]) && (i == 0 || stamps[i] > stamps[i - 1]),
            what,
            stamps[i],
            "finite and larger than the previous stamp");
}

Eigen::Isometry3d
between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double s)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = slerp(a.linear(), b.linear(), s);
  pose.translation() = (1 - s) * a.translation() + s * b.translation();
  return pose;
}
} // namespace

Trajectory
resample(const Trajectory& trajectory,
         const std::vector<double>& stamps,
         double max_gap)
{
  require(max_gap > 0, "max_gap", max_gap, "> 0");
  const auto& times = trajectory.stamps;
  if (times.empty() || times.size() != trajectory.poses.size())
    throw BadArgument("a trajectory without time stamps has no poses at other times");
  checkStamps(times, "stamp of the trajectory");
  checkStamps(stamps, "stamp to resample at");
  Trajectory result;
  for (const double stamp : stamps) {
    const auto next = std::lower_bound(times.begin(), times.end(), stamp);
    if (next == times.end())
      break;
    const auto i = static_cast<std::size_t>(next - times.begin());
    const bool exact = *next == stamp;
    if (!exact && (i == 0 || times[i] - times[i - 1] > max_gap))
      continue;
    result.stamps.push_back(stamp);
    result.poses.push_back(
        exact ? trajectory.poses[i]
              : between(trajectory.poses[i - 1],
                        trajectory.poses[i],
                        (stamp - times[i - 1]) / (times[i] - times[i - 1])));
  }
  return result;
}

} // namespace pcl6d
