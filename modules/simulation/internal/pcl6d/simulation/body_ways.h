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

/** \brief Generates the ways of bodies around a scanner.
 *
 * Each body goes from goal to goal, on free floor in view of the scanner. It keeps the
 * distance to the scanner and other bodies required by its rules, and waits where it
 * cannot go on. A body left behind, or in the way of an approaching scanner, leaves,
 * and another body appears at once: a jump of the same body.
 * \ingroup simulation */
class BodyWays {
public:
  /** Draws a position in view of the scanner at a time, in plan, between two distances
   * [m] from the scanner. */
  using GoalAt = std::function<
      Eigen::Vector2d(double time, double nearest, double farthest, Random& random)>;

  /** Keeps a reference to the map. \throws BadArgument see ScannerTrack::validate() */
  BodyWays(const GroundMap& map, ScannerTrack track, GoalAt goalAt);

  /** \brief Adds an existing body, which new bodies keep away from. */
  void
  addOther(const MovingBody& body);

  /** \brief Generates the way of one more body.
   * \param[in] seed equal seeds give equal ways
   * \return with shape, way and times from the start to the end of the track
   * \throws ComputeFailed no room for the body */
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
