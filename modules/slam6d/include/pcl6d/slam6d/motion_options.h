// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of the motion within scans, which Slam6D finds if scans come with the times
 * of their points. */
struct MotionOptions {
  /** [s] a pose about every so many seconds of a scan, at least one at its begin and one at its
   * end, with constant velocity between; none: every third of a second, at
   * most 41 in all. > 0, and at least a 120th of the time of each scan */
  std::optional<double> knots;
  /** with InitialGuess::kGlobal: where scans have moved, each starts from the one before by
   * the motion that was found, in place of all being looked at together */
  bool gives_poses = false;
  /** scans that move will follow ones that are registered or have no times: the last ten of these
   * are kept with all of their points, so that the first that moves is compared with them */
  bool keep_still = false;
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief The times of a scan's points. */
struct ScanTimes {
  std::vector<double> times;   ///< [s] since the stamp, one per point, in any order
  std::optional<double> stamp; ///< [s] none: the scan begins when the one before ends
};

} // namespace pcl6d
