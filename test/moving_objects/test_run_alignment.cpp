// SPDX-License-Identifier: BSD-3-Clause
// A run that lies nearly right is brought exactly onto another one.
#include "compared_rooms.h"
#include "support/bits.h"
#include "support/points.h"

#include <pcl6d/common/error.h>
#include <pcl6d/moving_objects/run_alignment.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace pcl6d;
using namespace pcl6d::test;

// Thousands of points of 5 mm: what is left is how two reductions lie on each other, a
// fiftieth of the voxel.
constexpr double kPlaceTol = kVoxel / 50; // [m]
constexpr double kTurnTol = 0.0005;       // [rad] 2 mm at 4 m

const Eigen::Isometry3d kOff = poseFromEuler({0.12, -0.09, 0.05}, {0.01, -0.008, 0.02});

RunAlignmentOptions
alignmentOptions()
{
  RunAlignmentOptions o;
  o.voxel = kVoxel;
  return o;
}

void
expectPoses(const ComparedRun& run, const std::vector<Eigen::Isometry3d>& truth)
{
  ASSERT_EQ(run.size(), truth.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    const MotionSize off = distanceBetween(truth[i], run[i].T_world_scan);
    EXPECT_LT(off.translation, kPlaceTol) << i;
    EXPECT_LT(off.rotation, kTurnTol) << i;
  }
}
} // namespace

TEST(RunAlignment, BringsARunBack)
{
  RoomRun a({}, driveThrough(0), 3), b({}, driveThrough(0.7), 4, kOff);
  const RunAlignment found = alignRuns(a.run, b.run, alignmentOptions());
  expectPoses(a.run, driveThrough(0)); // it stays
  expectPoses(b.run, driveThrough(0.7));
  const MotionSize off = distanceBetween(found.T_new_old, kOff.inverse());
  EXPECT_LT(off.translation, kPlaceTol);
  EXPECT_LT(off.rotation, kTurnTol);
  EXPECT_GT(found.overlap, 0.8);
  EXPECT_GT(found.pairs, 1000u);
  EXPECT_LT(found.residual, 2 * kNoise);
  EXPECT_LT(found.bending, kPlaceTol);
}

TEST(RunAlignment, IsNotPulledByWhatHasChanged)
{
  PillarRoom after;
  after.walls.max().y() -= 0.08; // a wall
  after.pillars.pop_back();      // and a thing
  RoomRun a({}, driveThrough(0), 3), b(after, driveThrough(0.7), 4, kOff);
  alignRuns(a.run, b.run, alignmentOptions());
  expectPoses(b.run, driveThrough(0.7));
}

TEST(RunAlignment, StraightensARunThatIsBent)
{
  RoomRun a({}, driveThrough(0), 3), b({}, driveThrough(0.7), 4);
  b.run[2].T_world_scan = planarPose(0.03, -0.02, 0.004) * b.run[2].T_world_scan;
  const RunAlignment found = alignRuns(a.run, b.run, alignmentOptions());
  expectPoses(b.run, driveThrough(0.7));
  EXPECT_GT(found.bending, 0.01);
}

TEST(RunAlignment, KnowsHowExactItIs)
{
  RoomRun a({}, driveThrough(0), 3), b({}, driveThrough(0.7), 4, kOff);
  alignRuns(a.run, b.run, alignmentOptions());
  for (const ComparedRun* run : {&a.run, &b.run})
    for (const ComparedScan& scan : *run) {
      const double sigma = std::sqrt(scan.covariance.topLeftCorner<3, 3>().trace());
      EXPECT_GT(sigma, 1e-4);
      EXPECT_LT(sigma, kVoxel / 10);
    }
}

TEST(RunAlignment, LeavesPosesThatAreGiven)
{
  RoomRun a({}, driveThrough(0), 3), b({}, driveThrough(0.7), 4, kOff);
  RunAlignmentOptions given = alignmentOptions();
  given.move = false;
  const ComparedRun before = b.run;
  const RunAlignment found = alignRuns(a.run, b.run, given);
  EXPECT_TRUE(sameBits(found.T_new_old, Eigen::Isometry3d::Identity()));
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_TRUE(sameBits(b.run[i].T_world_scan, before[i].T_world_scan));
    // The step that it does not take counts as an error: it is off by 16 cm.
    EXPECT_GT(std::sqrt(b.run[i].covariance.topLeftCorner<3, 3>().trace()), 0.03);
  }
}

TEST(RunAlignment, OfRunsThatDoNotMeetIsNone)
{
  RoomRun a({}, driveThrough(0), 3);
  RoomRun b({}, driveThrough(0.7), 4, planarPose(100, 0, 0));
  const auto before = b.run[0].T_world_scan;
  EXPECT_EQ(alignRuns(a.run, b.run, alignmentOptions()).pairs, 0u);
  EXPECT_TRUE(sameBits(b.run[0].T_world_scan, before));
  ComparedRun none;
  EXPECT_EQ(alignRuns(a.run, none, alignmentOptions()).pairs, 0u);
  EXPECT_EQ(alignRuns(none, b.run, alignmentOptions()).pairs, 0u);
}

TEST(RunAlignment, IsTheSameForAnyNumberOfThreads)
{
  std::vector<Eigen::Isometry3d> poses;
  for (const unsigned int threads : {1U, 3U}) {
    RoomRun a({}, driveThrough(0, 2), 3), b({}, driveThrough(0.7, 2), 4, kOff);
    RunAlignmentOptions o = alignmentOptions();
    o.num_threads = threads;
    alignRuns(a.run, b.run, o);
    poses.push_back(b.run[1].T_world_scan);
  }
  EXPECT_TRUE(sameBits(poses[0], poses[1]));
}

TEST(RunAlignment, RefusesWrongInput)
{
  RoomRun a({}, driveThrough(0, 1), 3), b({}, driveThrough(0.7, 1), 4);
  RunAlignmentOptions wrong = alignmentOptions();
  wrong.voxel = 0;
  EXPECT_EQ(badArgumentOf([&] { alignRuns(a.run, b.run, wrong); }),
            "voxel = 0, but must be finite and > 0");
  wrong = alignmentOptions();
  wrong.reach = -1;
  EXPECT_EQ(badArgumentOf([&] { alignRuns(a.run, b.run, wrong); }),
            "reach = -1, but must be finite and > 0");
  b.run[0].T_world_scan.linear() *= 2;
  EXPECT_EQ(badArgumentOf([&] { alignRuns(a.run, b.run, alignmentOptions()); }),
            "second run: scan 0 has a pose that is not rigid, or a covariance with "
            "infinite values or NaN");
  const Normals few(3, Eigen::Vector3f::UnitZ());
  a.run[0].normals = &few;
  EXPECT_NE(badArgumentOf([&] {
              alignRuns(a.run, b.run, alignmentOptions());
            }).find("first run: scan 0 has 3 normals, but must have a normal for each"),
            std::string::npos);
}
