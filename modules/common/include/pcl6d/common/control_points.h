// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/** \file Control points of a survey, targets measured in scans, and residuals after the
 * adjustment, in plain data. io reads control points and targets, graph_relaxation computes the
 * residuals, the module run writes and reads all three. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A point with surveyed coordinates. \ingroup common */
struct ControlPoint {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< [m] in the control's frame
  std::optional<double> sigma; ///< [m] of each coordinate; empty: the default
};

/** \brief The centre of a target, measured in one scan. \ingroup common */
struct ScanTarget {
  std::string name;                                   ///< of the target's control point
  std::size_t scan = 0;                               ///< index of the scan
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< [m] in the scan's own frame
};

/** \brief How the target of a control point was used. */
enum class ControlUse {
  kControl,  ///< a constraint of the adjustment
  kCheck,    ///< held back: compared with the adjusted poses only
  kRejected, ///< an outlier, found by the residual
  kUnused    ///< the scan is not connected with the rest of the map
};

/** \return "control", "check", "rejected" or "unused" */
const char*
toString(ControlUse use);
/** \throws BadArgument another name; the message lists the valid names */
ControlUse
controlUseFromName(const std::string& name);

/** \brief A target of a control point after the adjustment. \ingroup common */
struct ControlResidual {
  std::string name;
  std::size_t scan = 0; ///< index of the scan
  ControlUse use = ControlUse::kControl;
  /** [m] T_control_scan target - control point */
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();
  /** residual in standard deviations, scaled: the limit of the test is 3.29 (0.1 % of correct
   * points exceed the limit); 0: the point is not controlled */
  double standardised = 0;
  /** [m] least error of the point that the test reveals with 80 %, in the worst direction;
   * infinite: some direction is not controlled */
  double detectable = std::numeric_limits<double>::infinity();
};

/** \brief The adjustment of a map to control points. \ingroup common */
struct ControlResult {
  bool adjusted = false;                   ///< poses are in the control's frame
  std::string reason;                      ///< why not; else empty
  std::string doubt;                       ///< why a blunder is not certain; else empty
  std::vector<ControlResidual> residuals;  ///< in the order of the targets
  std::vector<std::string> without_target; ///< control points without a measured target
  std::vector<std::string> without_control; ///< targets without a control point
  /** frame of the initial poses, seen from the frame of the control points [m] */
  Eigen::Isometry3d T_control_initial = Eigen::Isometry3d::Identity();
  /** squared standardised residuals per degree of freedom; about 1 where sigmas are right */
  double variance_factor = 0;
  double largest_change = 0; ///< [m] largest displacement of a link
  /** [m] per scan: longest half axis of the 95 % ellipsoid of the position in the control frame;
   * empty for disconnected scans */
  std::vector<std::optional<double>> bounds;

  /** \return root mean square length [m] of the residuals of a kind; empty without such
   * residuals */
  std::optional<double>
  rms(ControlUse use) const;

  /** \return the largest length [m] of the residuals of a kind; empty without such residuals */
  std::optional<double>
  largest(ControlUse use) const;

  /** \return the names of points with a rejected target, each once */
  std::vector<std::string>
  rejected() const;
};

} // namespace pcl6d
