// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/components.h>
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/graph_relaxation/link_error.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>
#include <pcl6d/registration/twist.h>
#include <pcl6d/slam6d/pose_bounds.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** 95 % quantile of the standard normal distribution. */
constexpr double kNormalOf95 = 1.6448536269514722;

/** \return T as a small motion: translation, and twice the vector part of the quaternion */
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

/** Limit of LinkCheck::elsewhere below which rays confirm a pose. */
constexpr double kElsewhereBelow = 0.01;

/** \return whether a link is a measurement: consistent or unverified, or confirmed by rays while
 * its surfaces require a shift. The measured value is the error of the relative pose in the map. */
bool
measures(const LinkCheck& link, const MapVerification& map)
{
  const bool holds =
      link.trust == LinkTrust::kGood || link.trust == LinkTrust::kUnverified;
  return (holds || (link.elsewhere < kElsewhereBelow && link.shift > 0)) &&
         link.open_directions == 0 && link.covariance.diagonal().minCoeff() > 0 &&
         map.scans[link.from].tied && map.scans[link.to].tied;
}

/** Squared errors of links, per degree of freedom: the median by chance (chi2 with 6 degrees: 5.348),
 * and the largest in 99.9 % of the links (22.46). */
constexpr double kMedianOfChance = 5.348 / 6, kLargestOfChance = 22.46 / 6;

bool
isOfRefinedLinks(const MapVerification& map)
{
  return std::any_of(map.links.begin(), map.links.end(), [&](const LinkCheck& link) {
    return link.refined && measures(link, map);
  });
}

/** \return the squared shift that the surfaces of a link ask for, in standard deviations */
double
squaredSigmasOf(const LinkCheck& link)
{
  if (link.refined)
    return link.pull.dot(solveSymmetric<6>(link.covariance, link.pull)) / 6;
  const double sigmas = link.shift / link.deviation;
  return sigmas * sigmas;
}

/** \return the factor on the covariance of a link. Among refined links, those with equal weights are
 * links whose surfaces leave a motion nearly open, or whose pairs found no rest: each counts with the
 * shift that it asks for. */
double
ownFactorOf(const LinkCheck& link, bool are_refined)
{
  return are_refined && !link.refined && link.deviation > 0
             ? std::max(1.0, squaredSigmasOf(link))
             : 1;
}

/** \return the graph of the scans connected with the first scan */
PoseGraph
graphOf(const std::vector<Eigen::Isometry3d>& poses,
        const MapVerification& map,
        std::vector<std::size_t>& scans)
{
  Components joined(poses.size());
  for (const LinkCheck& link : map.links)
    if (measures(link, map))
      joined.join(link.from, link.to);
  const bool are_refined = isOfRefinedLinks(map);
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
      const Matrix6 information =
          inverted<6>(Matrix6(ownFactorOf(link, are_refined) * link.covariance));
      measured.information = 0.5 * (information + information.transpose());
      graph.links.push_back(measured);
    }
  return graph;
}

/** \param[in] scans of the graph \return mean squared shift required by surfaces, in standard
 * deviations: above 1 the links' covariances are too small (a posteriori variance factor of
 * geodesy). Weakly constrained scans keep moving in one direction when surface shifts are
 * followed, which no cycle reveals. Shifts of refined maps count up to the largest by chance: links
 * of a few scans that agree on a larger one show an error of the map, the way to the optimum. */
double
varianceFactorOf(const MapVerification& map, const std::vector<std::size_t>& scans)
{
  std::vector<bool> is_in_graph(map.scans.size(), false);
  for (const std::size_t i : scans)
    is_in_graph[i] = true;
  const bool are_refined = isOfRefinedLinks(map);
  double sum = 0;
  std::size_t links = 0;
  for (const LinkCheck& link : map.links)
    if (is_in_graph[link.from] && measures(link, map) && link.deviation > 0) {
      const double square = squaredSigmasOf(link);
      sum += are_refined ? std::min(square, kLargestOfChance) : square;
      ++links;
    }
  return links > 0 ? sum / static_cast<double>(links) : 1;
}

