// SPDX-License-Identifier: BSD-3-Clause
// Which sweeps go to which keyframe of a drive along x.
#include <pcl6d/odometry/submaps.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace {
using pcl6d::PosedPoints;
using pcl6d::Submaps;
using pcl6d::TrackedSweep;

constexpr double kLeast = 0.1; // [m]

/** \return a sweep at x, whose single point tells its number */
TrackedSweep
sweepAt(double x, std::size_t number)
{
  TrackedSweep sweep;
  sweep.T_world_sweep.translation().x() = x;
  sweep.reduced = {Eigen::Vector3f::Constant(static_cast<float>(number))};
  return sweep;
}

/** Adds `count` sweeps, a metre apart, of which each tenth is a keyframe. */
void
drive(std::size_t count, std::size_t wanted, Submaps& submaps)
{
  for (std::size_t i = 0; i < count; ++i)
    if (i % 10 == 0)
      submaps.addKeyframe(i, sweepAt(static_cast<double>(i), i));
    else
      submaps.addSweep(i, sweepAt(static_cast<double>(i), i), wanted, kLeast);
}

std::vector<std::size_t>
numbersOf(const std::vector<PosedPoints>& submap)
{
  std::vector<std::size_t> numbers;
  for (const PosedPoints& sweep : submap)
    numbers.push_back(static_cast<std::size_t>(sweep.points.at(0).x()));
  return numbers;
}
} // namespace

TEST(Submaps, EachSweepBelongsToOneKeyframe)
{
  Submaps submaps;
  drive(21, 100, submaps);
  const auto first = submaps.take(0), second = submaps.take(1);
  EXPECT_EQ(numbersOf(first), (std::vector<std::size_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(numbersOf(second),
            (std::vector<std::size_t>{6, 7, 8, 9, 11, 12, 13, 14, 15}));
  EXPECT_EQ(first[2].pose.translation().x(), 3);
  EXPECT_EQ(second[0].pose.translation().x(), -4);
  EXPECT_TRUE(submaps.take(1).empty()); // taken
}

TEST(Submaps, HasAsManySweepsAsWantedSpreadEvenly)
{
  Submaps submaps;
  drive(31, 3, submaps);
  EXPECT_EQ(numbersOf(submaps.take(1)), (std::vector<std::size_t>{8, 12, 14}));
  Submaps dense;
  drive(31, 0, dense);
  EXPECT_TRUE(dense.take(1).empty());
}

TEST(Submaps, AScannerAtRestAddsNothing)
{
  Submaps submaps;
  submaps.addKeyframe(0, sweepAt(0, 0));
  for (std::size_t i = 1; i < 1000; ++i)
    submaps.addSweep(i, sweepAt(0.001 * static_cast<double>(i % 10), i), 4, kLeast);
  submaps.addKeyframe(1000, sweepAt(1, 1000));
  EXPECT_TRUE(submaps.take(0).empty());
  EXPECT_TRUE(submaps.take(1).empty());
}

// To and fro without a keyframe: not all sweeps are kept, and those kept are whole.
TEST(Submaps, ManySweepsWithoutAKeyframeAreThinnedOut)
{
  Submaps submaps;
  submaps.addKeyframe(0, sweepAt(0, 0));
  for (std::size_t i = 1; i < 1000; ++i)
    submaps.addSweep(i, sweepAt(i % 2 == 0 ? 0.5 : 1.5, i), 1000, kLeast);
  submaps.addKeyframe(1000, sweepAt(2, 1000));
  const auto first = submaps.take(0), second = submaps.take(1);
  EXPECT_LE(first.size() + second.size(), 64U);
  EXPECT_GE(first.size() + second.size(), 32U);
  for (const auto* submap : {&first, &second})
    for (const PosedPoints& sweep : *submap)
      EXPECT_EQ(sweep.points.size(), 1U);
}

TEST(Submaps, NoSweepBehindALostTrackBelongsToAKeyframeBefore)
{
  Submaps submaps;
  submaps.addKeyframe(0, sweepAt(0, 0));
  submaps.addSweep(1, sweepAt(1, 1), 10, kLeast);
  submaps.cut();
  submaps.addSweep(3, sweepAt(3, 3), 10, kLeast);
  submaps.addSweep(4, sweepAt(4, 4), 10, kLeast);
  submaps.addKeyframe(5, sweepAt(5, 5));
  EXPECT_EQ(numbersOf(submaps.take(0)), (std::vector<std::size_t>{1}));
  EXPECT_EQ(numbersOf(submaps.take(1)), (std::vector<std::size_t>{3, 4}));
}

TEST(Submaps, CorrectedPosesAndPointsCountWhereverTheSweepIs)
{
  Submaps submaps;
  drive(13, 100, submaps);
  submaps.correct(0, sweepAt(0.5, 0));    // a keyframe
  submaps.correct(2, sweepAt(2.25, 70));  // already around it
  submaps.correct(12, sweepAt(12.5, 80)); // behind the last keyframe
  submaps.addKeyframe(20, sweepAt(20, 20));
  const auto first = submaps.take(0), second = submaps.take(1);
  EXPECT_EQ(numbersOf(first), (std::vector<std::size_t>{1, 70, 3, 4, 5}));
  EXPECT_EQ(first[0].pose.translation().x(), 0.5);
  EXPECT_EQ(first[1].pose.translation().x(), 1.75);
  EXPECT_EQ(numbersOf(second).back(), 11U);
  EXPECT_EQ(numbersOf(submaps.take(2)), (std::vector<std::size_t>{80}));
  EXPECT_THROW(submaps.take(3), std::out_of_range);
}
