// SPDX-License-Identifier: BSD-3-Clause
// Shows: code that was written for pcl::registration::ELCH gets pcl6d::ELCH by changing one
// class name. Nine scans on a round through a room, the last where the first was; their
// poses have drifted, and the room is 300 m from the origin of the world.
#include "synthetic.h"

#include <pcl6d/graph_relaxation/pcl/elch.h>

#include <pcl/common/transforms.h>
#include <pcl/registration/elch.h>

#include <cstdio>
#include <vector>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
constexpr int kScans = 9;

// The code that was there before: the motions that correct the clouds, read from the graph.
template <typename Elch>
std::vector<Eigen::Isometry3d>
closeLoop(Elch& elch, const std::vector<Cloud::Ptr>& clouds)
{
  for (const auto& cloud : clouds)
    elch.addPointCloud(cloud);
  elch.setLoopStart(0);
  elch.setLoopEnd(clouds.size() - 1);
  elch.getReg()->setMaxCorrespondenceDistance(1.0); // [m]
  elch.getReg()->setMaximumIterations(200);
  elch.compute();
  std::vector<Eigen::Isometry3d> corrections;
  for (std::size_t i = 0; i < clouds.size(); ++i)
    corrections.emplace_back(
        (*elch.getLoopGraph())[i].transform.matrix().template cast<double>());
  return corrections;
}

// How far the scans are from where they were taken [m], the worst of them.
double
worstError(const std::vector<Eigen::Isometry3d>& corrections,
           const std::vector<Eigen::Isometry3d>& poses,
           const std::vector<Eigen::Isometry3d>& truth)
{
  double worst = 0;
  for (std::size_t i = 0; i < poses.size(); ++i)
    worst = std::max(
        worst, pcl6d::distanceBetween(truth[i], corrections[i] * poses[i]).translation);
  return worst;
}

int
main()
{
  std::vector<Eigen::Isometry3d> truth, poses; // T_world_scan
  std::vector<Cloud::Ptr> clouds, copies;      // PCL's class changes what it is given
  for (int i = 0; i < kScans; ++i) {
    const double turn = 2 * M_PI * i / (kScans - 1);
    const Eigen::Isometry3d in_room = pcl6d::poseFromEuler(
        {1 + 1.5 * std::cos(turn), 1.2 * std::sin(turn), 0}, {0, 0, 0.02 * i});
    Eigen::Isometry3d drift =
        pcl6d::poseFromEuler({0.03 * i, -0.02 * i, 0.01 * i}, {0, 0, 0.008 * i});
    truth.push_back(Eigen::Translation3d(300, 0, 0) * in_room);
    poses.push_back(truth.back() * drift);
    const Cloud::Ptr cloud(new Cloud);
    pcl::transformPointCloud(*scanRoom(in_room), *cloud, poses.back().matrix());
    clouds.push_back(cloud);
    copies.emplace_back(new Cloud(*cloud));
  }

  const std::vector<Eigen::Isometry3d> none(kScans, Eigen::Isometry3d::Identity());
  const double before = worstError(none, poses, truth);
  pcl::registration::ELCH<pcl::PointXYZ> pcl_elch;
  const double pcl_error = worstError(closeLoop(pcl_elch, copies), poses, truth);
  pcl6d::ELCH<pcl::PointXYZ> elch; // one class name changed
  const double error = worstError(closeLoop(elch, clouds), poses, truth);

  std::printf("worst scan: %.2f m off before, %.2f m with pcl::registration::ELCH, "
              "%.2f m with pcl6d::ELCH (%s)\n",
              before,
              pcl_error,
              error,
              pcl6d::toString(elch.status()));
  return elch.status() == pcl6d::Status::kOk && error < 0.5 * before ? 0 : 1;
}
