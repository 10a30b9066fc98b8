// SPDX-License-Identifier: BSD-3-Clause
// Starts without a guess, and from bad ones, on recorded scans.
#include "support/constants.h"
#include "support/data_folder.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/registration/feature_alignment.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/overlap_search.h>

#include <gtest/gtest.h>

using pcl6d::test::kDegree;

namespace {
using namespace pcl6d;

Eigen::Isometry3d
refined(const Points& target, const Points& source, const Eigen::Isometry3d& guess)
{
  const PointTree tree(target);
  IcpOptions options;
  options.max_iterations = 200;
  return icp(tree, target, source, guess, options).T_target_source;
}

void
expectNear(const Eigen::Isometry3d& found,
           const Eigen::Isometry3d& expected,
           double metres,
           double radians)
{
  const auto off = distanceBetween(expected, found);
  EXPECT_LT(off.translation, metres);
  EXPECT_LT(off.rotation, radians);
}

// An alignment may say that it does not know, but never be wrong and sure.
void
expectRightOrDoubtful(const CoarseEstimate& estimate,
                      const Eigen::Isometry3d& truth,
                      double metres,
                      double radians)
{
  if (estimate.status == Status::kOk)
    expectNear(estimate.T_target_source, truth, metres, radians);
}
} // namespace

TEST(CoarseData, FeaturesReplaceTheUsualGuessOfTheRooms)
{
  PCL6D_DATA_OR_SKIP(folder, "rooms");
  const Points target = readScan(folder / "room_scan1.pcd").points;
  const Points source = readScan(folder / "room_scan2.pcd").points;
  const Eigen::Isometry3d expected =
      refined(target, source, planarPose(1.79387, 0.720047, 0.6931));
  FeatureAlignmentOptions options;
  for (options.seed = 0; options.seed < 3; ++options.seed) {
    SCOPED_TRACE("seed " + std::to_string(options.seed));
    const CoarseEstimate found = alignByFeatures(target, source, options);
    EXPECT_EQ(found.status, Status::kOk);
    expectNear(
        refined(target, source, found.T_target_source), expected, 0.02, 0.3 * kDegree);
  }
}

TEST(CoarseData, FeaturesAgreeWithTheOdometryOfKurt3D)
{
  PCL6D_DATA_OR_SKIP(folder, "kurt3d");
  const ScanFolder scans(folder);
  for (const std::size_t i : {0, 1}) {
    SCOPED_TRACE(i);
    const CoarseEstimate found =
        alignByFeatures(scans.read(i).points, scans.read(i + 1).points);
    EXPECT_EQ(found.status, Status::kOk);
    // The odometry is off by about 10 cm and 1.3 deg itself.
    expectNear(found.T_target_source,
               scans.initialPose(i).inverse() * scans.initialPose(i + 1),
               0.25,
               3 * kDegree);
  }
}

TEST(CoarseData, FeaturesFindTheTruthOfHku1)
{
  PCL6D_DATA_OR_SKIP(folder, "hku1");
  const ScanFolder scans(folder);
  const auto truth = readTrajectory(folder / "groundtruth.txt").poses;
  std::size_t found_count = 0;
  for (const std::size_t i : {0, 10, 30, 40}) {
    SCOPED_TRACE(i);
    const CoarseEstimate found =
        alignByFeatures(scans.read(i).points, scans.read(i + 1).points);
    // A few centimetres of the reference, and a tenth of a voxel of 0.3 m.
    expectRightOrDoubtful(
        found, truth[i].inverse() * truth[i + 1], 0.15, 1.0 * kDegree);
    found_count += found.status == Status::kOk ? 1 : 0;
  }
  EXPECT_GE(found_count, 3u);
}

TEST(CoarseData, FeaturesDoNotPlaceARoomInACorridor)
{
  PCL6D_DATA_OR_SKIP(rooms, "rooms");
  PCL6D_DATA_OR_SKIP(kurt3d, "kurt3d");
  const CoarseEstimate found = alignByFeatures(
      readScan(rooms / "room_scan1.pcd").points, ScanFolder(kurt3d).read(0).points);
  EXPECT_EQ(found.status, Status::kTooFewPairs) << found.score;
}

TEST(CoarseData, OverlapSearchRepairsBadGuessesOfHku1)
{
  PCL6D_DATA_OR_SKIP(folder, "hku1");
  const ScanFolder scans(folder);
  const auto truth = readTrajectory(folder / "groundtruth.txt").poses;
  for (const std::size_t i : {20, 30, 40, 50}) {
    SCOPED_TRACE(i);
    const Eigen::Isometry3d expected = truth[i].inverse() * truth[i + 1];
    const Eigen::Isometry3d guess =
        poseFromEuler(Eigen::Vector3d(0.8, -0.7, 0.2), {0.03, -0.05, 0.1}) * expected;
    const CoarseEstimate found =
        searchByOverlap(scans.read(i).points, scans.read(i + 1).points, guess);
    EXPECT_EQ(found.status, Status::kOk);
    // Cubes of the last level are 0.4 m, its steps 2.5 deg in yaw and 1.4 in the others.
    expectNear(found.T_target_source, expected, 0.4, 4 * kDegree);
  }
}
