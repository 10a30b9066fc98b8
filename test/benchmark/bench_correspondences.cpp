// SPDX-License-Identifier: BSD-3-Clause
// Closest pairs of two scans, with the tree that they need, beside PCL's class.
#include "peer_ratio.h"
#include "recorded_pair.h"

#include <pcl6d/registration/pcl/correspondence_estimation.h>

#include <memory>

namespace pcl6d::benchmarks {

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
constexpr char kPeer[] = "pcl::registration::CorrespondenceEstimation";

Cloud::Ptr
cloudAt(const Points& points, const Eigen::Isometry3d& pose)
{
  const Cloud::Ptr cloud(new Cloud);
  for (const auto& p : transformed(points, pose))
    cloud->push_back({p.x(), p.y(), p.z()});
  return cloud;
}

struct Clouds {
  Cloud::Ptr source, target;
  double gate;
  bool reciprocal;
  pcl::Correspondences ours, theirs;
};

template <typename Estimation>
void
findPairs(Estimation& estimation, const Clouds& clouds, pcl::Correspondences& pairs)
{
  estimation.setInputSource(clouds.source);
  estimation.setInputTarget(clouds.target);
  if (clouds.reciprocal)
    estimation.determineReciprocalCorrespondences(pairs, clouds.gate);
  else
    estimation.determineCorrespondences(pairs, clouds.gate);
}

/** Both searches are exact: they differ in pairs of points that are equally near alone. */
void
checkSame(benchmark::State& state, const Clouds& clouds)
{
  const std::size_t count = clouds.ours.size();
  std::size_t other = count == clouds.theirs.size() ? 0 : count;
  for (std::size_t i = 0; i < count && other < count; ++i)
    other += clouds.ours[i].index_query != clouds.theirs[i].index_query ? 1 : 0;
  if (1000 * other > count)
    state.SkipWithError("the pairs are not the same");
  state.counters["pairs"] = static_cast<double>(count);
}

PeerJob
pairsJob(const RecordedPair& pair, unsigned int threads, bool reciprocal)
{
  const auto clouds = std::make_shared<Clouds>();
  *clouds = {cloudAt(pair.source, pair.guess),
             cloudAt(pair.target, Eigen::Isometry3d::Identity()),
             pair.gate,
             reciprocal,
             {},
             {}};
  return {[=] {
            CorrespondenceEstimation<Point, Point> estimation;
            estimation.setNumberOfThreads(threads);
            findPairs(estimation, *clouds, clouds->ours);
          },
          [=] {
            pcl::registration::CorrespondenceEstimation<Point, Point> estimation;
            findPairs(estimation, *clouds, clouds->theirs);
          },
          [=](benchmark::State& state) { checkSame(state, *clouds); }};
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  const auto thread_counts = takeThreadCounts(argc, argv);
  for (const auto& pair : recordedPairs())
    for (const unsigned int threads : thread_counts)
      for (const bool reciprocal : {false, true})
        addPeerCase({(reciprocal ? "reciprocal/" : "closest/") + pair.name,
                     kPeer,
                     threads,
                     21,
                     [=] { return pairsJob(pair, threads, reciprocal); }});
  return runPeerCases(argc, argv);
}
