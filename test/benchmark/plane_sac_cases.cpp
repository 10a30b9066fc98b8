// SPDX-License-Identifier: BSD-3-Clause
#include "peer_ratio.h"
#include "plane_sac_cases.h"
#include "plane_scans.h"
#include "support/data_folder.h"

#include <pcl6d/plane_segmentation/pcl/plane_sac_segmentation.h>
#include <pcl6d/plane_segmentation/pcl/plane_segmentation.h>

#include <pcl/io/pcd_io.h>

#include <cstdio>
#include <string>

namespace pcl6d::benchmarks {

namespace {
using SacCloud = pcl::PointCloud<pcl::PointXYZ>;
const std::string kPeer = "pcl::SACSegmentation";
constexpr std::size_t kOften = 10000; // points: fewer are looked at more often

SacCloud::Ptr
recordedCloud(const std::string& folder, const std::string& file)
{
  const auto found = test::dataFolder(folder);
  auto cloud = pcl::make_shared<SacCloud>();
  if (found.empty() || pcl::io::loadPCDFile((found / file).string(), *cloud) < 0) {
    std::fprintf(stderr, "%s is left out: set PCL6D_DATA\n", file.c_str());
    return nullptr;
  }
  return cloud;
}

template <typename Segmentation>
std::size_t
pointsOnPlane(Segmentation& segmentation)
{
  pcl::PointIndices inliers;
  pcl::ModelCoefficients plane;
  segmentation.segment(inliers, plane);
  return inliers.indices.size();
}

template <typename Segmentation>
std::size_t
pointsBySac(const SacCloud::ConstPtr& cloud,
            double threshold,
            int iterations,
            unsigned int threads)
{
  Segmentation segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(threshold);
  segmentation.setMaxIterations(iterations);
  if (threads > 1)
    segmentation.setNumberOfThreads(static_cast<int>(threads));
  segmentation.setInputCloud(cloud);
  return pointsOnPlane(segmentation);
}

void
addSacCase(const std::string& name,
           const SacCloud::ConstPtr& cloud,
           int centimetres,
           int iterations,
           unsigned int threads)
{
  const double threshold = 0.01 * centimetres;
  const auto ours = [=] {
    return pointsBySac<PlaneSACSegmentation<pcl::PointXYZ>>(
        cloud, threshold, iterations, threads);
  };
  const auto theirs = [=] {
    return pointsBySac<pcl::SACSegmentation<pcl::PointXYZ>>(
        cloud, threshold, iterations, 1);
  };
  const std::string setting =
      "/" + std::to_string(centimetres) + "cm/" + std::to_string(iterations);
  addPeerCase({"plane_sac/" + name + setting,
               kPeer,
               threads,
               cloud->size() < kOften ? 101 : 5,
               [=] {
                 return PeerJob{[=] { ours(); },
                                [=] { theirs(); },
                                [=](benchmark::State& state) {
                                  const std::size_t found = ours(), peer = theirs();
                                  state.counters["ours"] = static_cast<double>(found);
                                  state.counters["peer"] = static_cast<double>(peer);
                                  if (found < peer)
                                    state.SkipWithError("fewer points on the plane");
                                }};
               }});
}

void
addGrowingCase(const SacCloud::ConstPtr& cloud, unsigned int threads)
{
  const auto ours = [=] {
    RegionGrowingPlaneSegmentation<pcl::PointXYZ> segmentation;
    segmentation.setNumberOfThreads(threads);
    segmentation.setInputCloud(cloud);
    return pointsOnPlane(segmentation);
  };
  addPeerCase({"plane_growing/milk_scene", kPeer, threads, 5, [=] {
                 return PeerJob{[=] { ours(); },
                                [=] {
                                  pointsBySac<pcl::SACSegmentation<pcl::PointXYZ>>(
                                      cloud, 0.01, 50, 1);
                                },
                                [=](benchmark::State& state) {
                                  state.counters["ours"] = static_cast<double>(ours());
                                }};
               }});
}
} // namespace

void
addPlaneSacCases(const std::vector<unsigned int>& threads)
{
  std::vector<std::pair<std::string, SacCloud::ConstPtr>> clouds;
  for (const std::string name : {"bun0", "bun4", "sac_plane_test", "milk_color"})
    clouds.emplace_back(name, recordedCloud("pcl", name + ".pcd"));
  const auto scene = recordedCloud("objects", "milk_cartoon_all_small_clorox.pcd");
  clouds.emplace_back("milk_scene", scene);
  if (const auto scan = kurt3dScan()) {
    auto cloud = pcl::make_shared<SacCloud>();
    for (const auto& p : *scan)
      cloud->emplace_back(p.x(), p.y(), p.z());
    cloud->is_dense = false;
    clouds.emplace_back("kurt3d-001", cloud);
  }
  for (const auto count : threads) {
    for (const auto& [name, cloud] : clouds)
      for (const int centimetres : {1, 2, 5})
        for (const int iterations : {50, 1000})
          if (cloud)
            addSacCase(name, cloud, centimetres, iterations, count);
    if (scene)
      addGrowingCase(scene, count);
  }
}

} // namespace pcl6d::benchmarks
