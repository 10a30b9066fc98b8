// SPDX-License-Identifier: BSD-3-Clause
#include "graph/measured_map.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/rotation.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::slam6d {

namespace {
/** Limit of LinkCheck::elsewhere below which rays confirm a pose. */
constexpr double kElsewhereBelow = 0.01;

/** Squared errors of links, per degree of freedom: the median by chance (chi2 with 6 degrees: 5.348),
 * and the largest in 99.9 % of the links (22.46). */
constexpr double kMedianOfChance = 5.348 / 6, kLargestOfChance = 22.46 / 6;

/** Rounds of weights: each finds links hidden behind larger errors. */
constexpr int kRoundsOfWeights = 3;

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
} // namespace

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

MeasuredMap
measuredMapOf(const std::vector<Eigen::Isometry3d>& T_world_scan,
              const MapVerification& map)
{
  MeasuredMap measured;
  if (map.scans.empty() || !map.scans[0].tied)
    return measured;
  Components joined(T_world_scan.size());
  for (const LinkCheck& link : map.links)
    if (measures(link, map))
      joined.join(link.from, link.to);
  std::vector<std::size_t> vertex(T_world_scan.size());
  for (std::size_t i = 0; i < T_world_scan.size(); ++i)
    if (joined.firstOf(i) == joined.firstOf(0)) {
      vertex[i] = measured.scans.size();
      measured.scans.push_back(i);
      measured.graph.poses.push_back(T_world_scan[i]);
    }
  for (const LinkCheck& link : map.links)
    if (measures(link, map) && joined.firstOf(link.from) == joined.firstOf(0)) {
      measured.links.push_back(&link);
      measured.are_refined = measured.are_refined || link.refined;
    }
  for (const LinkCheck* link_of_map : measured.links) {
    const LinkCheck& link = *link_of_map;
    PoseLink one;
    one.from = vertex[link.from];
    one.to = vertex[link.to];
    one.T_from_to = T_world_scan[link.from].inverse() * T_world_scan[link.to] *
                    motionFromTwist(link.pull);
    const Matrix6 information =
        inverted<6>(Matrix6(ownFactorOf(link, measured.are_refined) * link.covariance));
    one.information = 0.5 * (information + information.transpose());
    measured.graph.links.push_back(one);
  }
  return measured;
}

double
varianceFactorOf(const MeasuredMap& measured)
{
  double sum = 0;
  std::size_t links = 0;
  for (const LinkCheck* link : measured.links)
    if (link->deviation > 0) {
      const double square = squaredSigmasOf(*link);
      sum += measured.are_refined ? std::min(square, kLargestOfChance) : square;
      ++links;
    }
  return links > 0 ? sum / static_cast<double>(links) : 1;
}

double
excessOf(const PoseGraphResult& result, const MeasuredMap& measured, double factor)
{
  const std::size_t links = measured.links.size();
  const std::size_t conditions = 6 * links, unknowns = 6 * (measured.scans.size() - 1);
  const double links_per_pose =
      static_cast<double>(links) / static_cast<double>(measured.scans.size() - 1);
  const double unclosed =
      conditions > unknowns
          ? result.chi2_after / static_cast<double>(conditions - unknowns)
          : 1;
  const double shared = std::max(1.0, links_per_pose);
  return std::max({1.0, unclosed, factor}) *
         (measured.are_refined ? shared : std::sqrt(shared));
}

void
discountContradictions(const PoseGraphOptions& options, MeasuredMap& measured)
{
  if (!measured.are_refined)
    return;
  std::vector<PoseLink>& links = measured.graph.links;
  const std::vector<PoseLink> given = links;
  for (int round = 0; round < kRoundsOfWeights; ++round) {
    PoseGraphOptimizer optimizer(measured.graph, options);
    const std::vector<double> squares =
        squaredErrors(given, optimizer.optimize().poses);
    std::vector<double> sorted = squares;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double usual = std::max(1.0, *middle / kMedianOfChance);
    for (std::size_t k = 0; k < given.size(); ++k)
      links[k].information = squares[k] > kLargestOfChance * usual
                                 ? Matrix6(given[k].information * (usual / squares[k]))
                                 : given[k].information;
  }
}

} // namespace pcl6d::slam6d
