// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/status.h>
#include <pcl6d/registration/pose_covariance.h>
#include <pcl6d/registration/rigid_minimiser.h>
#include <pcl6d/search/point_tree.h>

#include <functional>

namespace pcl6d {

/** \brief Knobs of ICP. Defaults suit scans with 1 cm to 10 cm point spacing. */
struct IcpOptions {
  int max_iterations = 100;      ///< > 0
  double max_distance = 0.25;    ///< [m] farther pairs are dropped; > 0
  double max_distance_start = 0; ///< [m] the limit at the start, which then shrinks to
                                 ///< max_distance; 0: max_distance from the start
  double distance_decay = 0.9;   ///< the limit's factor per iteration; in (0, 1)
  double translation_epsilon = 1e-4; ///< [m] stop at a step no longer ...
  double rotation_epsilon = 1e-5;    ///< [rad] ... that also turns no more; >= 0
  unsigned int num_threads = 0;      ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief One iteration, as an observer sees it. */
struct IcpIteration {
  int number = 0;          ///< from 1
  std::size_t pairs = 0;   ///< pairs within max_distance
  double rms = 0;          ///< [m] of these pairs, before the step
  double max_distance = 0; ///< [m] the limit of this iteration
  double translation = 0;  ///< [m] length of the step
  double rotation = 0;     ///< [rad] angle of the step
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity(); ///< after the step
};

/** \brief Called after each iteration. \return false to stop (status kMaxIterations) */
using IcpObserver = std::function<bool(const IcpIteration&)>;

/** \brief The outcome of ICP. */
struct IcpResult {
  Status status = Status::kTooFewPairs; ///< kOk: the step was within both thresholds
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  int iterations = 0;
  std::size_t pairs = 0; ///< pairs at the final pose within max_distance
  double rms = 0;        ///< [m] of these pairs
  double overlap = 0;    ///< pairs / finite source points, in [0, 1]
  std::optional<PoseCovariance> covariance; ///< of T_target_source, if the pairs fix it
};

/** \brief Point-to-point ICP (book 4.1): closest pairs within a limit, closed-form
 * motion, until the motion stops.
 *
 * The same bits for any number of threads: blocks of 1024 source points, merged in a
 * fixed order (4.1.6). The limit may shrink from max_distance_start to max_distance
 * (4.1.5); the iteration does not stop before it has arrived there. Source points that
 * are not finite are skipped. \param[in] target tree of the model points \param[in]
 * target_points the points that the tree was built from \param[in] source data points
 * in their own frame \param[in] guess T_target_source to start from \return never
 * throws on data. kTooFewPairs and kDiverged return the guess, kRankDeficient and
 * kMaxIterations the last iterate \throws BadArgument an option breaks its rule
 * \ingroup registration */
IcpResult
icp(const PointTree& target,
    const Points& target_points,
    const Points& source,
    const Eigen::Isometry3d& guess,
    const IcpOptions& options,
    const RigidMinimiser& minimiser = minimiseByQuaternion,
    const IcpObserver& observer = {});

} // namespace pcl6d
