// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d on two recorded scans of a room, without poses.
#include "support/data_folder.h"
#include "support/run_program.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/registration/icp_model.h>

#include <gtest/gtest.h>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::TempFolder;

pcl6d::IcpModel
modelOf(const fs::path& file)
{
  pcl6d::ReductionOptions reduction;
  reduction.voxel = 0.03; // [m] no reduction of pcl_slam6d
  pcl6d::IcpModel::Options options;
  options.normals = true;
  return {pcl6d::reducePoints(pcl6d::readScan(file).points, reduction), options};
}

/** \return T_first_second by ICP from the guess that is usual for these scans */
Eigen::Isometry3d
fromUsualGuess(const fs::path& folder)
{
  const pcl6d::IcpModel first = modelOf(folder / "room_scan1.pcd");
  const pcl6d::IcpModel second = modelOf(folder / "room_scan2.pcd");
  pcl6d::IcpOptions options;
  options.metric = pcl6d::Metric::kGicp;
  options.max_distance = 0.25; // [m]
  const Eigen::Isometry3d guess =
      pcl6d::poseFromEuler({1.79387, 0.720047, 0}, {0, 0, 0.6931});
  const auto found = pcl6d::icp({first.part()}, second.source(), guess, options);
  EXPECT_EQ(found.status, pcl6d::Status::kOk);
  return found.T_target_source;
}

void
expectFromUsualGuess(const fs::path& data, const fs::path& out)
{
  const auto poses = pcl6d::readTrajectory(out / "trajectory.kitti").poses;
  ASSERT_EQ(poses.size(), 2u);
  const auto error =
      pcl6d::distanceBetween(fromUsualGuess(data), poses[0].inverse() * poses[1]);
  EXPECT_LT(error.translation, 0.02);
  EXPECT_LT(error.rotation, 0.3 * M_PI / 180);
}
} // namespace

TEST(PclSlam6dDataRooms, SaysWhenTheOverlapSearchFoundNothingAndThereIsNoOdometry)
{
  PCL6D_DATA_OR_SKIP(data, "rooms");
  const TempFolder folder;
  const auto outcome = pcl6d::test::runProgram("pcl_slam6d",
                                               {data.string(),
                                                "-o",
                                                (folder / "out").string(),
                                                "--initial-guess",
                                                "overlap",
                                                "--no-recovery"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_NE(outcome.out.find("NOT TO BE TRUSTED"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("room_scan2.pcd"), std::string::npos) << outcome.out;
}

TEST(PclSlam6dDataRooms, FindsThePlaceWithoutPoses)
{
  PCL6D_DATA_OR_SKIP(data, "rooms");
  const TempFolder folder;
  for (const char* const guess : {"global", "overlap", "odometry"}) {
    const fs::path out = folder / guess;
    const auto outcome = pcl6d::test::runProgram(
        "pcl_slam6d", {data.string(), "-o", out.string(), "--initial-guess", guess});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    if (guess == std::string("global"))
      EXPECT_NE(outcome.err.find("place recognition found the poses"),
                std::string::npos)
          << outcome.err;
    expectFromUsualGuess(data, out);
  }
}
