// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surfels/remaining_surfels.h"

#include <pcl6d/common/export.h>
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

/** \brief Voting of surfels for every plane through them. */
struct HoughVoteOptions {
  double offset_cell = 0.1;    ///< [m]
  double max_angle = 0.35;     ///< [rad] between the normals of a plane and of a surfel
  std::uint32_t min_votes = 1; ///< cells with fewer are left out
  unsigned int num_threads = 0;
};

/** \brief Lets each surfel vote for every plane through it.
 * \return the cells by falling count, then by direction and offset */
PCL6D_EXPORTS std::vector<HoughCell> // exported for its test
voteForAll(const SurfelColumns& surfels,
           const AccumulatorBall& ball,
           const HoughVoteOptions& options);

/** \brief For each cell of an accumulator ball, the cells within an angle: surfels of
 * one cell vote for planes of the other. */
class FacingDirections {
public:
  /** \param[in] max_angle [rad] between the centres of the cells */
  FacingDirections(const AccumulatorBall& ball,
                   double max_angle,
                   unsigned int num_threads);

  /** \return the cells for a direction, ascending, itself included */
  const std::vector<std::uint32_t>&
  of(std::size_t direction) const
  {
    return facing_[direction];
  }

  /** \return the direction in the middle of a cell, unit length */
  const Eigen::Vector3f&
  centre(std::size_t cell) const
  {
    return centres_[cell];
  }

private:
  std::vector<Eigen::Vector3f> centres_;
  std::vector<std::vector<std::uint32_t>> facing_;
};

/** \brief Votes that are counted batch by batch, and may be taken back. */
class PCL6D_EXPORTS HoughVotes { // exported for its test
public:
  /** Keeps a reference to the ball. \param[in] options min_votes is ignored */
  HoughVotes(const AccumulatorBall& ball, const HoughVoteOptions& options);

  /** \brief Lets each surfel vote for every plane through it. */
  void
  add(const SurfelColumns& surfels)
  {
    count(surfels, 1);
  }

  /** \brief Takes back the votes of surfels, which must have voted. */
  void
  remove(const SurfelColumns& surfels)
  {
    count(surfels, -1);
  }

  /** \return the cells with at least min_votes, ordered like voteForAll(); min_votes is
   * at least one */
  std::vector<HoughCell>
  cells(std::uint32_t min_votes) const;

  /** \return the number of votes for planes of a direction */
  std::uint64_t
  votesFor(std::size_t direction) const;

private:
  struct Count {
    std::int32_t offset;
    std::uint32_t votes;
  };

  void
  count(const SurfelColumns& surfels, int sign);

  const AccumulatorBall& ball_;
  HoughVoteOptions options_;
  FacingDirections facing_;
  std::vector<std::vector<Count>> rows_; // of each direction, by offset
};

/** \return the largest distance of a surfel from the origin in cells of this size [m],
 * rounded up */
std::int32_t
reachOf(const SurfelColumns& surfels, double cell);

/** \brief Iterates over the peaks of the votes: the cell with most votes outside the
 * windows of previous peaks. */
class HoughPeaks {
public:
  /** \param[in] cells see voteForAll() \param[in] steps half size of the window about a
   * peak, in direction and in offset */
  HoughPeaks(std::vector<HoughCell> cells, const AccumulatorBall& ball, int steps)
  : cells_(std::move(cells)), ball_(ball), steps_(steps)
  {}

  /** \return the next peak; null at the end */
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
