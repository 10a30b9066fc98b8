// SPDX-License-Identifier: BSD-3-Clause
#include "bench_search_nanoflann.h"
#include "peer_ratio.h"
#include "room_cloud.h"

#include <pcl6d/search/pcl/kd_tree.h>

#include <limits>
#include <memory>

namespace pcl6d::benchmarks {

namespace {
using Search = pcl::search::Search<Point>;
using OurTree = pcl6d::KdTree<Point>;
using PeerTree = pcl::search::KdTree<Point>;
constexpr char kPeer[] = "flann"; // as a user of PCL meets it
constexpr std::size_t kQueries = 30000;
constexpr double kRadius = 0.1; // [m]
// FLANN prunes by distances that it updates step by step, so that rounding may hide a
// point that is nearer by a few units of the last place.
constexpr float kDistanceTol = 4 * std::numeric_limits<float>::epsilon(); // relative

/** What one query found, nearest first. */
struct Found {
  pcl::Indices indices;
  std::vector<float> distances_sq; // [m^2]
};
using Query = int (*)(const Search&, const Point&, Found&);

int
nearest(const Search& tree, const Point& point, Found& found)
{
  return tree.nearestKSearch(point, 1, found.indices, found.distances_sq);
}

template <int k>
int
nearestK(const Search& tree, const Point& point, Found& found)
{
  return tree.nearestKSearch(point, k, found.indices, found.distances_sq);
}

int
withinRadius(const Search& tree, const Point& point, Found& found)
{
  return tree.radiusSearch(point, kRadius, found.indices, found.distances_sq);
}

/** The cloud, and the points of a second scan as an ICP would ask for them. */
struct Data {
  Data(std::size_t count, Order order)
  : cloud(roomCloud(count, Eigen::Isometry3d::Identity(), 1, order))
  , queries(roomCloud(kQueries, poseFromEuler({0.3, 0.2, 0.05}, {0.02, 0.01, 0.1}), 2))
  {}
  Cloud::Ptr cloud;
  Cloud::Ptr queries;
};

void
queryAll(const Search& tree, const Cloud& queries, Query query)
{
  Found found;
  std::size_t count = 0;
  for (const auto& point : queries)
    count += query(tree, point, found);
  benchmark::DoNotOptimize(count);
}

bool
sameDistances(const Found& a, const Found& b)
{
  return std::equal(a.distances_sq.begin(),
                    a.distances_sq.end(),
                    b.distances_sq.begin(),
                    b.distances_sq.end(),
                    [](float x, float y) {
                      return std::abs(x - y) <= kDistanceTol * std::max(x, y);
                    });
}

/** Compares distances, as equally distant points may come in any order. */
void
checkSameAnswers(benchmark::State& state,
                 const Search& ours,
                 const Search& theirs,
                 const Cloud& queries,
                 Query query)
{
  Found our, their;
  double count = 0;
  for (const auto& point : queries) {
    count += query(ours, point, our);
    query(theirs, point, their);
    if (!sameDistances(our, their))
      return state.SkipWithError("the two trees found points at different distances");
  }
  state.counters["found"] = count / static_cast<double>(queries.size());
}

PeerJob
buildJob(std::size_t count, Order order, unsigned int threads)
{
  const auto data = std::make_shared<Data>(count, order);
  return {[=] {
            OurTree ours;
            ours.setNumberOfThreads(threads);
            ours.setInputCloud(data->cloud);
          },
          [=] { PeerTree().setInputCloud(data->cloud); },
          [=](benchmark::State& state) {
            OurTree ours;
            ours.setNumberOfThreads(threads);
            PeerTree theirs;
            ours.setInputCloud(data->cloud);
            theirs.setInputCloud(data->cloud);
            checkSameAnswers(state, ours, theirs, *data->queries, nearest);
          }};
}

PeerJob
queryJob(std::size_t count, Order order, Query query)
{
  const auto data = std::make_shared<Data>(count, order);
  const auto ours = std::make_shared<OurTree>();
  const auto theirs = std::make_shared<PeerTree>();
  ours->setInputCloud(data->cloud);
  theirs->setInputCloud(data->cloud);
  return {[=] { queryAll(*ours, *data->queries, query); },
          [=] { queryAll(*theirs, *data->queries, query); },
          [=](benchmark::State& state) {
            checkSameAnswers(state, *ours, *theirs, *data->queries, query);
          }};
}

/** \param[in] threads that ours may use for it */
void
addCase(const std::string& name,
        std::size_t count,
        unsigned int threads,
        std::function<PeerJob()> make)
{
  addPeerCase({name + "/" + std::to_string(count),
               kPeer,
               threads,
               repetitionsFor(count),
               make});
}

void
addCases(std::size_t count, Order order, const std::vector<unsigned int>& thread_counts)
{
  for (const unsigned int threads : thread_counts)
    addCase("search_build_" + nameOf(order), count, threads, [=] {
      return buildJob(count, order, threads);
    });
  addCase("search_nearest_" + nameOf(order), count, 1, [=] {
    return queryJob(count, order, nearest);
  });
}

/** Searches that depend little on the order. */
void
addMoreCases(std::size_t count)
{
  const auto add = [&](const std::string& name, Query query) {
    addCase(name, count, 1, [=] { return queryJob(count, Order::kScanner, query); });
  };
  add("search_10_nearest", nearestK<10>);
  add("search_20_nearest", nearestK<20>);
  add("search_radius", withinRadius);
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  const auto thread_counts = takeThreadCounts(argc, argv);
  for (const std::size_t count : {100000, 300000, 1000000}) {
    for (const Order order : {Order::kScanner, Order::kRandom}) {
      addCases(count, order, thread_counts);
      addNanoflannCases(count, order, thread_counts);
    }
    addMoreCases(count);
    addMoreNanoflannCases(count);
  }
  return runPeerCases(argc, argv);
}
