// SPDX-License-Identifier: BSD-3-Clause
// Trajectories written as recordings: read by openBag(), bytes against made messages.
#include "sources/made_messages.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/sources/bag.h>
#include <pcl6d/sources/trajectory_bag.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {
using pcl6d::TrajectoryBag;
using namespace pcl6d::test;

constexpr double kFirstStamp = 1600000000.5; // [s]

/** \return poses 1 m and a tenth of a second apart, turning */
TrajectoryBag
driveOf(std::size_t count)
{
  TrajectoryBag bag;
  bag.map_frame = "odom"; // as the made messages have it
  bag.sensor_frame = "lidar";
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(n, -2 * n, 0.25);
    pose.linear() =
        Eigen::AngleAxisd(0.01 * n, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    bag.trajectory.poses.push_back(pose);
    bag.trajectory.stamps.push_back(kFirstStamp + n / 8);
  }
  return bag;
}

/** Expects a message that was made otherwise, whose bytes between values are 0x7f. */
void
expectMessage(const std::vector<std::uint8_t>& message, const std::string& made)
{
  ASSERT_EQ(message.size(), made.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    const auto byte = static_cast<std::uint8_t>(made[i]);
    ASSERT_EQ(message[i], byte == 0x7f ? 0 : byte) << "byte " << i;
  }
}

TEST(TrajectoryBag, ItsMessagesAreThoseOfTheDefinitions)
{
  const TempFolder folder;
  const TrajectoryBag drive = driveOf(5);
  writeTrajectoryBag(folder / "drive.mcap", drive);
  const auto bag = pcl6d::openBag(folder / "drive.mcap");
  EXPECT_EQ(bag->damage(), "");
  ASSERT_EQ(bag->topics().size(), 2u);
  EXPECT_EQ(bag->topics()[0].name, "/odom");
  EXPECT_EQ(bag->topics()[0].type, "nav_msgs/Odometry");
  EXPECT_EQ(bag->topics()[1].name, "/tf");
  EXPECT_EQ(bag->topics()[1].type, "tf2_msgs/TFMessage");
  for (const auto& topic : bag->topics()) {
    EXPECT_EQ(topic.encoding, pcl6d::BagEncoding::kCdr);
    EXPECT_EQ(topic.num_messages, 5u);
  }
  ASSERT_EQ(bag->messages().size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    const auto& message = bag->messages()[i];
    const std::int64_t time =
        1600000000500000000 + static_cast<std::int64_t>(i / 2) * 125000000;
    EXPECT_EQ(message.time, time);
    EXPECT_EQ(message.topic, i % 2);
    const Eigen::Isometry3d& pose = drive.trajectory.poses[i / 2];
    expectMessage(bag->read(message),
                  i % 2 == 0 ? odometryMessage(MadeEncoding::kCdr, time, pose, "lidar")
                             : transformMessage(MadeEncoding::kCdr,
                                                {{time, "odom", "lidar", pose}}));
  }
}

TEST(TrajectoryBag, CovariancesStandRowByRow)
{
  const TempFolder folder;
  TrajectoryBag drive = driveOf(2);
  Eigen::Matrix<double, 6, 6> covariance;
  for (int i = 0; i < 36; ++i)
    covariance(i / 6, i % 6) = 0.125 * i;
  drive.covariances = {std::nullopt, covariance};
  writeTrajectoryBag(folder / "drive.mcap", drive);
  const auto bag = pcl6d::openBag(folder / "drive.mcap");
  // Behind the CDR header: time 8, "odom" 4 + 5, padding 3, "lidar" 4 + 6, padding 2; a pose.
  constexpr std::size_t kFirst = 4 + 32 + 7 * 8;
  for (const std::size_t i : {0u, 1u}) {
    const auto bytes = bag->read(bag->messages()[2 * i]);
    for (std::size_t k = 0; k < 36; ++k) {
      double value = -1;
      std::memcpy(&value, &bytes.at(kFirst + 8 * k), sizeof value);
      EXPECT_EQ(value, i == 0 ? 0 : 0.125 * static_cast<double>(k)) << k;
    }
  }
}

TEST(TrajectoryBag, ManyPosesAreInSeveralChunks)
{
  const TempFolder folder;
  constexpr std::size_t kMany = 3000; // 3 MB
  writeTrajectoryBag(folder / "drive.mcap", driveOf(kMany));
  const auto bag = pcl6d::openBag(folder / "drive.mcap");
  EXPECT_EQ(bag->damage(), "");
  ASSERT_EQ(bag->messages().size(), 2 * kMany);
  EXPECT_GT(bag->messages().back().part, 1u);
  EXPECT_GT(bag->read(bag->messages().back()).size(), 80u);
}

TEST(TrajectoryBag, RefusesWhatRos2CannotHold)
{
  const TempFolder folder;
  const auto refuses = [&](const TrajectoryBag& bag) {
    EXPECT_THROW(writeTrajectoryBag(folder / "no.mcap", bag), pcl6d::BadArgument);
    EXPECT_FALSE(std::filesystem::exists(folder / "no.mcap"));
  };
  refuses({});
  TrajectoryBag bag = driveOf(3);
  bag.trajectory.stamps.pop_back();
  refuses(bag);
  bag = driveOf(3);
  bag.covariances.resize(2);
  refuses(bag);
  for (const double stamp :
       {-1.0, 2147483648.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    bag = driveOf(3);
    bag.trajectory.stamps[1] = stamp;
    refuses(bag);
  }
  EXPECT_THROW(writeTrajectoryBag(folder / "none" / "a.mcap", driveOf(1)),
               pcl6d::IoFailed);
}
} // namespace
