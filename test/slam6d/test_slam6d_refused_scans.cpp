// SPDX-License-Identifier: BSD-3-Clause
#include "support/drift.h"
#include "support/points.h"

#include <pcl6d/slam6d/slam6d.h>

using pcl6d::Points;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::test::DriftingRun;
using pcl6d::test::makeDriftingRun;

namespace {
/** The message of a run of one scan of a room that cannot be prepared. */
std::string
failureOf(const Slam6DOptions& options, const Eigen::Vector3f& last_point = {1, 1, 1})
{
  Slam6D slam(options);
  DriftingRun run = makeDriftingRun(1);
  run.scans[0].back() = last_point;
  slam.addScan(run.scans[0], run.odometry[0], "scan003.pcd");
  try {
    slam.optimize();
  } catch (const pcl6d::ComputeFailed& e) {
    return e.what();
  }
  return "";
}
} // namespace

TEST(Slam6D, SaysWhichScanTheGateLeavesEmptyAndWhichLimitsAreDerived)
{
  Slam6DOptions options;
  options.max_range = 0.25;
  options.min_range = 0;
  EXPECT_EQ(
      failureOf(options),
      "scan003.pcd: 0 points within the range gate of 0 to 0.25 m, but at least 3 "
      "are needed");
  options.min_range.reset();
  options.max_range = 0.1;
  EXPECT_NE(failureOf(options).find("to 0.1 m (derived; see min range), but"),
            std::string::npos);
  options.max_range.reset();
  options.voxel = 1e-6;
  EXPECT_NE(
      failureOf(options).find("to 0.26 m (derived; see min range and max range),"),
      std::string::npos);
  options.min_range = 0;
  EXPECT_EQ(failureOf(options),
            "scan003.pcd: 0 points within the range gate of 0 to 0.26 m (derived; see "
            "max range), but at least 3 are needed");
}

TEST(Slam6D, SaysWhichScanIsTooLargeForTheGridAndWhatToGive)
{
  Slam6DOptions options;
  options.max_range = pcl6d::test::kInfinity;
  const std::string derived = failureOf(options, {1e8f, 0, 0});
  EXPECT_EQ(derived.find("scan003.pcd: point (1e+08, 0, 0) lies outside the grid"), 0u)
      << derived;
  EXPECT_NE(derived.find("(see voxel, derived, and max range)"), std::string::npos);
  EXPECT_EQ(derived.find('\n'), std::string::npos);
  options.voxel = 0.1;
  EXPECT_NE(failureOf(options, {1e8f, 0, 0}).find("(see voxel and max range)"),
            std::string::npos);
}

TEST(Slam6D, IsAsBeforeWhenAScanIsRefusedOnTheWay)
{
  // Once the parameters are derived, addScan() reduces at once and may find nothing.
  const DriftingRun run = makeDriftingRun(2);
  Slam6D slam;
  slam.addScan(run.scans[0], run.odometry[0]);
  EXPECT_TRUE(slam.optimize());
  const Points inside_the_gate(10, {0.01f, 0, 0});
  EXPECT_THROW(slam.addScan(inside_the_gate, run.odometry[1]), pcl6d::ComputeFailed);
  EXPECT_EQ(slam.result().scans.size(), 1u);
  slam.addScan(run.scans[1], run.odometry[1]);
  EXPECT_TRUE(slam.optimize());
  EXPECT_EQ(slam.result().scans.size(), 2u);
}

TEST(Slam6D, RefusesAPoseThatIsNoPlace)
{
  DriftingRun run = makeDriftingRun(1);
  for (const double far : {1e9, -1e100}) {
    Slam6D slam{Slam6DOptions()};
    run.odometry[0].translation().x() = far;
    EXPECT_THROW(slam.addScan(run.scans[0], run.odometry[0], "a.pcd"),
                 pcl6d::BadArgument);
    EXPECT_TRUE(slam.result().scans.empty());
  }
}
