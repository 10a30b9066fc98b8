// SPDX-License-Identifier: BSD-3-Clause
#include "graph/measured_map.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/slam6d/pose_bounds.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using slam6d::MeasuredMap;
using slam6d::smallMotion;

namespace {
/** 95 % quantile of the standard normal distribution. */
constexpr double kNormalOf95 = 1.6448536269514722;

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

double
boundPoses(const std::vector<Eigen::Isometry3d>& T_world_scan,
           MapVerification& map,
           unsigned int num_threads,
           const std::vector<Matrix6>& frames,
           double least_factor)
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
    return least_factor;
  MeasuredMap measured = slam6d::measuredMapOf(T_world_scan, map);
  const std::vector<std::size_t>& scans = measured.scans;
  if (scans.size() < 2)
    return least_factor;
  const double factor = std::max(least_factor, slam6d::varianceFactorOf(measured));
  PoseGraphOptions options;
  options.num_threads = num_threads;
  discountContradictions(options, measured);
  PoseGraphOptimizer optimizer(measured.graph, options);
  const PoseGraphResult& best = optimizer.optimize();
  std::vector<Matrix6> covariances;
  try {
    covariances = optimizer.marginalCovariances();
  } catch (const ComputeFailed&) {
    return factor; // links too different in size for doubles: none is better than a
                   // wrong one
  }
  const double excess = slam6d::excessOf(best, measured, factor);
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
  return factor;
}

PoseGraph
linksOfMap(const std::vector<Eigen::Isometry3d>& T_world_scan,
           const MapVerification& map,
           unsigned int num_threads,
           double least_factor)
{
  require(T_world_scan.size() == map.scans.size(),
          "poses",
          T_world_scan.size(),
          "one per scan");
  PoseGraph all;
  all.poses = T_world_scan;
  MeasuredMap measured = slam6d::measuredMapOf(T_world_scan, map);
  const std::vector<std::size_t>& scans = measured.scans;
  if (scans.size() < 2)
    return all;
  PoseGraphOptions options;
  options.num_threads = num_threads;
  discountContradictions(options, measured);
  all.links = measured.graph.links;
  PoseGraphOptimizer optimizer(measured.graph, options);
  const PoseGraphResult& best = optimizer.optimize();
  const double excess = slam6d::excessOf(
      best, measured, std::max(least_factor, slam6d::varianceFactorOf(measured)));
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
