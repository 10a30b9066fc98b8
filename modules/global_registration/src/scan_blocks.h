// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "place_hypotheses.h"
#include "scan_group.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::global_registration {

/** \brief A place of a group on another one. */
struct BlockPlace {
  Eigen::Isometry3d T_group_block = Eigen::Isometry3d::Identity();
  double strength = 0;    ///< of the hypotheses that say so
  double score = 0;       ///< overlap of all its scans, less what contradicts them
  std::size_t fixing = 0; ///< place in the block of the scan that meets most
  JointSupport support;   ///< of that scan
};

/** \brief Judges a place of a group by all scans of both. */
void
judgeBlock(const ScanGroup& group, const ScanGroup& block, BlockPlace& place);

/** \brief Places of a group on another one, by the hypotheses between their scans.
 * \return the best first, judged */
std::vector<BlockPlace>
placesOfBlock(const ScanGroup& group,
              const ScanGroup& block,
              const PlaceHypotheses& hypotheses,
              unsigned int num_threads);

/** \return whether a block that has a place on the rest fits it elsewhere as well
 * \param[in] max_ambiguity score of the other place / that of the place it has, at most */
bool
fitsElsewhere(const ScanGroup& rest,
              const ScanGroup& block,
              const PlaceHypotheses& hypotheses,
              double max_ambiguity,
              unsigned int num_threads);

/** \return the place of a group on another one, if no other is nearly as good
 * \param[out] why there is none, in words */
std::optional<BlockPlace>
onlyPlaceOfBlock(const ScanGroup& group,
                 const ScanGroup& block,
                 const PlaceHypotheses& hypotheses,
                 double max_ambiguity,
                 unsigned int num_threads,
                 std::string& why);

/** \return whether two places bring the scans of a block to the same place */
bool
areSameBlockPlaces(const ScanGroup& block,
                   const Eigen::Isometry3d& a,
                   const Eigen::Isometry3d& b);

} // namespace pcl6d::global_registration
