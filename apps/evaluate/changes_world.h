// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"
#include "evaluate/changes_source.h"

#include <pcl6d/common/map_verification.h>
#include <pcl6d/moving_objects/run_alignment.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Both runs in the world of A, and what speaks for that. */
struct CommonWorld {
  ComparedRun a, b;       ///< relative to the world offset of A
  std::string source;     ///< "given", "poses", "copies" or "search"
  RunAlignment alignment; ///< its motion is from what `source` says
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity(); ///< full coordinates
  std::vector<LinkCheck> links; ///< from: a scan of A, to: one of B
  std::string doubt;            ///< why it is not to be believed, in words; else empty

  /** \return the number of links with a trust */
  std::size_t
  count(LinkTrust trust) const;
};

/** \brief Brings B into the world of A: with poses that are given, by scans that both hold,
 * by the poses as they are if links between the runs confirm them, else by placeRun().
 * \param[in] show may throw
 * \throws ComputeFailed the runs do not meet */
CommonWorld
commonWorld(const ChangesSettings& settings,
            const ComparedRuns& runs,
            const ProgressCallback& show);

} // namespace pcl6d::app
