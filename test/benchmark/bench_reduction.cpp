// SPDX-License-Identifier: BSD-3-Clause
#include "peer_ratio.h"
#include "room_cloud.h"

#include <pcl6d/filters/pcl/octree_reduction.h>

#include <pcl/filters/voxel_grid.h>
#include <pcl/search/kdtree.h>

#include <memory>
#include <string>
#include <utility>

namespace pcl6d::benchmarks {

namespace {
constexpr char kPeer[] = "pcl::VoxelGrid";
constexpr std::size_t kPoints = 300000;
// Both keep the mean of each voxel of a grid with a corner at the origin, but PCL sorts
// points into it and sums them in float: points on a border may change sides.
constexpr double kSameMean = 1e-5;     // [m]
constexpr double kShareOfSame = 0.999; // of our points that are also the peer's

struct Data {
  Cloud::Ptr cloud = roomCloud(kPoints, Eigen::Isometry3d::Identity(), 1);
  Cloud::Ptr ours = pcl::make_shared<Cloud>();
  Cloud::Ptr theirs = pcl::make_shared<Cloud>();
};

void
reduceOurs(Data& data, double voxel)
{
  pcl6d::OctreeReduction<Point> reduction;
  reduction.options().voxel = voxel;
  reduction.setInputCloud(data.cloud);
  reduction.filter(*data.ours);
}

/** The same voxels as PCL, point by point. */
void
reduceByLeaf(Data& data, double voxel)
{
  pcl6d::OctreeReduction<Point> reduction;
  const auto leaf = static_cast<float>(voxel);
  reduction.setLeafSize(leaf, leaf, leaf);
  reduction.setInputCloud(data.cloud);
  reduction.filter(*data.ours);
}

void
reduceTheirs(Data& data, double voxel)
{
  pcl::VoxelGrid<Point> grid;
  const auto leaf = static_cast<float>(voxel);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.setInputCloud(data.cloud);
  grid.filter(*data.theirs);
}

void
checkSamePoints(benchmark::State& state, const Data& data)
{
  pcl::search::KdTree<Point> tree;
  tree.setInputCloud(data.theirs);
  pcl::Indices index;
  std::vector<float> distance_sq;
  std::size_t same = 0;
  for (const auto& point : *data.ours) {
    tree.nearestKSearch(point, 1, index, distance_sq);
    if (distance_sq[0] <= kSameMean * kSameMean)
      ++same;
  }
  state.counters["ours_points"] = static_cast<double>(data.ours->size());
  state.counters["peer_points"] = static_cast<double>(data.theirs->size());
  const auto larger =
      static_cast<double>(std::max(data.ours->size(), data.theirs->size()));
  if (static_cast<double>(same) < kShareOfSame * larger)
    state.SkipWithError("the reduced clouds differ");
}

PeerJob
reduceJob(void (*ours)(Data&, double), double voxel)
{
  const auto data = std::make_shared<Data>();
  return {[=] { ours(*data, voxel); },
          [=] { reduceTheirs(*data, voxel); },
          [=](benchmark::State& state) { checkSamePoints(state, *data); }};
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  const std::string size = "/" + std::to_string(kPoints);
  for (const auto& [name, voxel] : {std::pair("10cm", 0.10), std::pair("2cm", 0.02)}) {
    const double side = voxel;
    addPeerCase({std::string("reduction_") + name + size, kPeer, 1, 21, [=] {
                   return reduceJob(reduceOurs, side);
                 }});
    addPeerCase({std::string("leaves_") + name + size, kPeer, 1, 21, [=] {
                   return reduceJob(reduceByLeaf, side);
                 }});
  }
  return runPeerCases(argc, argv);
}