/** \return the factor on the covariances from the links. Reasons: cycles do not close, surfaces
 * require larger shifts than the covariances allow, and links of a scan share its errors: m links
 * of a scan have the information of sqrt(m) independent links, which fits the NEES of simulated
 * scenes. What is left of the errors of refined links lies in the planes of a scan, equal in all of its links, and closes every
 * cycle: m links have the information of one. */
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
  const double shared = std::max(1.0, links_per_pose);
  return std::max({1.0, unclosed, varianceFactorOf(map, scans)}) *
         (isOfRefinedLinks(map) ? shared : std::sqrt(shared));
}

/** Rounds of weights: each finds links hidden behind larger errors. */
constexpr int kRoundsOfWeights = 3;

/** \return the squared error of each link in its covariance, per degree of freedom */
std::vector<double>
squaredErrors(const std::vector<PoseLink>& links,
              const std::vector<Eigen::Isometry3d>& poses)
{
  std::vector<double> squares;
  for (const PoseLink& link : links) {
    const Twist error = smallMotion(link.T_from_to.inverse() *
                                    poses[link.from].inverse() * poses[link.to]);
    squares.push_back(error.dot(link.information * error) / 6);
  }
  return squares;
}

/** Lets refined links that contradict the others count with the error that they show (the Danish
 * method of geodesy: T. Krarup, J. Juhl, K. Kubik, "Goetterdaemmerung over least squares
 * adjustment", ISPRS 1980). Pairs of few surfaces come to rest elsewhere, off by hundreds of their
 * deviations: one such link would widen the bounds of the whole map. */
void
discountContradictions(const MapVerification& map,
                       const PoseGraphOptions& options,
                       PoseGraph& graph)
{
  if (!isOfRefinedLinks(map))
    return;
  const std::vector<PoseLink> given = graph.links;
  for (int round = 0; round < kRoundsOfWeights; ++round) {
    PoseGraphOptimizer optimizer(graph, options);
    const std::vector<double> squares =
        squaredErrors(given, optimizer.optimize().poses);
    std::vector<double> sorted = squares;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double usual = std::max(1.0, *middle / kMedianOfChance);
    for (std::size_t k = 0; k < given.size(); ++k)
      graph.links[k].information =
          squares[k] > kLargestOfChance * usual
              ? Matrix6(given[k].information * (usual / squares[k]))
              : given[k].information;
  }
}

/** \return the squared Mahalanobis length of a small motion, per degree of freedom */
double
meanSquare(const Eigen::Isometry3d& motion, const Matrix6& covariance)
{
  const Twist way = smallMotion(motion);
  return way.dot(solveSymmetric<6>(covariance, way)) / 6;
}

/** \return [m] radius of the sphere about the pose that holds the position with 95 %. The squared
 * distance is a sum of normal squares, and the cube root of such a sum is nearly normal: within 1.3
 * % of the radius, for errors along one line as for equal errors in all directions (F. E. Grubbs,
 * "Approximate circular and noncircular offset probabilities of hitting", Operations Research
 * 12(1), 1964). The longest half axis of the 95 % ellipsoid would be up to 1.43 times as long. */
double
boundOf(const Matrix6& covariance)
{
  const Eigen::Matrix3d C = covariance.topLeftCorner<3, 3>();
  const double mean = C.trace();
  if (!(mean > 0))
    return 0;
  const double ninth = 2 * C.squaredNorm() / (9 * mean * mean);
  const double root = 1 - ninth + kNormalOf95 * std::sqrt(ninth);
  return std::sqrt(mean * root * root * root);
}

/** \return the covariance of a pose relative to the first scan that follows from the frames of both,
 * in the scan's own axes */
Matrix6
ofFrames(const Eigen::Isometry3d& T_scan_first,
         const Matrix6& first,
         const Matrix6& scan)
{
  const Eigen::Matrix3d R = T_scan_first.linear();
  Matrix6 moved = Matrix6::Zero();
  moved << R, skew(T_scan_first.translation()) * R, Eigen::Matrix3d::Zero(), R;
  return moved * first * moved.transpose() + scan;
}
} // namespace

