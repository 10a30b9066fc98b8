// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/components.h>
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>
#include <pcl6d/registration/twist.h>
#include <pcl6d/slam6d/pose_bounds.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** chi2 of 3 degrees of freedom that 95 % stay below. */
constexpr double kChi2Of95 = 7.814727903251179;

/** \return T as a small motion: its translation, and twice the vector of its quaternion */
Twist
smallMotion(const Eigen::Isometry3d& T)
{
  Eigen::Quaterniond q(T.linear());
  if (q.w() < 0)
    q.coeffs() = -q.coeffs();
  Twist motion;
  motion << T.translation(), 2 * q.vec();
  return motion;
}

/** Surer than this rays confirm a place. */
constexpr double kElsewhereBelow = 0.01;

/** Links that hold scans, and those whose place rays confirm while their surfaces ask for a
 * shift: by how much the scans of the map are off is what they measure. */
bool
measures(const LinkCheck& link, const MapVerification& map)
{
  const bool holds =
      link.trust == LinkTrust::kGood || link.trust == LinkTrust::kUnverified;
  return (holds || (link.elsewhere < kElsewhereBelow && link.shift > 0)) &&
         link.open_directions == 0 && link.covariance.diagonal().minCoeff() > 0 &&
         map.scans[link.from].tied && map.scans[link.to].tied;
}

/** \return the graph of the scans that links join to the first one */
PoseGraph
graphOf(const std::vector<Eigen::Isometry3d>& poses,
        const MapVerification& map,
        std::vector<std::size_t>& scans)
{
  Components joined(poses.size());
  for (const LinkCheck& link : map.links)
    if (measures(link, map))
      joined.join(link.from, link.to);
  std::vector<std::size_t> vertex(poses.size());
  PoseGraph graph;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (joined.firstOf(i) == joined.firstOf(0)) {
      vertex[i] = scans.size();
      scans.push_back(i);
      graph.poses.push_back(poses[i]);
    }
  for (const LinkCheck& link : map.links)
    if (measures(link, map) && joined.firstOf(link.from) == joined.firstOf(0)) {
      PoseLink measured;
      measured.from = vertex[link.from];
      measured.to = vertex[link.to];
      measured.T_from_to =
          poses[link.from].inverse() * poses[link.to] * motionFromTwist(link.pull);
      const Matrix6 information = inverted<6>(link.covariance);
      measured.information = 0.5 * (information + information.transpose());
      graph.links.push_back(measured);
    }
  return graph;
}

/** \param[in] scans of the graph \return the mean squared shift that surfaces ask for, in their standard deviations: above
 * 1 covariances of links are too small for these scans (the variance factor of geodesy,
 * a posteriori). Where scans leave much open their surfaces go on moving when they are
 * followed, all in one sense, which no cycle shows. */
double
varianceFactorOf(const MapVerification& map, const std::vector<std::size_t>& scans)
{
  std::vector<bool> is_in_graph(map.scans.size(), false);
  for (const std::size_t i : scans)
    is_in_graph[i] = true;
  double sum = 0;
  std::size_t links = 0;
  for (const LinkCheck& link : map.links)
    if (is_in_graph[link.from] && measures(link, map) && link.deviation > 0) {
      const double sigmas = link.shift / link.deviation;
      sum += sigmas * sigmas;
      ++links;
    }
  return links > 0 ? sum / static_cast<double>(links) : 1;
}

/** \return how much larger covariances are than the links say: as cycles do not close, as
 * surfaces ask for more than covariances say, and as links of a scan share its errors, so
 * that of m links to a scan as much is new as of the root of m. Half of what they say being
 * shared is what NEES of simulated scenes asks for. */
double
excessOf(const PoseGraphResult& result,
         std::size_t links,
         const std::vector<std::size_t>& scans,
         const MapVerification& map)
{
  const std::size_t conditions = 6 * links, unknowns = 6 * (scans.size() - 1);
  const double links_per_pose =
      static_cast<double>(links) / static_cast<double>(scans.size() - 1);
  const double unclosed =
      conditions > unknowns
          ? result.chi2_after / static_cast<double>(conditions - unknowns)
          : 1;
  return std::max({1.0, unclosed, varianceFactorOf(map, scans)}) *
         std::sqrt(std::max(1.0, links_per_pose));
}

/** \return [m] the longest half axis of the 95 % ellipsoid of the position */
double
boundOf(const Matrix6& covariance)
{
  const auto axes = symmetricEigenvalues<3>(covariance.topLeftCorner<3, 3>());
  return std::sqrt(kChi2Of95 * std::max(0.0, axes(2)));
}
} // namespace

void
boundPoses(const std::vector<Eigen::Isometry3d>& T_world_scan,
           MapVerification& map,
           unsigned int num_threads)
{
  require(T_world_scan.size() == map.scans.size(),
          "poses",
          T_world_scan.size(),
          "one per scan");
  for (ScanCheck& scan : map.scans) {
    scan.covariance.reset();
    scan.bound.reset();
  }
  if (map.scans.empty() || !map.scans[0].tied)
    return;
  std::vector<std::size_t> scans;
  PoseGraph graph = graphOf(T_world_scan, map, scans);
  map.scans[0].covariance = Matrix6::Zero();
  map.scans[0].bound = 0;
  if (scans.size() < 2)
    return;
  PoseGraphOptions options;
  options.num_threads = num_threads;
  const std::size_t links = graph.links.size();
  PoseGraphOptimizer optimizer(std::move(graph), options);
  const PoseGraphResult& best = optimizer.optimize();
  std::vector<Matrix6> covariances;
  try {
    covariances = optimizer.marginalCovariances();
  } catch (const ComputeFailed&) {
    return; // links so unlike that doubles do not hold their sum: better none than a wrong one
  }
  const double excess = excessOf(best, links, scans, map);
  for (std::size_t v = 1; v < scans.size(); ++v) {
    const Twist way = smallMotion(T_world_scan[scans[v]].inverse() * best.poses[v]);
    ScanCheck& scan = map.scans[scans[v]];
    scan.covariance = excess * covariances[v] + way * way.transpose();
    scan.bound = boundOf(*scan.covariance);
  }
}

} // namespace pcl6d
