// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/localizability.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Where a link between two scans comes from. */
enum class LinkKind {
  kSequence, ///< a scan and the next one
  kNetwork,  ///< scans that see the same places (book 6.3)
  kLoop,     ///< a closed loop (book 5.1.2)
  kGiven     ///< by the user
};

/** \return "sequence", "network", "loop" or "given" */
const char*
toString(LinkKind kind);

/** \brief What became of a link. */
enum class LinkVerdict {
  kUsed,     ///< it counts
  kOdometry, ///< its scans do not fix it: their predicted relative pose counts instead
  kRefused   ///< it does not count
};

/** \return "used", "odometry" or "refused" */
const char*
toString(LinkVerdict verdict);

/** \brief Two scans that may see the same places, and what is known of it: every
 * candidate is kept, with its verdict and the reason. \ingroup graph_relaxation */
struct ScanLink {
  std::size_t from = 0;
  std::size_t to = 0;
  LinkKind kind = LinkKind::kNetwork;
  LinkVerdict verdict = LinkVerdict::kUsed;
  std::string reason;  ///< of a verdict other than kUsed
  double distance = 0; ///< [m] between the two positions
  std::size_t pairs = 0;
  double rms = 0;       ///< [m] of these pairs
  double overlap = 0;   ///< share of points with a partner
  double condition = 0; ///< smallest eigenvalue of the Localizability, in [0, 1]
  double weight = 1;    ///< what robust switching left of it, in [0, 1]
  /** of a loop: the pose of `to` seen from `from`, as matched */
  std::optional<Eigen::Isometry3d> T_from_to;
};

} // namespace pcl6d
