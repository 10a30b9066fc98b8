// SPDX-License-Identifier: BSD-3-Clause
#include "drive/vibration.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::simulation {
namespace {
constexpr double kLowestShake = 1; // [Hz]

// Gain of a cubic B-spline for a sine at its control points, with weights 1/6, 4/6,
// 1/6.
double
leftOf(double frequency, double step)
{
  return (2 + portableSinCos(2 * M_PI * frequency * step).cos) / 3;
}
} // namespace

Vibration::Vibration(double rms,
                     double lever,
                     double round,
                     double step,
                     std::uint64_t seed)
{
  Random random(mixBits(seed));
  const double octaves = portableLog(kHighestShake / kLowestShake);
  const double along = rms / std::sqrt(3.0); // each axis
  const double about = along * std::sqrt(2.0) / lever;
  for (std::size_t axis = 0; axis < sines_.size(); ++axis)
    for (std::size_t i = 0; i < kSines; ++i) {
      const double place = (static_cast<double>(i) + random.uniform()) / kSines;
      const double wanted = kLowestShake * portableExp(place * octaves);
      Sine& sine = sines_[axis][i];
      // Whole waves in a round.
      sine.frequency = std::max(1.0, std::round(wanted * round)) / round;
      sine.phase = random.uniform();
      sine.amplitude = (axis < 3 ? along : about) * std::sqrt(2.0 / kSines) /
                       leftOf(sine.frequency, step);
    }
}

Eigen::Isometry3d
Vibration::at(double time) const
{
  std::array<double, 6> shake = {};
  for (std::size_t axis = 0; axis < sines_.size(); ++axis)
    for (const auto& sine : sines_[axis]) {
      const double turns = sine.frequency * time + sine.phase;
      shake[axis] +=
          sine.amplitude * portableSinCos(2 * M_PI * (turns - std::floor(turns))).sin;
    }
  // The quaternion of a small turn, to second order.
  Eigen::Quaterniond turn(1, shake[3] / 2, shake[4] / 2, shake[5] / 2);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = turn.normalized().toRotationMatrix();
  motion.translation() << shake[0], shake[1], shake[2];
  return motion;
}

} // namespace pcl6d::simulation
