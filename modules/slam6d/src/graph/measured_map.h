// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/map_verification.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/graph_relaxation/link_error.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>
#include <pcl6d/registration/twist.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

/** \file The links of a verified map as measurements of relative poses. */
namespace pcl6d::slam6d {

/** The scans connected with the first scan, and the links that measure their poses. */
struct MeasuredMap {
  std::vector<std::size_t> scans; ///< number of each vertex in the map, ascending
  PoseGraph graph; ///< each link measures the shift of its scans by their surfaces
  std::vector<const LinkCheck*> links; ///< of the graph, in the map that was given
  bool are_refined = false;            ///< some links are those of refined matches
};

/** \return what the links measure; without scans if the first scan is disconnected. Keeps pointers
 * to the links of the map */
MeasuredMap
measuredMapOf(const std::vector<Eigen::Isometry3d>& T_world_scan,
              const MapVerification& map);

/** \brief Lets refined links that contradict the others count with the error that they show (the
 * Danish method of geodesy: T. Krarup, J. Juhl, K. Kubik, "Goetterdaemmerung over least squares
 * adjustment", ISPRS 1980). Pairs of few surfaces come to rest elsewhere, off by hundreds of their
 * deviations: one such link would widen the bounds of the whole map. No effect without refined
 * links. */
void
discountContradictions(const PoseGraphOptions& options, MeasuredMap& measured);

/** \return mean squared shift required by surfaces, in standard deviations: above 1 the links'
 * covariances are too small (a posteriori variance factor of geodesy). Weakly constrained scans keep
 * moving in one direction when surface shifts are followed, which no cycle reveals. Shifts of refined
 * maps count up to the largest by chance: links of a few scans that agree on a larger one show an
 * error of the map, the way to the optimum. */
double
varianceFactorOf(const MeasuredMap& measured);

/** \return the factor on the covariances from the links. Reasons: cycles do not close, surfaces
 * require larger shifts than the covariances allow, and links of a scan share its errors: m links
 * of a scan have the information of sqrt(m) independent links, which fits the NEES of simulated
 * scenes. What is left of the errors of refined links lies in the planes of a scan, equal in all of
 * its links, and closes every cycle: m links have the information of one.
 * \param[in] result of the optimisation of the graph \param[in] factor of varianceFactorOf() */
double
excessOf(const PoseGraphResult& result, const MeasuredMap& measured, double factor);

/** \return T as a small motion: translation, and twice the vector part of the quaternion */
Twist
smallMotion(const Eigen::Isometry3d& T);

} // namespace pcl6d::slam6d
