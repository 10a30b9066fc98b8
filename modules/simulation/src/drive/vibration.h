// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>

namespace pcl6d::simulation {

constexpr double kHighestShake = 10; // [Hz]

/** \brief A small motion, periodic over a round: see RobotMotionOptions::vibration. */
class Vibration {
public:
  /** \param[in] rms [m] displacement \param[in] lever [m] between the contacts
   * \param[in] round [s] period \param[in] step [s] between the control points of a
   * cubic B-spline through the motion; its damping is compensated */
  Vibration(double rms, double lever, double round, double step, std::uint64_t seed);

  /** \return the sensor's motion in its own frame */
  Eigen::Isometry3d
  at(double time) const;

private:
  static constexpr std::size_t kSines = 8;
  struct Sine {
    double frequency; // [Hz]
    double phase;     // turns
    double amplitude; // [m] or [rad]
  };
  std::array<std::array<Sine, kSines>, 6> sines_; // along, then about x, y, z
};

} // namespace pcl6d::simulation
