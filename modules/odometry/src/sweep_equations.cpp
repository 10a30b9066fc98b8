// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_equations.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/rotation.h>

#include <array>
#include <cmath>

namespace pcl6d::odometry {

namespace {
Matrix6
full(const Matrix6& lower)
{
  return lower.selfadjointView<Eigen::Lower>();
}

/** \return the motion from one pose to another in world axes, about a centre */
Twist
errorAbout(const Eigen::Vector3d& centre,
           const Eigen::Isometry3d& found,
           const Eigen::Isometry3d& expected)
{
  Twist error;
  error.tail<3>() = rotationVector(found.linear() * expected.linear().transpose());
  const Eigen::Vector3d arm = expected.translation() - centre;
  error.head<3>() = found.translation() - expected.translation() -
                    Eigen::Vector3d(error.tail<3>()).cross(arm);
  return error;
}

/** \return the information of a motion with the deviations of the velocity, times a factor */
Matrix6
velocityInformation(const SweepPrior& prior, double factor)
{
  const double t = factor * prior.translation, r = factor * prior.rotation;
  Matrix6 information = Matrix6::Zero();
  information.diagonal() << Eigen::Vector3d::Constant(1 / (t * t)),
      Eigen::Vector3d::Constant(1 / (r * r));
  return information;
}
} // namespace

std::vector<PartSums>
added(std::vector<PartSums> a, const std::vector<PartSums>& b)
{
  for (std::size_t part = 0; part < a.size(); ++part)
    a[part] = a[part] + b[part];
  return a;
}

SweepEquations::SweepEquations(const std::vector<PartSums>& data)
{
  const auto size = static_cast<Eigen::Index>(6 * (data.size() + 1));
  normal_.setZero(size, size);
  side_.setZero(size);
  Eigen::Index at = 0;
  for (const PartSums& part : data) {
    normal_.block<6, 6>(at, at) += full(part.begin);
    normal_.block<6, 6>(at + 6, at) += full(part.mixed);
    normal_.block<6, 6>(at, at + 6) += full(part.mixed);
    normal_.block<6, 6>(at + 6, at + 6) += full(part.end);
    side_.segment<6>(at) += part.begin_side;
    side_.segment<6>(at + 6) += part.end_side;
    at += 6;
  }
}

void
SweepEquations::project(const Matrix6& fixed)
{
  for (Eigen::Index r = 0; r < side_.size(); r += 6) {
    side_.segment<6>(r) = (fixed.transpose() * side_.segment<6>(r)).eval();
    for (Eigen::Index c = 0; c < side_.size(); c += 6)
      normal_.block<6, 6>(r, c) =
          (fixed.transpose() * normal_.block<6, 6>(r, c) * fixed).eval();
  }
}

void
SweepEquations::add(const SweepPrior& prior, const SweepMotion& motion)
{
  const Matrix6& begin = prior.begin_information;
  const Twist off_begin = errorAbout(prior.centre, motion.begin, prior.motion.begin);
  normal_.topLeftCorner<6, 6>() += begin;
  side_.head<6>() += begin * off_begin;
  const Twist off_velocity =
      errorAbout(prior.centre,
                 motion.end(),
                 motion.begin * motionFromTwist(prior.motion.velocity));
  // Expected velocity, given the begin.
  const Matrix6 with_begin = prior.velocity_with_begin * begin;
  const Matrix6 uncertain = prior.velocity_covariance -
                            with_begin * prior.velocity_with_begin.transpose() +
                            inverted<6>(velocityInformation(prior, 1));
  const Matrix6 steady = inverted<6>(0.5 * (uncertain + uncertain.transpose()));
  // The centre is near the scanner: a change of its velocity is a change about the centre.
  const Matrix6 of_begin = -Matrix6::Identity() - with_begin;
  const Twist off = steady * (off_velocity - with_begin * off_begin);
  const Matrix6 mixed = of_begin.transpose() * steady;
  normal_.topLeftCorner<6, 6>() += mixed * of_begin;
  normal_.bottomRightCorner<6, 6>() += steady;
  normal_.topRightCorner<6, 6>() += mixed;
  normal_.bottomLeftCorner<6, 6>() += mixed.transpose();
  side_.head<6>() += of_begin.transpose() * off;
  side_.tail<6>() += off;
  if (side_.size() > 12)
    addSteadiness(prior, motion);
}

/** The velocity changes as a random walk from part to part; where it does, the motion bends. */
void
SweepEquations::addSteadiness(const SweepPrior& prior, const SweepMotion& motion)
{
  const Eigen::Index num_parts = side_.size() / 6 - 1;
  const auto parts = static_cast<double>(num_parts);
  const Matrix6 steady = velocityInformation(prior, 1 / (parts * std::sqrt(parts)));
  constexpr std::array<double, 3> kBend = {1, -2, 1};
  for (Eigen::Index part = 0; part + 1 < num_parts; ++part) {
    Twist bend = Twist::Zero();
    if (!motion.offsets.empty()) {
      const auto first = motion.offsets.begin() + part;
      bend = first[0] - 2 * first[1] + first[2];
    }
    bend.head<3>() = motion.begin.linear() * Eigen::Vector3d(bend.head<3>());
    bend.tail<3>() = motion.begin.linear() * Eigen::Vector3d(bend.tail<3>());
    for (std::size_t r = 0; r < 3; ++r) {
      const Eigen::Index row = 6 * (part + static_cast<Eigen::Index>(r));
      side_.segment<6>(row) += kBend[r] * steady * bend;
      for (std::size_t c = 0; c < 3; ++c)
        normal_.block<6, 6>(row, 6 * (part + static_cast<Eigen::Index>(c))) +=
            kBend[r] * kBend[c] * steady;
    }
  }
}

} // namespace pcl6d::odometry
