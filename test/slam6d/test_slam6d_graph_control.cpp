// SPDX-License-Identifier: BSD-3-Clause
#include "ring_run.h"

using pcl6d::Progress;
using pcl6d::ScanState;
using pcl6d::Slam6D;
using pcl6d::Slam6DResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::pairwise;
using pcl6d::test::positionRms;
using pcl6d::test::ring;
using pcl6d::test::stageOf;

namespace {

void
add(Slam6D& slam, std::size_t begin, std::size_t end)
{
  for (std::size_t i = begin; i < end; ++i)
    slam.addScan(ring().scans[i], ring().odometry[i]);
}

/** Cancels in the first round of relaxation that is told. */
void
cancelOnce(Slam6D& slam)
{
  slam.setProgressCallback([&slam, done = false](const Progress& p) mutable {
    if (p.stage == "relaxing" && !done) {
      done = true;
      slam.cancel();
    }
  });
}
} // namespace

TEST(Slam6DGraph, TakesMoreScansAfterwards)
{
  Slam6D slam(pairwise());
  add(slam, 0, 8);
  EXPECT_TRUE(slam.optimize());
  EXPECT_EQ(slam.result().graph.poses.size(), 8u);
  add(slam, 8, 13);
  EXPECT_EQ(slam.result().scans[8].state, ScanState::kPending);
  EXPECT_TRUE(slam.optimize());
  const Slam6DResult& result = slam.result();
  EXPECT_TRUE(result.trusted());
  EXPECT_EQ(result.graph.poses.size(), 13u);
  EXPECT_NE(stageOf(result, "relaxation"), nullptr);
  EXPECT_LT(positionRms(result, ring()), 0.03);
  EXPECT_TRUE(result.floating.empty());
}

TEST(Slam6DGraph, CancelledWhileRelaxingLeavesThePosesAsMatchedAndGoesOn)
{
  const Slam6DResult whole = pcl6d::test::registered(ring(), pairwise());
  Slam6D slam(pairwise());
  add(slam, 0, 13);
  std::vector<Eigen::Isometry3d> matched;
  slam.setObserver([&](std::size_t, const pcl6d::ScanResult& scan) {
    matched.push_back(scan.T_world_scan);
  });
  cancelOnce(slam);
  EXPECT_FALSE(slam.optimize());
  EXPECT_EQ(stageOf(slam.result(), "relaxation"), nullptr);
  for (std::size_t i = 0; i < matched.size(); ++i)
    EXPECT_TRUE(pcl6d::test::sameBits(matched[i], slam.result().scans[i].T_world_scan));
  EXPECT_TRUE(slam.optimize());
  ASSERT_NE(stageOf(slam.result(), "relaxation"), nullptr);
  pcl6d::test::expectSameBits(slam.result(), whole);
  EXPECT_TRUE(slam.optimize()) << "nothing left to do";
  pcl6d::test::expectSameBits(slam.result(), whole);
}

TEST(Slam6DGraph, TakesMoreScansAfterACancelledRelaxation)
{
  Slam6D slam(pairwise());
  add(slam, 0, 8);
  cancelOnce(slam);
  EXPECT_FALSE(slam.optimize());
  add(slam, 8, 13);
  EXPECT_TRUE(slam.optimize());
  EXPECT_TRUE(slam.result().trusted());
  EXPECT_LT(positionRms(slam.result(), ring()), 0.03);
}
