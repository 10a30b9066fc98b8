// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

constexpr int kMostBodies = 200; ///< largest number of bodies of a kind

constexpr double kLongestTrack = 1e5; ///< [s] more than a day

/** \brief Bodies with generated ways. */
enum class BodyKind { kPerson, kCar };

/** \return "person", "car": also the names of the bodies */
const char*
toString(BodyKind kind);

/** \brief Rules for the motion of bodies of a kind about a scanner. */
struct WayRules {
  double slowest, fastest; ///< [m/s] a body's speed, constant along its way
  /** [m] radius of the discs that represent a body, in plan, and positions of their
   * middles along its length */
  double radius;
  std::vector<double> discs;
  double keep_away; ///< [m] from the scanner to its middle, in plan, at any time
  double nearest, farthest; ///< [m] from the scanner to goals
  double shortest, longest; ///< [m] of a way from one goal to the next
};

/** \return the rules of a kind. People walk at 1.1 to 1.7 m/s (R. C. Browning et al.,
 * "Effects of obesity and sex on the energetic cost and preferred speed of walking", J.
 * Applied Physiology 100(2), 2006: 1.4 m/s), cars drive at 3 to 8 m/s, typical of
 * pedestrian zones. */
WayRules
wayRules(BodyKind kind);

/** \brief Positions of a scanner over time. */
struct ScannerTrack {
  std::vector<double> times;           ///< [s] increasing
  std::vector<Eigen::Vector3d> places; ///< [m] at the times, z up; linear in between

  /** \throws BadArgument no time, times that do not increase, not one place per time,
   * or longer than kLongestTrack */
  void
  validate() const;

  Eigen::Vector3d
  placeAt(double time) const;
};

} // namespace pcl6d
