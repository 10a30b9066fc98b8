// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/corridor_sweeps.h"

#include <pcl6d/odometry/motion_evidence.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::MotionEvidence;
using pcl6d::Sweep;
using pcl6d::SweepStatus;
using pcl6d::SweepTracker;
using pcl6d::TrackedSweep;
using pcl6d::test::CorridorSweeps;

/** \return the evidence of sweeps, tracked both ways, as soon as it decides */
MotionEvidence
evidenceOf(const std::vector<Sweep>& sweeps)
{
  SweepTracker moving, rigid;
  MotionEvidence evidence;
  for (const Sweep& sweep : sweeps) {
    Sweep without_times = sweep;
    without_times.times.clear();
    evidence.add(moving.track(sweep), rigid.track(without_times));
    if (evidence.holdsMotion())
      break;
  }
  return evidence;
}

/** \return a sweep without a motion, with points around the sensor */
TrackedSweep
tracked(double distance, double motion, SweepStatus status = SweepStatus::kTracked)
{
  TrackedSweep sweep;
  sweep.status = status;
  sweep.distance = distance;
  sweep.T_world_end.translation().x() = motion;
  sweep.reduced = {{1, 0, 0}, {0, 1, 0}};
  return sweep;
}

/** Adds sweeps that both ways match, with distances of points [m]. */
void
addMany(MotionEvidence& evidence, std::size_t count, double moving, double rigid)
{
  for (std::size_t i = 0; i < count; ++i)
    evidence.add(tracked(moving, 0.1), tracked(rigid, 0));
}
} // namespace

TEST(MotionEvidence, SweepsAsMeasuredHoldTheMotion)
{
  CorridorSweeps corridor;
  const MotionEvidence evidence = evidenceOf(corridor.drive(112));
  EXPECT_EQ(evidence.holdsMotion(), true);
  EXPECT_TRUE(evidence.holdsMotionInTheEnd());
  EXPECT_LT(evidence.ratio(), 0.95);
}

TEST(MotionEvidence, SweepsCorrectedBeforeDoNotHoldTheMotion)
{
  CorridorSweeps corridor;
  std::vector<Sweep> sweeps = corridor.drive(112);
  for (Sweep& sweep : sweeps)
    pcl6d::test::takeMotionOut(sweep);
  const MotionEvidence evidence = evidenceOf(sweeps);
  EXPECT_EQ(evidence.holdsMotion(), false);
  EXPECT_FALSE(evidence.holdsMotionInTheEnd());
  EXPECT_GT(evidence.ratio(), 1.02);
}

TEST(MotionEvidence, AtRestNothingIsTold)
{
  CorridorSweeps corridor;
  const MotionEvidence evidence = evidenceOf(corridor.drive(60, 0));
  EXPECT_EQ(evidence.holdsMotion(), std::nullopt);
  EXPECT_TRUE(evidence.holdsMotionInTheEnd());
  EXPECT_EQ(evidence.ratio(), 1);
}

TEST(MotionEvidence, AClearLeadDecides)
{
  MotionEvidence evidence;
  addMany(evidence, 29 + 3 * 20, 0.011, 0.01);
  EXPECT_EQ(evidence.holdsMotion(), std::nullopt);
  EXPECT_FALSE(evidence.holdsMotionInTheEnd()); // a lead of 3
  addMany(evidence, 20, 0.01, 0.011);
  EXPECT_FALSE(evidence.holdsMotionInTheEnd()); // of 2
  addMany(evidence, 20, 0.01, 0.011);
  EXPECT_TRUE(evidence.holdsMotionInTheEnd());
  addMany(evidence, 3 * 20, 0.011, 0.01);
  EXPECT_EQ(evidence.holdsMotion(), false);
  EXPECT_GT(evidence.ratio(), 1);
}

TEST(MotionEvidence, LostSweepsAndThoseOfANewMapDoNotCount)
{
  MotionEvidence evidence;
  for (int i = 0; i < 500; ++i) {
    evidence.add(tracked(0.02, 0.1, SweepStatus::kLost), tracked(0.01, 0));
    if (i % 30 == 0)
      evidence.add(tracked(0, 0, SweepStatus::kFirst), tracked(0.01, 0));
    evidence.add(tracked(0.02, 0.01), tracked(0.01, 0)); // motion below the noise
  }
  EXPECT_EQ(evidence.holdsMotion(), std::nullopt);
  EXPECT_EQ(evidence.ratio(), 1);
  for (int map = 0; map < 20; ++map) {
    evidence.add(tracked(0, 0, SweepStatus::kFirst), tracked(0.01, 0));
    addMany(evidence, 29, 0.02, 0.01);
  }
  EXPECT_EQ(evidence.ratio(), 1);
}
