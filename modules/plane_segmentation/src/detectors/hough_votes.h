// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surfels/remaining_surfels.h"

#include <pcl6d/plane_segmentation/accumulator_ball.h>

#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

namespace pcl6d::plane_segmentation {

/** \brief A cell of the Hough transform and its votes. */
struct HoughCell {
  std::size_t direction = 0; ///< cell of the accumulator ball
  std::int32_t offset = 0;   ///< floor(normal . p / size of a cell)
  std::uint32_t votes = 0;
};

/** \brief How surfels vote for all planes through them. */
struct HoughVoteOptions {
  double offset_cell = 0.1;    ///< [m]
  double max_angle = 0.35;     ///< [rad] between a plane's normal and that of a surfel
  std::uint32_t min_votes = 1; ///< cells with fewer are left out
  unsigned int num_threads = 0;
};

/** \brief Lets each surfel vote for all planes through it.
 * \return the cells by falling count, then by direction and offset */
std::vector<HoughCell>
voteForAll(const SurfelColumns& surfels,
           const AccumulatorBall& ball,
           const HoughVoteOptions& options);

/** \brief The peaks of the votes, one after the other: the cell with most votes that is
 * in no window of a peak before. */
class HoughPeaks {
public:
  /** \param[in] cells as of voteForAll() \param[in] steps that the window about a peak
   * reaches to each side, in direction and in offset */
  HoughPeaks(std::vector<HoughCell> cells, const AccumulatorBall& ball, int steps)
  : cells_(std::move(cells)), ball_(ball), steps_(steps)
  {}

  /** \return the next peak; null: there is none */
  const HoughCell*
  next();

private:
  std::vector<HoughCell> cells_;
  const AccumulatorBall& ball_;
  int steps_;
  std::size_t next_ = 0;
  std::unordered_set<std::int64_t> covered_; // by windows
};

} // namespace pcl6d::plane_segmentation
