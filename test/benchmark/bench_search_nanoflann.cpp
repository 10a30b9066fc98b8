// SPDX-License-Identifier: BSD-3-Clause
#include "bench_search_nanoflann.h"

#if __has_include(<nanoflann.hpp>)
#include "room_cloud.h"

#include <pcl6d/search/point_tree.h>

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
  explicit Data(std::size_t count)
  : points(toPoints(*roomCloud(count, Eigen::Isometry3d::Identity(), 1)))
  , queries(toPoints(
        *roomCloud(30000, poseFromEuler({0.3, 0.2, 0.05}, {0.02, 0.01, 0.1}), 2)))
  {}
  Points points;
  Points queries;
  PointsView view{points};
  PointTree ours{points};
  PeerTree theirs{3, view}; // builds at once, with its own default leaf size
};

float
oursNearest(const Data& data, const Eigen::Vector3f& query)
{
  return data.ours.nearest(query, std::numeric_limits<float>::infinity()).distance_sq;
}

float
theirNearest(const Data& data, const Eigen::Vector3f& query)
{
  std::size_t index = 0;
  float distance_sq = 0;
  nanoflann::KNNResultSet<float> result(1);
  result.init(&index, &distance_sq);
  data.theirs.findNeighbors(result, query.data(), {});
  return distance_sq;
}

void
askAll(const Data& data, float (*nearest)(const Data&, const Eigen::Vector3f&))
{
  float sum = 0;
  for (const auto& query : data.queries)
    sum += nearest(data, query);
  benchmark::DoNotOptimize(sum);
}

void
checkSameDistances(benchmark::State& state, const Data& data)
{
  for (const auto& query : data.queries)
    if (oursNearest(data, query) != theirNearest(data, query))
      return state.SkipWithError("the two trees found points at different distances");
}
} // namespace

void
addNanoflannCases(std::size_t count)
{
  const auto add = [=](const std::string& name, auto ours, auto theirs) {
    addPeerCase({name + "/" + std::to_string(count), "nanoflann", 1, 21, [=] {
                   const auto data = std::make_shared<Data>(count);
                   return PeerJob{[=] { ours(*data); },
                                  [=] { theirs(*data); },
                                  [=](benchmark::State& state) {
                                    checkSameDistances(state, *data);
                                  }};
                 }});
  };
  add(
      "search_build",
      [](const Data& data) { PointTree(data.points, 1); },
      [](const Data& data) { PeerTree(3, data.view); });
  add(
      "search_nearest",
      [](const Data& data) { askAll(data, oursNearest); },
      [](const Data& data) { askAll(data, theirNearest); });
}

} // namespace pcl6d::benchmarks
#else
void
pcl6d::benchmarks::addNanoflannCases(std::size_t)
{}
#endif
