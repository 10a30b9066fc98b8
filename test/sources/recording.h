// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sources/made_bag.h"
#include "sources/made_messages.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/sources/bag_source.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::test {

constexpr std::int64_t kStart = 1600000000000000000; // [ns]
constexpr std::int64_t kPeriod = 100000000;          // [ns]
constexpr const char* kPoints = "sensor_msgs/PointCloud2";
constexpr const char* kOdometry = "nav_msgs/Odometry";
constexpr const char* kTransforms = "tf2_msgs/TFMessage";

constexpr MadeEncoding kEncodings[] = {MadeEncoding::kRos1,
                                       MadeEncoding::kCdr,
                                       MadeEncoding::kCdrBigEndian};

/** \brief A recording that is built message by message. */
class Recording {
public:
  explicit Recording(MadeEncoding encoding = MadeEncoding::kRos1) : encoding_(encoding)
  {}

  void
  add(const std::string& topic,
      const std::string& type,
      std::int64_t time,
      std::string bytes)
  {
    messages_.push_back({topic, type, time, std::move(bytes)});
  }
  /** Adds a cloud of two points. */
  void
  addCloud(std::int64_t stamp,
           std::int64_t delay = 5,
           const std::string& topic = "/points")
  {
    add(topic,
        kPoints,
        stamp + delay,
        cloudMessage(encoding_, plainCloud(stamp, {{1, 2, 3}, {4, 5, 6}})));
  }
  void
  addOdometry(std::int64_t stamp, const Eigen::Isometry3d& pose)
  {
    add("/odom", kOdometry, stamp + 3, odometryMessage(encoding_, stamp, pose));
  }
  void
  addTransforms(const std::vector<MadeTransform>& transforms,
                const std::string& topic = "/tf")
  {
    add(topic,
        kTransforms,
        transforms.front().stamp + 3,
        transformMessage(encoding_, transforms));
  }

  /** \return the file, written as MCAP */
  std::filesystem::path
  file() const
  {
    MadeBagOptions options;
    options.encoding = encoding_ == MadeEncoding::kRos1 ? "ros1" : "cdr";
    writeText(folder_ / "drive.mcap", mcapOf(messages_, options));
    return folder_ / "drive.mcap";
  }

  MadeEncoding
  encoding() const
  {
    return encoding_;
  }

private:
  TempFolder folder_;
  MadeEncoding encoding_;
  std::vector<MadeMessage> messages_;
};

/** \return the message of the error when all scans of a recording are read; "": no error */
inline std::string
errorOfSource(const std::filesystem::path& file, const BagOptions& options = {})
{
  try {
    const BagSource source(file, options);
    for (std::size_t i = 0; i < source.scans().size(); ++i)
      source.read(i);
  } catch (const pcl6d::IoFailed& e) {
    return e.what();
  }
  return "";
}

} // namespace pcl6d::test

/** Expects that a text contains a part. */
#define EXPECT_PART(text, part)                                                        \
  EXPECT_NE(std::string(text).find(part), std::string::npos) << "the text: " << (text)
