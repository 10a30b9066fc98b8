// SPDX-License-Identifier: BSD-3-Clause
#include "graph_relaxation/ring_graph.h"
#include "peer_ratio.h"

#include <pcl6d/graph_relaxation/pcl/lum.h>

#include <chrono>
#include <cstdio>
#include <memory>

namespace pcl6d::benchmarks {

namespace {
using Point = pcl::PointXYZ;
using Peer = pcl::registration::LUM<Point>;
constexpr char kPeer[] = "pcl::registration::LUM";
constexpr std::size_t kLinksPerScan = 5;
// Poses of both at rest; PCL's are float and its weights others.
constexpr double kSamePlace = 0.005; // [m]

/** Each scan linked with the next ones, round a ring. */
test::Edges
bandEdges(std::size_t scans)
{
  test::Edges edges;
  for (std::size_t i = 0; i < scans; ++i)
    for (std::size_t k = 1; k <= kLinksPerScan; ++k)
      edges.emplace_back(i, (i + k) % scans);
  return edges;
}

/** \param[in] headings [rad]; near zero for PCL's class, which diverges otherwise */
test::GraphCase
bandGraph(std::size_t scans, std::size_t pairs, double headings)
{
  test::GraphRecipe recipe;
  recipe.scans = scans;
  recipe.pairs = pairs;
  recipe.edges = bandEdges(scans);
  recipe.headings = headings;
  recipe.noise = 0.02;
  recipe.start_shift = 0.05;
  recipe.start_turn = 0.005;
  return test::makeGraph(recipe);
}

/** Time of one round: sums of all pairs, assembly, solution, new poses. The difference of
 * runs of 6 and 2 rounds, as the covariances at the end are not part of a round. */
void
oneRound(benchmark::State& state)
{
  const auto scans = static_cast<std::size_t>(state.range(0));
  const test::GraphCase graph = bandGraph(scans, 500, 2 * M_PI);
  GraphSlamOptions options;
  options.num_threads = static_cast<unsigned int>(state.range(1));
  options.translation_epsilon = options.rotation_epsilon = 0; // never at rest
  options.error_epsilon = 0;
  const auto seconds = [&](int rounds) {
    options.max_iterations = rounds;
    const auto begin = std::chrono::steady_clock::now();
    const GraphSlamResult result = GraphSlam(options).relax(graph.start, graph.links);
    benchmark::DoNotOptimize(result.rms);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
        .count();
  };
  seconds(2);
  for (auto _ : state)
    state.SetIterationTime(std::max(1e-9, (seconds(6) - seconds(2)) / 4));
  state.counters["links"] = static_cast<double>(graph.links.size());
}

/** The same graph in both classes. */
struct LumPair {
  test::GraphCase graph;
  LUM<Point> ours;
  Peer theirs;
};

template <typename Lum>
void
fill(Lum& lum, const test::GraphCase& graph)
{
  std::vector<typename Lum::PointCloudPtr> clouds;
  for (std::size_t i = 0; i < graph.start.size(); ++i) {
    clouds.push_back(pcl::make_shared<pcl::PointCloud<Point>>());
    lum.addPointCloud(clouds.back());
  }
  for (const LinkPairs& link : graph.links) {
    const auto matches = pcl::make_shared<pcl::Correspondences>();
    for (std::size_t k = 0; k < link.points_from.size(); ++k) {
      const auto &u = link.points_from[k], &v = link.points_to[k];
      matches->emplace_back(static_cast<int>(clouds[link.from]->size()),
                            static_cast<int>(clouds[link.to]->size()),
                            0);
      clouds[link.from]->push_back(Point(u.x(), u.y(), u.z()));
      clouds[link.to]->push_back(Point(v.x(), v.y(), v.z()));
    }
    lum.setCorrespondences(link.from, link.to, matches);
  }
}

/** At most five rounds from the start, PCL's default; ours stops where floats end. */
template <typename Lum>
void
run(Lum& lum, const test::GraphCase& graph)
{
  for (std::size_t i = 1; i < graph.start.size(); ++i)
    lum.setPose(i, lumPose(graph.start[i]));
  lum.compute();
}

void
checkSamePoses(benchmark::State& state, const LumPair& pair)
{
  double off = 0;
  for (std::size_t i = 0; i < pair.graph.start.size(); ++i) {
    const Eigen::Vector3f difference =
        pair.ours.getPose(i).head<3>() - pair.theirs.getPose(i).head<3>();
    off = std::max<double>(off, difference.norm());
  }
  state.counters["off_mm"] = 1e3 * off;
  if (!(off < kSamePlace))
    state.SkipWithError("the poses differ");
}

PeerJob
lumJob(std::size_t scans, unsigned int threads)
{
  const auto pair = std::make_shared<LumPair>();
  pair->graph = bandGraph(scans, 60, 0);
  const Eigen::Isometry3d to_first = pair->graph.truth[0].inverse();
  for (Eigen::Isometry3d& pose : pair->graph.start)
    pose = to_first * pose;
  fill(pair->ours, pair->graph);
  fill(pair->theirs, pair->graph);
  pair->ours.options().num_threads = threads;
  return {[=] { run(pair->ours, pair->graph); },
          [=] { run(pair->theirs, pair->graph); },
          [=](benchmark::State& state) { checkSamePoses(state, *pair); }};
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  const std::vector<unsigned int> threads = takeThreadCounts(argc, argv);
  for (const unsigned int count : threads)
    for (const int scans : {250, 500, 1000, 2000})
      benchmark::RegisterBenchmark("relaxation_round", oneRound)
          ->Args({scans, static_cast<int>(count)})
          ->ArgNames({"scans", "threads"})
          ->Iterations(5)
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
  for (const unsigned int count : threads)
    for (const std::size_t scans : {100, 200, 300})
      addPeerCase({"lum/" + std::to_string(scans), kPeer, count, 3, [=] {
                     return lumJob(scans, count);
                   }});
  return runPeerCases(argc, argv);
}