namespace {
/** Forgets the bounds of all scans; that of the first one is zero.
 * \return whether scans are connected to the first one */
bool
beginBounds(MapVerification& map)
{
  for (ScanCheck& scan : map.scans) {
    scan.covariance.reset();
    scan.bound.reset();
  }
  if (map.scans.empty() || !map.scans[0].tied)
    return false;
  map.scans[0].covariance = Matrix6::Zero();
  map.scans[0].bound = 0;
  return true;
}
} // namespace

void
boundPoses(const std::vector<Eigen::Isometry3d>& T_world_scan,
           MapVerification& map,
           unsigned int num_threads,
           const std::vector<Matrix6>& frames)
{
  require(T_world_scan.size() == map.scans.size(),
          "poses",
          T_world_scan.size(),
          "one per scan");
  require(frames.empty() || frames.size() == map.scans.size(),
          "frames",
          frames.size(),
          "one per scan, or none");
  if (!beginBounds(map))
    return;
  std::vector<std::size_t> scans;
  PoseGraph graph = graphOf(T_world_scan, map, scans);
  if (scans.size() < 2)
    return;
  PoseGraphOptions options;
  options.num_threads = num_threads;
  const std::size_t links = graph.links.size();
  discountContradictions(map, options, graph);
  PoseGraphOptimizer optimizer(std::move(graph), options);
  const PoseGraphResult& best = optimizer.optimize();
  std::vector<Matrix6> covariances;
  try {
    covariances = optimizer.marginalCovariances();
  } catch (const ComputeFailed&) {
    return; // links too different in size for doubles: no covariance is better than a wrong one
        // result
  }
  const double excess = excessOf(best, links, scans, map);
  for (std::size_t v = 1; v < scans.size(); ++v) {
    const Twist way = smallMotion(T_world_scan[scans[v]].inverse() * best.poses[v]);
    ScanCheck& scan = map.scans[scans[v]];
    scan.covariance = excess * covariances[v] + way * way.transpose();
    if (!frames.empty())
      *scan.covariance += ofFrames(T_world_scan[scans[v]].inverse() * T_world_scan[0],
                                   frames[0],
                                   frames[scans[v]]);
    scan.bound = boundOf(*scan.covariance);
  }
}

PoseGraph
linksOfMap(const std::vector<Eigen::Isometry3d>& T_world_scan,
           const MapVerification& map,
           unsigned int num_threads)
{
  require(T_world_scan.size() == map.scans.size(),
          "poses",
          T_world_scan.size(),
          "one per scan");
  PoseGraph all;
  all.poses = T_world_scan;
  if (map.scans.empty() || !map.scans[0].tied)
    return all;
  std::vector<std::size_t> scans;
  PoseGraph graph = graphOf(T_world_scan, map, scans);
  if (scans.size() < 2)
    return all;
  PoseGraphOptions options;
  options.num_threads = num_threads;
  discountContradictions(map, options, graph);
  all.links = graph.links;
  PoseGraphOptimizer optimizer(std::move(graph), options);
  const PoseGraphResult& best = optimizer.optimize();
  const double excess = excessOf(best, all.links.size(), scans, map);
  double farthest = 1;
  try {
    const std::vector<Matrix6> covariances = optimizer.marginalCovariances();
    for (std::size_t v = 1; v < scans.size(); ++v)
      farthest = std::max(farthest,
                          meanSquare(T_world_scan[scans[v]].inverse() * best.poses[v],
                                     excess * covariances[v]));
  } catch (const ComputeFailed&) {
    all.links.clear(); // like boundPoses()
  }
  for (PoseLink& link : all.links) {
    link.from = scans[link.from];
    link.to = scans[link.to];
    link.information /= excess * farthest;
  }
  return all;
}

} // namespace pcl6d
