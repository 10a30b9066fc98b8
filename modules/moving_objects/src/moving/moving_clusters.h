// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sight_votes.h"
#include "tested_positions.h"

#include <pcl6d/search/point_tree.h>

#include <cstdint>
#include <vector>

namespace pcl6d::moving_objects {

/** \brief Clusters places with misses, and classifies the clusters as dynamic or static (see
 * MovingPoints). */
class MovingClusters {
public:
  /** Keeps references. */
  MovingClusters(const TestedPositions& observed,
                 const ObserverVotes& votes_of_observers,
                 unsigned int num_threads);

  /** \return one per place */
  std::vector<PointMotion>
  decide();

private:
  struct Mover {
    std::uint16_t stayed;   ///< observers of the object while at rest
    Eigen::Vector3f middle; ///< [m] of the places with misses
    float reach;            ///< [m] largest distance of its surface from the middle
  };

  float
  reachOf(std::size_t place) const;
  std::vector<Neighbour>
  near(std::size_t place) const;
  bool
  isCandidate(std::size_t place) const;
  bool
  isHit(std::size_t place) const;
  void
  findClusters();
  bool
  moves(const std::vector<std::size_t>& cluster) const;
  bool
  wasGone(const std::vector<std::size_t>& cluster, std::uint16_t telling) const;
  std::uint16_t
  stayedFor(const std::vector<std::size_t>& cluster) const;
  void
  grow();
  bool
  isSideOf(const Mover& mover, std::size_t place) const;
  int
  ownerOf(std::size_t place, bool is_near) const;
  void
  dropParts();

  const TestedPositions observed_;
  const ObserverVotes& observer_votes_;
  const std::vector<Votes>& votes_;
  unsigned int num_threads_;
  PointTree tree_;
  std::vector<std::size_t> candidates_;
  std::vector<int> mover_; ///< of each place; -1: none
  std::vector<Mover> movers_;
  std::vector<int> excess_; ///< misses less twice the lasting hits
};

} // namespace pcl6d::moving_objects
