// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"
#include "evaluate/changes/changes_source.h"

#include <pcl6d/common/map_verification.h>
#include <pcl6d/moving_objects/run_alignment.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Both runs in the world of A, and the evidence for their alignment. */
struct CommonWorld {
  ComparedRun a, b;       ///< relative to the world offset of A
  std::string source;     ///< "given", "poses", "copies" or "search"
  RunAlignment alignment; ///< its motion comes from `source`
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity(); ///< full coordinates
  std::vector<LinkCheck> links; ///< from: a scan of A, to: a scan of B
  std::string doubt;            ///< reason to doubt the alignment, in words; else empty

  /** \return the number of links with a trust */
  std::size_t
  count(LinkTrust trust) const;
};

/** \brief Transforms B into the world of A: with given poses, by scans common to both
 * runs, by the unchanged poses if links between the runs confirm them, else by
 * placeRun().
 * \param[in] show may throw
 * \throws ComputeFailed the runs could not be aligned */
CommonWorld
commonWorld(const ChangesSettings& settings,
            const ComparedRuns& runs,
            const ProgressCallback& show);

} // namespace pcl6d::app
