// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>

#include <Eigen/Geometry>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A first guess for ICP, and how far it can be believed.
 *
 * kOk: one placement, clearly better than all others. kRankDeficient: a clearly
 * different one is nearly as good (repeated structure, a corridor, one plane); the
 * transform is the best. kTooFewPairs: nothing to match, or the best placement explains
 * too little; the transform is the guess or the identity, the score that of the best.
 * Only kOk may be used without other evidence. \ingroup registration */
struct CoarseEstimate {
  Status status = Status::kTooFewPairs;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  double score = 0;        ///< share of the source that meets the target, in [0, 1]
  double second_score = 0; ///< that of the best clearly different placement found

  /** \return second_score / score, in [0, 1]: near 1 when two placements are as good */
  double
  ambiguity() const
  {
    return score > 0 ? second_score / score : 0;
  }
};

} // namespace pcl6d
