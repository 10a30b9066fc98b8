// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/sources/bag_source.h>

#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace pcl6d::fuzz {

namespace {
/** Reads all messages of a recording, then its clouds. */
/** \return the choice of positions and orientations, where a recording has them */
BagOptions
optionsFor(const Bag& bag)
{
  BagOptions options;
  for (const BagTopic& topic : bag.topics()) {
    if (topic.num_messages == 0)
      continue;
    if (topic.type == "sensor_msgs/NavSatFix")
      options.odometry = topic.name;
    if (topic.type == "sensor_msgs/Imu")
      options.imu = topic.name;
  }
  if (options.odometry.empty())
    options.imu.clear();
  return options;
}

void
readRecording(const std::filesystem::path& file)
{
  const auto bag = openBag(file);
  std::uint64_t counted = 0;
  for (const BagTopic& topic : bag->topics())
    counted += topic.num_messages;
  expect(counted == bag->messages().size(), "messages are those of the topics");
  std::int64_t before = bag->messages().empty() ? 0 : bag->messages().front().time;
  for (const BagMessage& message : bag->messages()) {
    expect(message.topic < bag->topics().size(), "a message has a topic");
    expect(before <= message.time, "messages are in the order of their times");
    before = message.time;
  }
  const auto source = std::make_shared<BagSource>(file, optionsFor(*bag));
  const ScanFolder folder(source);
  for (std::size_t i = 0; i < folder.size(); ++i) {
    expect(folder.initialPose(i).matrix().allFinite(), "a pose is finite");
    const Scan scan = folder.read(i);
    const std::size_t count = std::size_t{scan.cloud.width} * scan.cloud.height;
    expect(scan.points.size() == count, "as many points as the cloud has");
    expect(scan.cloud.data.size() == count * scan.cloud.point_step, "it has its bytes");
    for (const auto& p : scan.points)
      expect(p.allFinite(), "points are finite");
  }
}

void
append(std::vector<std::uint8_t>& bytes, std::uint64_t value, std::size_t size)
{
  for (std::size_t i = 0; i < size; ++i)
    bytes.push_back(i < 8 ? static_cast<std::uint8_t>(value >> (8 * i)) : 0);
}

void
appendText(std::vector<std::uint8_t>& bytes, const std::string& text)
{
  append(bytes, text.size(), 4);
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void
appendRecord(std::vector<std::uint8_t>& bytes,
             std::uint8_t op,
             const std::vector<std::uint8_t>& content)
{
  bytes.push_back(op);
  append(bytes, content.size(), 8);
  bytes.insert(bytes.end(), content.begin(), content.end());
}

/** \return a valid LaserScan of ROS 1 with one range of 2 m at 5 s in the frame l */
std::vector<std::uint8_t>
laserScan()
{
  constexpr std::uint32_t kTwo = 0x40000000, kThirty = 0x41f00000; // as float
  std::vector<std::uint8_t> bytes;
  append(bytes, 1, 4);
  append(bytes, 5, 8); // time
  appendText(bytes, "l");
  append(bytes, 0, 6 * 4);
  append(bytes, kThirty, 4);
  append(bytes, 1, 4);
  append(bytes, kTwo, 4);
  append(bytes, 0, 4);
  return bytes;
}

/** \return a valid NavSatFix of ROS 1 on the equator, at the time of laserScan() */
std::vector<std::uint8_t>
satelliteFix()
{
  std::vector<std::uint8_t> bytes;
  append(bytes, 1, 4);
  append(bytes, 5, 8); // time
  appendText(bytes, "g");
  append(bytes, 0, 1 + 2 + 3 * 8 + 9 * 8 + 1);
  return bytes;
}

/** Describes a channel and adds its message. */
void
appendChannel(std::vector<std::uint8_t>& file,
              std::uint16_t id,
              const std::string& topic,
              const std::string& type,
              const std::string& encoding,
              const std::vector<std::uint8_t>& bytes)
{
  std::vector<std::uint8_t> schema, channel, message;
  append(schema, id, 2);
  for (const std::string& text : {type, std::string(), std::string()})
    appendText(schema, text);
  append(channel, id, 2);
  append(channel, id, 2);
  for (const std::string& text : {topic, encoding, std::string()})
    appendText(channel, text);
  append(message, id, 2);
  append(message, 0, 4 + 8 + 8);
  message.insert(message.end(), bytes.begin(), bytes.end());
  appendRecord(file, 3, schema);
  appendRecord(file, 4, channel);
  appendRecord(file, 5, message);
}

/** \return an MCAP file with a message, whose bytes these are behind the first, which tells
 * the type and the encoding, and with a scan, so that poses have something to place */
std::vector<std::uint8_t>
messageAsFile(const std::uint8_t* data, std::size_t size)
{
  const char* const types[] = {"sensor_msgs/msg/PointCloud2",
                               "livox_ros_driver2/msg/CustomMsg",
                               "sensor_msgs/msg/LaserScan",
                               "nav_msgs/msg/Odometry",
                               "tf2_msgs/msg/TFMessage",
                               "geometry_msgs/msg/PoseStamped",
                               "sensor_msgs/msg/NavSatFix",
                               "sensor_msgs/msg/Imu"};
  const std::uint8_t kind = size > 0 ? data[0] : 0;
  std::vector<std::uint8_t> file = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
  const std::size_t type = kind / 2 % std::size(types);
  constexpr std::size_t kFirstPose = 3;
  appendChannel(file,
                1,
                "/a",
                types[type],
                kind % 2 == 0 ? "ros1" : "cdr",
                size > 1 ? std::vector<std::uint8_t>(data + 1, data + size)
                         : std::vector<std::uint8_t>());
  if (type >= kFirstPose)
    appendChannel(file, 2, "/scan", types[2], "ros1", laserScan());
  constexpr std::size_t kFix = 6, kImu = 7;
  if (type == kImu)
    appendChannel(file, 3, "/fix", types[kFix], "ros1", satelliteFix());
  return file;
}
} // namespace

int
bag_mcap(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".mcap", data, size, readRecording);
}

int
bag_message(const std::uint8_t* data, std::size_t size)
{
  const auto file = messageAsFile(data, size);
  return readAsFile(".mcap", file.data(), file.size(), readRecording);
}

int
bag_ros(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".bag", data, size, readRecording);
}

} // namespace pcl6d::fuzz
