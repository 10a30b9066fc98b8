// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Options of the estimation of motion within scans, which requires scans with the times of
 * their points. */
struct MotionOptions {
  /** [s] time between the estimated poses of a scan, the first at its beginning and the last at its
   * end, with constant velocity between poses; none: a third of a second, with at most 41 poses. >
   * 0, and at least a 120th of the duration of each scan */
  std::optional<double> knots;
  /** with InitialGuess::kGlobal: if scans were in motion, each scan starts from the previous scan
   * by the estimated motion, instead of place recognition */
  bool gives_poses = false;
  /** scans in motion follow registered or untimed scans: the last ten of the latter are kept with
   * all of their points, to match the first scan in motion */
  bool keep_still = false;
  /** \throws BadArgument naming the first invalid field, with its value */
  void
  validate() const;
};

/** \brief The times of a scan's points. */
struct ScanTimes {
  std::vector<double> times;   ///< [s] since the stamp, for each point, in any order
  std::optional<double> stamp; ///< [s] none: the scan begins at the end of the previous
                               ///< scan
};

} // namespace pcl6d
