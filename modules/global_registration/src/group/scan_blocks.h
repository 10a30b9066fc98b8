// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "group/scan_group.h"
#include "pair/place_hypotheses.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::global_registration {

/** \brief A relative pose of two groups. */
struct BlockPlace {
  Eigen::Isometry3d T_group_block = Eigen::Isometry3d::Identity();
  double strength = 0;    ///< of the hypotheses for the pose
  double score = 0;       ///< overlap of every scan, less contradictions
  std::size_t fixing = 0; ///< index in the block of the scan with most overlap
  JointSupport support;   ///< of that scan
};

/** \brief Tests a relative pose of two groups by every scan of both. */
void
evaluateBlock(const ScanGroup& group, const ScanGroup& block, BlockPlace& place);

/** \brief Relative poses of two groups, from the hypotheses between their scans.
 * \return the best first, tested */
std::vector<BlockPlace>
placesOfBlock(const ScanGroup& group,
              const ScanGroup& block,
              const PlaceHypotheses& hypotheses,
              unsigned int num_threads);

/** \return whether a block with a pose on the rest has a second pose that fits as well
 * \param[in] max_ambiguity largest score of the second pose / score of the present pose */
bool
fitsElsewhere(const ScanGroup& rest,
              const ScanGroup& block,
              const PlaceHypotheses& hypotheses,
              double max_ambiguity,
              unsigned int num_threads);

/** \return the relative pose of two groups, if unique
 * \param[out] why the reason if not unique, in words */
std::optional<BlockPlace>
onlyPlaceOfBlock(const ScanGroup& group,
                 const ScanGroup& block,
                 const PlaceHypotheses& hypotheses,
                 double max_ambiguity,
                 unsigned int num_threads,
                 Rejection& why);

/** \return whether two poses of a block are equal within the tolerance */
bool
areSameBlockPlaces(const ScanGroup& block,
                   const Eigen::Isometry3d& a,
                   const Eigen::Isometry3d& b);

} // namespace pcl6d::global_registration
