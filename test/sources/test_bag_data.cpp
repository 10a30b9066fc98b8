// SPDX-License-Identifier: BSD-3-Clause
// Recordings of other programs: topics and counts as `rosbag info`, metadata.yaml and
// @mcap/core tell them.
#include "support/data_folder.h"

#include <pcl6d/sources/bag.h>

#include <gtest/gtest.h>

#include <map>
#include <zlib.h>

namespace {

/** \brief What a recording is known to hold. */
struct KnownBag {
  const char* name;
  std::map<std::string, std::pair<std::string, std::uint64_t>> topics; ///< type, count
  std::uint64_t num_bytes;   ///< of all messages
  std::uint64_t sum_of_crcs; ///< CRC-32 of each message, added up
};

TEST(BagData, RecordingsOfOtherProgramsHoldWhatTheyAreKnownFor)
{
  PCL6D_DATA_OR_SKIP(folder, "formats/bag");
  const KnownBag known[] = {
      {"example.bag",
       {{"/rosout", {"rosgraph_msgs/Log", 10}},
        {"/tf", {"tf/tfMessage", 2688}},
        {"/tf_static", {"tf2_msgs/TFMessage", 1}},
        {"/turtle1/cmd_vel", {"geometry_msgs/Twist", 357}},
        {"/turtle1/color_sensor", {"turtlesim/Color", 1351}},
        {"/turtle1/pose", {"turtlesim/Pose", 1344}},
        {"/turtle2/cmd_vel", {"geometry_msgs/Twist", 208}},
        {"/turtle2/color_sensor", {"turtlesim/Color", 1344}},
        {"/turtle2/pose", {"turtlesim/Pose", 1344}}},
       338842,
       15588490966724},
      {"example-lz4.bag",
       {{"/rosout", {"rosgraph_msgs/Log", 10}},
        {"/tf", {"tf/tfMessage", 2688}},
        {"/tf_static", {"tf2_msgs/TFMessage", 1}},
        {"/turtle1/cmd_vel", {"geometry_msgs/Twist", 357}},
        {"/turtle1/color_sensor", {"turtlesim/Color", 1351}},
        {"/turtle1/pose", {"turtlesim/Pose", 1344}},
        {"/turtle2/cmd_vel", {"geometry_msgs/Twist", 208}},
        {"/turtle2/color_sensor", {"turtlesim/Color", 1344}},
        {"/turtle2/pose", {"turtlesim/Pose", 1344}}},
       338842,
       15588490966724},
      {"no-messages.bag", {}, 0, 0},
      {"tf_example.bag",
       {{"/tf", {"tf2_msgs/TFMessage", 517}},
        {"/tf_static", {"tf2_msgs/TFMessage", 1}}},
       50769,
       1106130706850},
      {"cdr_test_0.db3",
       {{"/test_topic", {"test_msgs/BasicTypes", 3}},
        {"/array_topic", {"test_msgs/Arrays", 4}}},
       2940,
       13696389437},
      {"cdr_test_0.mcap",
       {{"/test_topic", {"test_msgs/BasicTypes", 3}},
        {"/array_topic", {"test_msgs/Arrays", 4}}},
       2940,
       13696389437},
      {"nav2_turtlebot.mcap",
       {{"/odom", {"nav_msgs/Odometry", 2639}},
        {"/tf", {"tf2_msgs/TFMessage", 5422}},
        {"/tf_static", {"tf2_msgs/TFMessage", 1}},
        {"/amcl_pose", {"geometry_msgs/PoseWithCovarianceStamped", 135}}},
       2691420,
       17665782517433},
      {"",
       {{"/test_topic", {"test_msgs/BasicTypes", 3}},
        {"/array_topic", {"test_msgs/Arrays", 4}}},
       2940,
       13696389437}};
  for (const auto& one : known) {
    SCOPED_TRACE(one.name);
    const auto bag = pcl6d::openBag(folder / one.name);
    EXPECT_EQ(bag->damage(), "");
    std::map<std::string, std::pair<std::string, std::uint64_t>> found;
    for (const auto& topic : bag->topics())
      found[topic.name] = {topic.type, topic.num_messages};
    EXPECT_EQ(found, one.topics);
    std::int64_t before = 0;
    std::uint64_t num_bytes = 0, sum_of_crcs = 0;
    for (const auto& message : bag->messages()) {
      EXPECT_LE(before, message.time);
      before = message.time;
      const auto bytes = bag->read(message);
      num_bytes += bytes.size();
      sum_of_crcs += crc32_z(0, bytes.data(), bytes.size());
    }
    EXPECT_EQ(num_bytes, one.num_bytes);
    EXPECT_EQ(sum_of_crcs, one.sum_of_crcs);
  }
}

} // namespace
