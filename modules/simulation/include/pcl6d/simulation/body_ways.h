// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/random.h>
#include <pcl6d/simulation/ground_map.h>
#include <pcl6d/simulation/moving_body.h>
#include <pcl6d/simulation/way_rules.h>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Lays the ways of bodies around a scanner.
 *
 * Each goes from goal to goal, on floor that is free, where the scanner sees it, and never
 * nearer to the scanner or to another body than its rules say; where it cannot go on it
 * waits. Who is left behind, or in the way of a scanner that comes on, leaves, and another
 * one comes, at once: a jump of the same body.
 * \ingroup simulation */
class BodyWays {
public:
  /** A place in view of the scanner at a time, in plan, between two distances from it [m]. */
  using GoalAt = std::function<
      Eigen::Vector2d(double time, double nearest, double farthest, Random& random)>;

  /** Keeps a reference to the map. \throws BadArgument see ScannerTrack::validate() */
  BodyWays(const GroundMap& map, ScannerTrack track, GoalAt goalAt);

  /** \brief Lets others keep out of the way of a body that is already there. */
  void
  addOther(const MovingBody& body);

  /** \brief Lays the way of one more body.
   * \param[in] seed same seed, same way
   * \return with shape, way and times from the start to the end of the track
   * \throws ComputeFailed there is no room for it */
  MovingBody
  add(BodyKind kind, std::uint64_t seed);

private:
  struct Other {
    MovingBody body;
    double radius; // [m] in plan, around its origin
  };
  struct Walker;

  bool
  fits(const WayRules& rules,
       const Eigen::Vector2d& place,
       const Eigen::Vector2d& ahead) const;
  bool
  meetsNobody(const WayRules& rules, const Eigen::Vector2d& place, double time) const;
  bool
  isLegal(const Walker& walker,
          const std::vector<Eigen::Vector2d>& corners,
          double time) const;
  bool
  appear(Walker& walker, double time) const;
  bool
  goOn(Walker& walker) const;
  bool
  waitAWhile(Walker& walker) const;
  bool
  stepAside(Walker& walker, double time) const;
  bool
  isLeftBehind(const Walker& walker) const;
  void
  follow(Walker& walker, const std::vector<Eigen::Vector2d>& corners) const;
  bool
  complete(Walker& walker) const;
  std::optional<Walker>
  liveliest(BodyKind kind, std::uint64_t seed) const;

  const GroundMap& map_;
  ScannerTrack track_;
  GoalAt goalAt_;
  std::vector<Other> others_;
};

} // namespace pcl6d
