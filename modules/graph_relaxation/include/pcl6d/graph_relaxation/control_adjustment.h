// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/control_points.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/pose_graph.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of the adjustment to control points. */
struct ControlOptions {
  std::vector<ControlPoint> points; ///< none: no adjustment
  std::vector<ScanTarget> targets;
  std::vector<std::string> checks; ///< names of the check points
                                   ///< among the control points
  /** [m] standard deviation of each coordinate of a control point without its own value;
   * finite, > 0. 2 mm: a total station at 50 m, 5 seconds of arc and 2 mm of distance */
  double control_sigma = 0.002;
  /** [m] standard deviation of each coordinate of a target in its scan; finite, > 0. 2 mm: the
   * accuracy of target acquisition in data sheets of terrestrial scanners */
  double target_sigma = 0.002;
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value; fewer than 3 control
   * points with targets besides the check points, or on one line; a check that is no control
   * point or has no target; targets without control points; a point twice, a target twice in
   * one scan, a non-finite coordinate
   * \param[in] num_scans a target's scan must be below */
  void
  validate(std::size_t num_scans) const;
};

/** \brief Result of the adjustment to control points. */
struct ControlAdjustment {
  ControlResult result;
  std::vector<Eigen::Isometry3d> poses; ///< T_control_scan; the input
                                        ///< if the adjustment failed
  /** per scan, for small motions (translation [m], rotation [rad]) in its own axes, relative to
   * the frame of the control points; empty for scans disconnected from the first */
  std::vector<std::optional<Eigen::Matrix<double, 6, 6>>> covariances;
};

/** \brief Adjusts a map to control points: every pose at once, by least squares.
 *
 * Observations are the links, with their information, and for each target of a control point r
 * = T_control_scan target - point. The error of the point is common to its targets: covariance
 * of the targets k, l of a point: (target_sigma^2 delta_kl + sigma^2) I. The result is in the
 * frame of the control points.
 *
 * The start is robust: among motions from three points each, the motion with the least sum over
 * the smaller half of the squared distances. Then points that fit their prediction are added.
 * Blunders are removed one by one by the largest standardised residual: of a point (wrong
 * coordinates) or of a single target (a wrong measurement).
 *
 * A scan disconnected from the first scan moves with the nearest earlier connected scan.
 * Bit-identical for any number of threads.
 * \param[in] map poses T_world_scan and the links between them
 * \return adjusted is false, with the input poses, if fewer than three fitting control points
 * remain
 * \throws BadArgument invalid options or graph
 * \note Sources: W. Baarda, "A testing procedure for use in geodetic networks", Netherlands
 * Geodetic Commission 2(5), 1968 (data snooping, detectable errors with significance 0.1 % and
 * power 80 %); P. J. G. Teunissen, "Testing theory", Delft 2000 (tests of several dimensions);
 * W. Foerstner, "Reliability analysis of parameter estimation in linear models", CVGIP 40, 1987
 * (redundancy numbers below 0.01: not controlled); P. J. Rousseeuw, K. Van Driessen, "A fast
 * algorithm for the minimum covariance determinant estimator", Technometrics 41(3), 1999
 * (concentration steps of the start)
 * \ingroup graph_relaxation */
ControlAdjustment
adjustToControl(const PoseGraph& map, const ControlOptions& options);

} // namespace pcl6d
