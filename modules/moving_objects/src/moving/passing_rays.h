// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sight_votes.h"
#include "tested_positions.h"

#include <pcl6d/search/point_tree.h>

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file Rays that pass beside a surface by chance. Rays a gap g apart miss a surface of seen extents
 * w and h with probability 1 - min(1, w / g) min(1, h / g). */
namespace pcl6d::moving_objects {

/** \brief The surface that a scan measured at its places, as other scans see it. Keeps references. */
class PassingRays {
public:
  /** \param[in] tree over all places */
  PassingRays(const TestedPositions& observed,
              const ObserverVotes& votes,
              const PointTree& tree)
  : observed_(observed), votes_(votes), tree_(tree)
  {}

  /** \return whether the rays of all scans may have passed beside the places that they missed, by
   * chance, independently for each scan. A surface seen at a flat angle, like the edge of a platform,
   * has almost no width. A cluster that another scan hit, like a pole or the top of a table, is passed
   * beside unless one of the scans must have hit it.
   * \param[in] telling observers whose misses count, a bit for each */
  bool
  isPassedBeside(const std::vector<std::size_t>& cluster, std::uint16_t telling) const;

  /** \return the probability that no ray of an observer meets the surface at places */
  double
  chanceToPassBeside(const std::vector<std::size_t>& places,
                     const Observer& observer) const;

private:
  Eigen::Matrix3d
  spreadOfPlace(std::size_t place) const;

  const TestedPositions& observed_;
  const ObserverVotes& votes_;
  const PointTree& tree_;
};

} // namespace pcl6d::moving_objects
