// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/odometry/sweep_frames.h>
#include <pcl6d/registration/twist.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

using pcl6d::SweepEnds;
using pcl6d::Twist;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace {
constexpr double kPeriod = 0.1; // [s]

/** \return sweeps along x, each with its own velocity, and with a jump before each but the first */
std::vector<SweepEnds>
sweepsOf(const std::vector<Twist>& velocities, const Twist& jump)
{
  std::vector<SweepEnds> sweeps;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (const Twist& velocity : velocities) {
    SweepEnds sweep;
    if (!sweeps.empty())
      pose = pose * pcl6d::motionFromTwist(jump);
    sweep.T_world_begin = pose;
    pose = pose * pcl6d::motionFromTwist(velocity);
    sweep.T_world_end = pose;
    sweep.end = kPeriod;
    sweep.stamp = kPeriod * static_cast<double>(sweeps.size());
    sweep.follows = !sweeps.empty();
    sweeps.push_back(sweep);
  }
  return sweeps;
}

const Twist kAhead = 0.15 * Twist::Unit(0);
} // namespace

TEST(SweepFrames, OfAnEvenMotionAreExact)
{
  for (const Matrix6& frame :
       pcl6d::frameCovariances(sweepsOf(std::vector<Twist>(12, kAhead), Twist::Zero())))
    EXPECT_LT(frame.norm(), 1e-20);
}

TEST(SweepFrames, HaveHalfTheSquaredJumpBetweenSweeps)
{
  const Twist jump = 0.01 * Twist::Unit(5);
  for (const Matrix6& frame :
       pcl6d::frameCovariances(sweepsOf(std::vector<Twist>(12, kAhead), jump)))
    EXPECT_NEAR(frame(5, 5), 0.5 * 0.01 * 0.01, 1e-9);
}

// Errors e of the ends that alternate leave no jump: the velocity is wrong by 2 e, and then by -2 e.
TEST(SweepFrames, ShowErrorsThatAlternate)
{
  constexpr double kError = 0.02;
  std::vector<Twist> velocities;
  for (int i = 0; i < 12; ++i)
    velocities.push_back(kAhead + (i % 2 == 0 ? 2 : -2) * kError * Twist::Unit(2));
  const auto frames = pcl6d::frameCovariances(sweepsOf(velocities, Twist::Zero()));
  for (std::size_t i = 1; i < frames.size(); ++i)
    EXPECT_NEAR(frames[i](2, 2), kError * kError, 1e-9) << i;
}

TEST(SweepFrames, OfAMapThatBeginsInATurnAreUncertain)
{
  std::vector<Twist> velocities(12, kAhead);
  velocities[0] += 0.06 * Twist::Unit(5);
  const auto sweeps = sweepsOf(velocities, Twist::Zero());
  EXPECT_NEAR(pcl6d::frameCovariances(sweeps)[0](5, 5), 0.015 * 0.015, 1e-9);
  EXPECT_LT(pcl6d::frameCovariances(sweeps)[6].norm(), 1e-20);
}

TEST(SweepFrames, WithoutDurationOrAcrossAGapAreUnknown)
{
  auto sweeps = sweepsOf(std::vector<Twist>(4, kAhead), 0.01 * Twist::Unit(5));
  sweeps[2].follows = false;
  sweeps[3].end = 0;
  const auto frames = pcl6d::frameCovariances(sweeps);
  EXPECT_GT(frames[0](5, 5), 0);
  EXPECT_TRUE(frames[3].isZero(0));
  EXPECT_TRUE(pcl6d::frameCovariances({}).empty());
  EXPECT_TRUE(pcl6d::frameCovariances({sweeps[0]})[0].isZero(0));
}
