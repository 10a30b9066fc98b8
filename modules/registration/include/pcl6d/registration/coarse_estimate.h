// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>

#include <Eigen/Geometry>

namespace PCL6D_EXPORTS pcl6d {

/** \brief An initial pose for ICP, with its reliability.
 *
 * kOk: one placement, clearly better than any other. kRankDeficient: a clearly
 * different placement is nearly as good (repeated structure, a corridor, one plane);
 * the transform is the best placement. kTooFewPairs: no matches, or the best placement
 * explains too little; the transform is the guess or the identity, the score is the
 * best found. Only kOk may be used without further evidence. \ingroup registration */
struct CoarseEstimate {
  Status status = Status::kTooFewPairs;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  double score = 0;        ///< share of the source with partners in the
                           ///< target, in [0, 1]
  double second_score = 0; ///< score of the best clearly different placement found

  /** \return second_score / score, in [0, 1]: near 1 for two equally good placements */
  double
  ambiguity() const
  {
    return score > 0 ? second_score / score : 0;
  }
};

} // namespace pcl6d
