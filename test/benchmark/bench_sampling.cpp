// SPDX-License-Identifier: BSD-3-Clause
// The filters and normals that have PCL's names, beside PCL's classes: on a synthetic room and, where
// they are there, recorded clouds.
#include "peer_ratio.h"
#include "room_cloud.h"
#include "support/data_folder.h"

#include <pcl6d/filters/pcl/approximate_voxel_grid.h>
#include <pcl6d/filters/pcl/median_filter.h>
#include <pcl6d/filters/pcl/normal_estimation.h>
#include <pcl6d/filters/pcl/octree_reduction.h>
#include <pcl6d/filters/pcl/uniform_sampling.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_reader.h>

#include <pcl/filters/approximate_voxel_grid.h>
#include <pcl/filters/median_filter.h>
#include <pcl/filters/uniform_sampling.h>
#include <pcl/filters/voxel_grid.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace pcl6d::benchmarks {

namespace {
struct NamedCloud {
  std::string name;
  Cloud::ConstPtr cloud;
  std::vector<float> leaves; ///< [m] one that keeps most points, one that keeps few
};

Cloud::Ptr
toCloud(const Points& points)
{
  auto cloud = pcl::make_shared<Cloud>();
  for (const auto& p : points)
    cloud->push_back(Point(p.x(), p.y(), p.z()));
  return cloud;
}

std::vector<NamedCloud>
clouds()
{
  std::vector<NamedCloud> all{
      {"room", roomCloud(300000, Eigen::Isometry3d::Identity(), 1), {0.02f, 0.1f}}};
  const std::filesystem::path pcl = test::dataFolder("pcl");
  const std::filesystem::path kurt3d = test::dataFolder("kurt3d");
  for (const char* name : {"bun0", "bun4"})
    if (std::filesystem::exists(pcl / (std::string(name) + ".pcd")))
      all.push_back({name,
                     toCloud(readScan(pcl / (std::string(name) + ".pcd")).points),
                     {0.003f, 0.01f}});
  if (std::filesystem::exists(pcl / "milk_color.pcd"))
    all.push_back(
        {"milk", toCloud(readScan(pcl / "milk_color.pcd").points), {0.005f, 0.02f}});
  if (std::filesystem::exists(kurt3d))
    all.push_back(
        {"kurt3d", toCloud(ScanFolder(kurt3d).read(0).points), {0.05f, 0.2f}});
  return all;
}

/** A wall that a camera sees at a slant, with noise. */
Cloud::Ptr
depthImage()
{
  Random random(1);
  auto cloud = pcl::make_shared<Cloud>(640, 480);
  for (std::uint32_t y = 0; y < 480; ++y)
    for (std::uint32_t x = 0; x < 640; ++x) {
      const float u = 0.002f * static_cast<float>(x),
                  v = 0.002f * static_cast<float>(y);
      const auto noise = static_cast<float>(0.002 * random.normal());
      (*cloud)(x, y) = Point(u, v, 2 + 0.5f * u + noise);
    }
  return cloud;
}

/** What one job works with. */
struct Outputs {
  Cloud ours, theirs;
  pcl::PointCloud<pcl::Normal> our_normals, their_normals;
};

/** \param[in] setUp of both filters; \param[in] agree whether the outputs are equally good */
template <typename Ours, typename Theirs, typename SetUp, typename Agree>
PeerJob
filterJob(const Cloud::ConstPtr& cloud, SetUp setUp, Agree agree)
{
  const auto out = std::make_shared<Outputs>();
  const auto run = [=](auto& filter, Cloud& output) {
    setUp(filter);
    filter.setInputCloud(cloud);
    filter.filter(output);
  };
  return {[=] {
            Ours filter;
            run(filter, out->ours);
          },
          [=] {
            Theirs filter;
            run(filter, out->theirs);
          },
          [=](benchmark::State& state) {
            state.counters["ours_points"] = static_cast<double>(out->ours.size());
            state.counters["peer_points"] = static_cast<double>(out->theirs.size());
            if (!agree(out->ours, out->theirs))
              state.SkipWithError("the filtered clouds differ");
          }};
}

constexpr auto kSameSize = [](const Cloud& a, const Cloud& b) {
  return a.size() == b.size();
};

/** \brief Ours on a number of threads; of neighbours equally far it may choose others. */
PeerJob
normalsJob(const Cloud::ConstPtr& cloud, unsigned int threads)
{
  const auto out = std::make_shared<Outputs>();
  const auto run = [=](auto& estimation, auto& normals) {
    estimation.setInputCloud(cloud);
    estimation.setKSearch(20);
    estimation.compute(normals);
  };
  return {[=] {
            pcl6d::NormalEstimation<Point, pcl::Normal> estimation(threads);
            run(estimation, out->our_normals);
          },
          [=] {
            pcl::NormalEstimation<Point, pcl::Normal> estimation;
            run(estimation, out->their_normals);
          },
          [=](benchmark::State& state) {
            std::size_t num_same = 0;
            for (std::size_t i = 0; i < cloud->size(); ++i) {
              const auto a = out->our_normals[i].getNormalVector3fMap();
              const auto b = out->their_normals[i].getNormalVector3fMap();
              num_same += std::abs(a.dot(b)) > 0.999f || !b.allFinite();
            }
            if (num_same < cloud->size() * 98 / 100)
              state.SkipWithError("the normals differ");
          }};
}

void
addLeafCases(const NamedCloud& of, float leaf)
{
  const std::string size = "_" + std::to_string(static_cast<int>(leaf * 1000)) + "mm/" +
                           std::to_string(of.cloud->size());
  const auto cloud = of.cloud;
  const auto setLeaf = [=](auto& grid) { grid.setLeafSize(leaf, leaf, leaf); };
  const int repetitions = cloud->size() < 1000 ? 501 : 21;
  addPeerCase({"leaves_" + of.name + size, "pcl::VoxelGrid", 1, repetitions, [=] {
                 return filterJob<OctreeReduction<Point>, pcl::VoxelGrid<Point>>(
                     cloud, setLeaf, kSameSize);
               }});
  addPeerCase({"approximate_leaves_" + of.name + size,
               "pcl::ApproximateVoxelGrid",
               1,
               repetitions,
               [=] {
                 return filterJob<ApproximateVoxelGrid<Point>,
                                  pcl::ApproximateVoxelGrid<Point>>(
                     cloud, setLeaf, [](const Cloud& a, const Cloud& b) {
                       return a.size() <= b.size();
                     });
               }});
  addPeerCase({"uniform_sampling_" + of.name + size,
               "pcl::UniformSampling",
               1,
               repetitions,
               [=] {
                 return filterJob<UniformSampling<Point>, pcl::UniformSampling<Point>>(
                     cloud, [=](auto& f) { f.setRadiusSearch(leaf); }, kSameSize);
               }});
}

/** Lets ours have a number of threads; PCL's class has no such setter. */
void
setThreads(MedianFilter<Point>& filter, unsigned int threads)
{
  filter.setNumberOfThreads(threads);
}
void
setThreads(pcl::MedianFilter<Point>&, unsigned int)
{}

void
addMedianCase(int window, unsigned int threads)
{
  addPeerCase({"median_640x480/" + std::to_string(window),
               "pcl::MedianFilter",
               threads,
               7,
               [=] {
                 return filterJob<MedianFilter<Point>, pcl::MedianFilter<Point>>(
                     depthImage(),
                     [=](auto& f) {
                       f.setWindowSize(window);
                       setThreads(f, threads);
                     },
                     [](const Cloud& a, const Cloud& b) {
                       for (std::size_t i = 0; i < a.size(); ++i)
                         if (a[i].z != b[i].z)
                           return false;
                       return a.size() == b.size();
                     });
               }});
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  const auto thread_counts = takeThreadCounts(argc, argv);
  for (const auto& of : clouds()) {
    for (const float leaf : of.leaves)
      addLeafCases(of, leaf);
    for (const unsigned int threads : thread_counts)
      addPeerCase({"normals_" + of.name + "/" + std::to_string(of.cloud->size()),
                   "pcl::NormalEstimation",
                   threads,
                   repetitionsFor(of.cloud->size() * 20),
                   [=] { return normalsJob(of.cloud, threads); }});
  }
  for (const int window : {3, 5, 15})
    for (const unsigned int threads : thread_counts)
      addMedianCase(window, threads);
  return runPeerCases(argc, argv);
}
