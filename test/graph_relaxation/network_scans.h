// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/room.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/graph_relaxation/network_scan.h>

#include <deque>
#include <vector>

namespace pcl6d::test {

/** \brief Scans as members of a network, with what they refer to, and the truth. */
class NetworkScans {
public:
  void
  add(Points points, const Eigen::Isometry3d& T_world_scan)
  {
    IcpModel::Options options;
    options.normals = true;
    scans.emplace_back(models_.emplace_back(std::move(points), options));
    truth.push_back(T_world_scan);
  }

  std::vector<NetworkScan> scans;
  Poses truth; ///< T_world_scan

private:
  std::deque<IcpModel> models_;
};

/** \return poses once around in a room, the last one where the first one is */
inline Poses
ringPoses(std::size_t count)
{
  Poses poses;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn =
        2 * M_PI * static_cast<double>(i) / static_cast<double>(count - 1);
    poses.push_back(
        poseFromEuler({0.5 + 3 * std::cos(turn), 1.2 * std::sin(turn), 0.02 * turn},
                      {0.02 * std::sin(turn), 0, turn}));
  }
  return poses;
}

/** \return scans from poses in a room */
inline NetworkScans
scansFrom(const Poses& poses, const PillarRoom& room = {}, double step = 0.06)
{
  Random random(5);
  NetworkScans network;
  for (const auto& pose : poses)
    network.add(room.scan(pose, random, step), pose);
  return network;
}

/** \return the same scans in another unit */
inline NetworkScans
scaledBy(double scale, const NetworkScans& network)
{
  NetworkScans scaled;
  for (std::size_t i = 0; i < network.scans.size(); ++i) {
    Points points = network.scans[i].model().points();
    for (auto& p : points)
      p *= static_cast<float>(scale);
    Eigen::Isometry3d pose = network.truth[i];
    pose.translation() *= scale;
    scaled.add(std::move(points), pose);
  }
  return scaled;
}

/** \return a chain of poses each of whose steps is off by the same motion */
inline Poses
drifted(const Poses& truth, const Eigen::Isometry3d& drift)
{
  Poses poses{truth.front()};
  for (std::size_t i = 1; i < truth.size(); ++i)
    poses.push_back(poses.back() * truth[i - 1].inverse() * truth[i] * drift);
  return poses;
}

/** \return a pose moved by metres along the axes of the world */
inline Eigen::Isometry3d
moved(const Eigen::Isometry3d& pose, const Eigen::Vector3d& by)
{
  return Eigen::Translation3d(by) * pose;
}

/** \return the largest distance [m] of positions of two trajectories */
inline double
largestError(const Poses& a, const Poses& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i].translation() - b[i].translation()).norm());
  return largest;
}

inline Eigen::Isometry3d
shifted(double x)
{
  return poseFromEuler({x, 0, 0}, {0, 0, 0});
}

} // namespace pcl6d::test
