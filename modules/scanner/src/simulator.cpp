// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/scanner/simulator.h>

#include <utility>

namespace pcl6d {
namespace {
// What the seed is split for, so that more scans do not change the odometry's noise.
enum Stream : std::uint64_t { kRangeStream = 1, kOdometryStream = 2 };

std::uint64_t
streamSeed(std::uint64_t seed, Stream stream)
{
  return mixBits(mixBits(seed) ^ stream);
}
} // namespace

void
SimulationOptions::validate() const
{
  require(
      num_scans >= 1 && num_scans <= 100000, "num_scans", num_scans, "in [1, 100000]");
  range.validate();
  robot.validate();
  odometry.validate();
}

Simulator::Simulator(SimulationScene scene, const SimulationOptions& options)
: caster_(std::move(scene.geometry)), options_(options)
{
  options.validate();
  if (!options_.scanner)
    options_.scanner = std::make_shared<DrivenScanner>();
  options_.range.seed = streamSeed(options.seed, kRangeStream);
  const RobotPath path(scene.waypoints, options.robot);
  T_scene_world_ = path.sensorPose(caster_, 0);
  for (int i = 0; i < options.num_scans; ++i) {
    const Eigen::Isometry3d T_scene_scan =
        path.sensorPose(caster_, path.length() * i / options.num_scans);
    truth_.poses.push_back(i == 0 ? Eigen::Isometry3d::Identity()
                                  : T_scene_world_.inverse() * T_scene_scan);
  }
  odometry_ = wheelOdometry(
      truth_, options.odometry, streamSeed(options.seed, kOdometryStream));
}

RangeScan
Simulator::rangeScan(std::size_t i) const
{
  require(i < size(), "scan", i, "below the number of scans");
  return castScan(
      caster_, *options_.scanner, T_scene_world_ * truth_.poses[i], options_.range, i);
}

pcl::PointCloud<pcl::PointXYZI>
Simulator::scan(std::size_t i) const
{
  return toPointCloud(rangeScan(i), *options_.scanner);
}

} // namespace pcl6d
