// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/random.h>
#include <pcl6d/simulation/ground_map.h>
#include <pcl6d/simulation/moving_body.h>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

constexpr int kMostBodies = 200; ///< of a kind that options may ask for

/** \brief Bodies that find their way by themselves. */
enum class BodyKind { kPerson, kCar };

/** \return "person", "car": also the names of the bodies */
const char*
toString(BodyKind kind);

/** \brief How bodies of a kind move about a scanner. */
struct WayRules {
  double slowest, fastest; ///< [m/s] a body's speed, the same all its way
  /** [m] radius of the discs that stand for it, in plan, and where their middles are along
   * its length */
  double radius;
  std::vector<double> discs;
  double keep_away; ///< [m] from the scanner to its middle, in plan, at any time
  double nearest, farthest; ///< [m] from the scanner: where it wants to go
  double shortest, longest; ///< [m] of a way from one goal to the next
};

/** \return People walk at 1.1 to 1.7 m/s (R. C. Browning et al., "Effects of obesity and sex
 * on the energetic cost and preferred speed of walking", J. Applied Physiology 100(2), 2006:
 * 1.4 m/s), cars drive at 3 to 8 m/s, as where people walk. */
WayRules
wayRules(BodyKind kind);

/** \brief Where a scanner is. */
struct ScannerTrack {
  std::vector<double> times; ///< [s] increasing
  std::vector<Eigen::Vector3d>
      places; ///< [m] at these times, z up; between them straight

  /** \throws BadArgument no time, times that do not increase, not one place for each */
  void
  validate() const;

  Eigen::Vector3d
  placeAt(double time) const;
};

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
