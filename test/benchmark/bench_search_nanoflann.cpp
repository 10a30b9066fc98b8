// SPDX-License-Identifier: BSD-3-Clause
#include "bench_search_nanoflann.h"

#if __has_include(<nanoflann.hpp>)
#include "peer_ratio.h"

#include <pcl6d/search/point_tree.h>

#include <array>
#include <limits>
#include <memory>
#include <nanoflann.hpp>

namespace pcl6d::benchmarks {

namespace {
/** Points as nanoflann wants to see them. */
struct PointsView {
  const Points& points;
  std::size_t
  kdtree_get_point_count() const
  {
    return points.size();
  }
  float
  kdtree_get_pt(std::size_t index, std::size_t axis) const
  {
    return points[index][axis];
  }
  template <typename Box>
  bool
  kdtree_get_bbox(Box&) const
  {
    return false;
  }
};
using Metric = nanoflann::L2_Simple_Adaptor<float, PointsView>;
using PeerTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, PointsView, 3>;

/** The points of one scan, those of a second to ask for, and both trees. */
struct Data {
  Data(std::size_t count, Order order)
  : points(toPoints(*roomCloud(count, Eigen::Isometry3d::Identity(), 1, order)))
  , queries(toPoints(
        *roomCloud(30000, poseFromEuler({0.3, 0.2, 0.05}, {0.02, 0.01, 0.1}), 2)))
  {}
  Points points;
  Points queries;
  PointsView view{points};
  PointTree ours{points};
  PeerTree theirs{3, view}; // builds at once, with its own default leaf size
};

/** The distances that a search of one of the trees finds [m^2], nearest first. */
template <std::size_t k>
using Distances = std::array<float, k>;

template <std::size_t k>
Distances<k>
ours(const Data& data, const Eigen::Vector3f& query)
{
  constexpr float kNoLimit = std::numeric_limits<float>::infinity();
  if constexpr (k == 1)
    return {data.ours.nearest(query, kNoLimit).distance_sq};
  if constexpr (k == 2) {
    TwoNearest best{{-1, kNoLimit}, kNoLimit};
    data.ours.improveTwo(query, best);
    return {best.nearest.distance_sq, best.second_sq};
  }
  Neighbour found[k];
  data.ours.nearestK(query, k, found);
  Distances<k> distances;
  for (std::size_t i = 0; i < k; ++i)
    distances[i] = found[i].distance_sq;
  return distances;
}

template <std::size_t k>
Distances<k>
theirs(const Data& data, const Eigen::Vector3f& query)
{
  std::size_t indices[k];
  Distances<k> distances{};
  nanoflann::KNNResultSet<float> result(k);
  result.init(indices, distances.data());
  data.theirs.findNeighbors(result, query.data(), {});
  return distances;
}

template <std::size_t k>
void
askAll(const Data& data,
       const Points& queries,
       Distances<k> (*search)(const Data&, const Eigen::Vector3f&))
{
  float sum = 0;
  for (const auto& query : queries)
    sum += search(data, query)[k - 1];
  benchmark::DoNotOptimize(sum);
}

template <std::size_t k>
void
checkSameDistances(benchmark::State& state, const Data& data)
{
  for (const auto& query : data.queries)
    if (ours<k>(data, query) != theirs<k>(data, query))
      return state.SkipWithError("the two trees found points at different distances");
}

PeerJob
buildJob(std::size_t count, Order order, unsigned int threads)
{
  const auto data = std::make_shared<Data>(count, order);
  return {[=] { PointTree(data->points, threads); },
          [=] { PeerTree(3, data->view); },
          [=](benchmark::State& state) { checkSameDistances<1>(state, *data); }};
}

/** \param[in] own whether the points of the cloud ask, else those of the second scan */
template <std::size_t k>
PeerJob
queryJob(std::size_t count, Order order, bool own)
{
  const auto data = std::make_shared<Data>(count, order);
  const auto* queries = own ? &data->points : &data->queries;
  return {[=] { askAll<k>(*data, *queries, ours<k>); },
          [=] { askAll<k>(*data, *queries, theirs<k>); },
          [=](benchmark::State& state) { checkSameDistances<k>(state, *data); }};
}

void
addCase(const std::string& name,
        std::size_t count,
        unsigned int threads,
        std::function<PeerJob()> make)
{
  addPeerCase({name + "/" + std::to_string(count),
               "nanoflann",
               threads,
               repetitionsFor(count),
               make});
}
} // namespace

void
addNanoflannCases(std::size_t count,
                  Order order,
                  const std::vector<unsigned int>& thread_counts)
{
  for (const unsigned int threads : thread_counts)
    addCase("search_build_" + nameOf(order), count, threads, [=] {
      return buildJob(count, order, threads);
    });
  addCase("search_nearest_" + nameOf(order), count, 1, [=] {
    return queryJob<1>(count, order, false);
  });
}

void
addMoreNanoflannCases(std::size_t count)
{
  constexpr auto kOrder = Order::kScanner;
  addCase("search_two_nearest", count, 1, [=] {
    return queryJob<2>(count, kOrder, false);
  });
  addCase("search_own_10_nearest", count, 1, [=] {
    return queryJob<10>(count, kOrder, true);
  });
  addCase("search_own_20_nearest", count, 1, [=] {
    return queryJob<20>(count, kOrder, true);
  });
}

} // namespace pcl6d::benchmarks
#else
namespace pcl6d::benchmarks {
void
addNanoflannCases(std::size_t, Order, const std::vector<unsigned int>&)
{}
void
addMoreNanoflannCases(std::size_t)
{}
} // namespace pcl6d::benchmarks
#endif
