// SPDX-License-Identifier: BSD-3-Clause
// Every search inside ICP, beside the plain k-d tree; with the same bits if it is exact and takes
// the same one of equally near points.
#include "peer_ratio.h"
#include "recorded_pair.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>

#include <pcl/registration/icp.h>

#include <memory>
#include <string>

namespace pcl6d::benchmarks {

namespace {
constexpr char kPlain[] = "kdtree";
constexpr double kMostByForce = 5e8;     // pairs of points: half a second an iteration
constexpr double kApproximateTol = 0.05; // [m] the approximate search ends elsewhere
// Of FLANN, which takes other ones of equally near points; more than a rounding is a fault.
constexpr double kTiesTol = 1e-6; // [m]

/** One search of the target; trees and normals are made before the clock starts. */
struct Matching {
  Matching(const RecordedPair& pair, Metric metric, SearchMethod search)
  : target(pair.target, of(metric, search))
  , source(pair.source, of(metric, SearchMethod::kKdTree))
  , guess(pair.guess)
  {
    options.metric = metric;
    options.max_distance = pair.gate;
    options.num_threads = 1;
  }

  static IcpModel::Options
  of(Metric metric, SearchMethod search)
  {
    IcpModel::Options options;
    options.search = search;
    options.normals = metric != Metric::kPoint;
    return options;
  }

  void
  run()
  {
    searched = 0;
    IcpHooks hooks;
    hooks.observer = [this](const IcpIteration& i) {
      searched += i.searched;
      return true;
    };
    result = icp({target.part()}, source.source(), guess, options, hooks);
  }

  IcpModel target, source;
  Eigen::Isometry3d guess;
  IcpOptions options;
  IcpResult result;
  std::size_t searched = 0; ///< points, in all iterations
};

void
check(benchmark::State& state,
      const Matching& ours,
      const Matching& plain,
      SearchMethod search)
{
  const double visits = static_cast<double>(ours.source.points().size()) *
                        static_cast<double>(ours.result.iterations);
  const auto apart =
      distanceBetween(plain.result.T_target_source, ours.result.T_target_source);
  state.counters["points"] = static_cast<double>(ours.source.points().size());
  state.counters["iterations"] = ours.result.iterations;
  state.counters["searched"] = static_cast<double>(ours.searched) / visits;
  state.counters["apart_mm"] = 1e3 * apart.translation;
  const bool same_bits =
      ours.result.T_target_source.matrix() == plain.result.T_target_source.matrix();
  const bool is_approximate = search == SearchMethod::kApproximate;
  const bool has_own_ties = search == SearchMethod::kFlann;
  if (!is_approximate && !has_own_ties && !same_bits)
    return state.SkipWithError("an exact search came to another transform");
  if (!(apart.translation < (is_approximate ? kApproximateTol : kTiesTol)))
    return state.SkipWithError("the search ended far off");
}

void
addSearch(const RecordedPair& pair, Metric metric, SearchMethod search)
{
  const bool by_force = search == SearchMethod::kBruteForce;
  addPeerCase({std::string("icp/") + toString(metric) + "/" + toString(search) + "/" +
                   pair.name,
               kPlain,
               1,
               by_force ? 1 : 15,
               [=] {
                 const auto ours = std::make_shared<Matching>(pair, metric, search);
                 const auto plain =
                     std::make_shared<Matching>(pair, metric, SearchMethod::kKdTree);
                 return PeerJob{[=] { ours->run(); },
                                [=] { plain->run(); },
                                [=](benchmark::State& state) {
                                  check(state, *ours, *plain, search);
                                }};
               }});
}

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

Cloud::Ptr
cloudOf(const Points& points)
{
  const Cloud::Ptr cloud(new Cloud);
  for (const auto& p : points)
    cloud->push_back({p.x(), p.y(), p.z()});
  return cloud;
}

/** PCL's own ICP with a tree of ours, which it makes twice. */
Eigen::Matrix4f
alignByPcl(const RecordedPair& pair,
           const Cloud::Ptr& target,
           const Cloud::Ptr& source,
           const pcl::search::KdTree<Point>::Ptr& tree)
{
  pcl::IterativeClosestPoint<Point, Point> icp;
  icp.setSearchMethodTarget(tree);
  icp.setInputTarget(target);
  icp.setInputSource(source);
  icp.setMaxCorrespondenceDistance(pair.gate);
  icp.setMaximumIterations(100);
  icp.setTransformationEpsilon(1e-8);
  Cloud aligned;
  icp.align(aligned, pair.guess.matrix().cast<float>());
  return icp.getFinalTransformation();
}

void
addPcl(const RecordedPair& pair)
{
  addPeerCase(
      {"pcl-icp/cached-tree/" + pair.name, kPlain, 1, 7, [=] {
         const auto target = cloudOf(pair.target), source = cloudOf(pair.source);
         const auto ours = std::make_shared<Eigen::Matrix4f>();
         const auto plain = std::make_shared<Eigen::Matrix4f>();
         return PeerJob{
             [=] {
               *ours = alignByPcl(
                   pair, target, source, pcl::make_shared<CachedKdTree<Point>>());
             },
             [=] {
               *plain =
                   alignByPcl(pair, target, source, pcl::make_shared<KdTree<Point>>());
             },
             [=](benchmark::State& state) {
               if (*ours != *plain)
                 state.SkipWithError("PCL's ICP came to another transform");
             }};
       }});
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  using namespace pcl6d; // NOLINT: the searches
  for (const auto& pair : recordedPairs()) {
    for (const Metric metric : {Metric::kPoint, Metric::kGicp})
      for (const auto& name : searchMethodNames()) {
        const SearchMethod search = searchMethodFromName(name);
        const double by_force =
            static_cast<double>(pair.source.size()) * pair.target.size();
        if (search != SearchMethod::kKdTree &&
            (search != SearchMethod::kBruteForce || by_force < kMostByForce))
          addSearch(pair, metric, search);
      }
    addPcl(pair);
  }
  return runPeerCases(argc, argv);
}
