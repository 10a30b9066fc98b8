// SPDX-License-Identifier: BSD-3-Clause
// Recordings that independent programs write: python3-rosbag, and @mcap/core of npm, which also
// reads ours.
#include "support/temp_folder.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/sources/bag_source.h>
#include <pcl6d/sources/trajectory_bag.h>

#include <gtest/gtest.h>

#include <cstdlib>

namespace {
using namespace pcl6d::test;

constexpr std::size_t kWritten = 40;  // clouds
constexpr std::size_t kPoints = 5000; // in each

/** Writes clouds whose point k of cloud i is (k, i, k % 7), and Odometry at (i, 0, 0). */
constexpr const char* kRosbagWriter = R"(
import struct, sys
import genpy
from rosbag import Bag
from nav_msgs.msg import Odometry
from sensor_msgs.msg import PointCloud2, PointField
out, compression = sys.argv[1:]
with Bag(out, 'w', compression=compression, chunk_threshold=100000) as bag:
    for i in range(40):
        stamp = genpy.Time(1600000000 + i, 500000000)
        pose = Odometry()
        pose.header.stamp, pose.header.frame_id, pose.child_frame_id = stamp, 'odom', 'lidar'
        pose.pose.pose.position.x, pose.pose.pose.orientation.w = float(i), 1.0
        bag.write('/odom', pose, stamp)
        cloud = PointCloud2()
        cloud.header.stamp, cloud.header.frame_id = stamp, 'lidar'
        cloud.height, cloud.width, cloud.point_step, cloud.row_step = 1, 5000, 12, 60000
        cloud.fields = [PointField(n, 4 * k, 7, 1) for k, n in enumerate('xyz')]
        cloud.data = b''.join(struct.pack('<3f', k, i, k % 7) for k in range(5000))
        bag.write('/points', cloud, stamp)
)";

/** The same in CDR. */
constexpr const char* kMcapWriter = R"(
import { McapWriter } from '@mcap/core';
import { closeSync, openSync, writeSync } from 'fs';
class File {
  constructor(path) { this.file = openSync(path, 'w'); this.size = 0n; }
  async write(bytes) { writeSync(this.file, bytes); this.size += BigInt(bytes.length); }
  position() { return this.size; }
}
class Cdr {
  constructor() { this.bytes = Buffer.alloc(70000); this.bytes[1] = 1; this.at = 4; }
  align(n) { while ((this.at - 4) % n) this.at++; }
  int(v) { this.align(4); this.at = this.bytes.writeUInt32LE(v, this.at); return this; }
  double(v) { this.align(8); this.at = this.bytes.writeDoubleLE(v, this.at); return this; }
  float(v) { this.align(4); this.at = this.bytes.writeFloatLE(v, this.at); return this; }
  byte(v) { this.bytes[this.at++] = v; return this; }
  text(v) {
    this.int(v.length + 1);
    this.bytes.write(v, this.at);
    this.at += v.length + 1;
    return this;
  }
  done() { return new Uint8Array(this.bytes.subarray(0, this.at)); }
}
const file = new File(process.argv[2]);
const writer = new McapWriter({ writable: file, chunkSize: 100000 });
await writer.start({ profile: 'ros2', library: 'test' });
const channel = async (topic, name) => writer.registerChannel({
  schemaId: await writer.registerSchema({ name, encoding: 'ros2msg', data: new Uint8Array() }),
  topic, messageEncoding: 'cdr', metadata: new Map() });
const odom = await channel('/odom', 'nav_msgs/msg/Odometry');
const points = await channel('/points', 'sensor_msgs/msg/PointCloud2');
for (let i = 0; i < 40; ++i) {
  const time = BigInt(1600000000 + i) * 1000000000n + 500000000n;
  const add = (channelId, data) =>
    writer.addMessage({ channelId, sequence: i, logTime: time, publishTime: time, data });
  const pose = new Cdr().int(1600000000 + i).int(500000000).text('odom').text('lidar');
  for (const v of [i, 0, 0, 0, 0, 0, 1]) pose.double(v);
  for (let k = 0; k < 78; ++k) pose.double(0);
  await add(odom, pose.done());
  const cloud = new Cdr().int(1600000000 + i).int(500000000).text('lidar').int(1).int(5000).int(3);
  ['x', 'y', 'z'].forEach((name, k) => cloud.text(name).int(4 * k).byte(7).int(1));
  cloud.byte(0).int(12).int(60000).int(60000);
  for (let k = 0; k < 5000; ++k) cloud.float(k).float(i).float(k % 7);
  await add(points, cloud.byte(1).done());
}
await writer.end();
closeSync(file.file);
)";

/** Reads a recording by its index, and its messages by the definitions within: prints topic, log
 * time, time of the header, frames, position and rotation. */
constexpr const char* kMcapReader = R"(
import { McapIndexedReader } from '@mcap/core';
import { parse } from '@foxglove/rosmsg';
import { MessageReader } from '@foxglove/rosmsg2-serialization';
import { readFileSync } from 'fs';
const bytes = readFileSync(process.argv[2]);
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) =>
    new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
};
const reader = await McapIndexedReader.Initialize({ readable });
const decoders = new Map();
for (const [id, channel] of reader.channelsById) {
  const schema = reader.schemasById.get(channel.schemaId);
  const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
  decoders.set(id, new MessageReader(definition));
}
const row = (topic, time, stamped, position, rotation) => console.log(
  topic, time, stamped.header.stamp.sec, stamped.header.stamp.nanosec,
  stamped.header.frame_id, stamped.child_frame_id, position.x, position.y, position.z,
  rotation.x, rotation.y, rotation.z, rotation.w);
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const topic = reader.channelsById.get(message.channelId).topic;
  const content = decoders.get(message.channelId).readMessage(message.data);
  if (topic === '/odom')
    row(topic, message.logTime, content, content.pose.pose.position,
        content.pose.pose.orientation);
  else
    for (const one of content.transforms)
      row(topic, message.logTime, one, one.transform.translation, one.transform.rotation);
}
)";

bool
succeeds(const std::string& command)
{
  return std::system(("(" + command + ") > /dev/null 2>&1").c_str()) == 0;
}

/** Expects what the writers wrote. */
void
expectWritten(const std::filesystem::path& file)
{
  const auto bag = pcl6d::openBag(file);
  EXPECT_EQ(bag->damage(), "");
  ASSERT_EQ(bag->topics().size(), 2u);
  for (const auto& topic : bag->topics())
    EXPECT_EQ(topic.num_messages, kWritten);
  const pcl6d::BagSource source(file);
  ASSERT_EQ(source.scans().size(), kWritten);
  for (std::size_t i = 0; i < kWritten; ++i) {
    const auto n = static_cast<double>(i);
    EXPECT_EQ(*source.scans()[i].stamp, 1600000000.5 + n);
    ASSERT_TRUE(source.scans()[i].pose);
    EXPECT_EQ(source.scans()[i].pose->translation(), Eigen::Vector3d(n, 0, 0));
    const auto points = pcl6d::coordinatesOf(source.read(i).cloud);
    ASSERT_EQ(points.size(), kPoints);
    for (std::size_t k = 0; k < kPoints; ++k)
      ASSERT_EQ(points[k], Eigen::Vector3f(k, i, k % 7)) << i << ' ' << k;
  }
}

TEST(BagWriters, RosbagWritesWhatIsRead)
{
  const std::string python = "/usr/bin/python3";
  if (!succeeds(python + " -c 'import rosbag, nav_msgs.msg, sensor_msgs.msg'"))
    GTEST_SKIP() << "no rosbag: apt-get install python3-rosbag python3-roslz4 "
                    "python3-nav-msgs python3-sensor-msgs";
  const TempFolder folder;
  writeText(folder / "write.py", kRosbagWriter);
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    if (compression == "lz4" && !succeeds(python + " -c 'import roslz4'"))
      continue;
    SCOPED_TRACE(compression);
    const std::string file = (folder / (compression + ".bag")).string();
    ASSERT_TRUE(succeeds(python + " '" + (folder / "write.py").string() + "' '" + file +
                         "' " + compression));
    expectWritten(file);
  }
}

TEST(BagWriters, NpmWritesWhatIsRead)
{
  if (!succeeds("command -v node") || !succeeds("command -v npm"))
    GTEST_SKIP() << "no node or npm: apt-get install nodejs npm";
  const TempFolder folder;
  writeText(folder / "write.mjs", kMcapWriter);
  const std::string inside = "cd '" + folder.path().string() + "' && ";
  if (!succeeds(inside + "timeout 120 npm install --no-audit --no-fund @mcap/core@2"))
    GTEST_SKIP() << "npm does not reach its registry";
  ASSERT_TRUE(succeeds(inside + "node write.mjs drive.mcap"));
  expectWritten(folder / "drive.mcap");
}

TEST(BagWriters, NpmReadsWhatIsWritten)
{
  if (!succeeds("command -v node") || !succeeds("command -v npm"))
    GTEST_SKIP() << "no node or npm: apt-get install nodejs npm";
  const TempFolder folder;
  const std::string inside = "cd '" + folder.path().string() + "' && ";
  if (!succeeds(inside + "timeout 120 npm install --no-audit --no-fund @mcap/core@2 "
                         "@foxglove/rosmsg@5 @foxglove/rosmsg2-serialization@3"))
    GTEST_SKIP() << "npm does not reach its registry";
  pcl6d::TrajectoryBag drive;
  std::string expected;
  for (int i = 0; i < 3; ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(i, 0.5, -2);
    pose.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1; // a quarter turn to the left
    pose.linear() *= pose.linear(); // a half one, whose quaternion is 0 0 1 0
    drive.trajectory.poses.push_back(pose);
    drive.trajectory.stamps.push_back(1600000000.25 + i);
    for (const std::string topic : {"/odom", "/tf"})
      expected += topic + " 160000000" + std::to_string(i) + "250000000n 160000000" +
                  std::to_string(i) + " 250000000 map sensor " + std::to_string(i) +
                  " 0.5 -2 0 0 1 0\n";
  }
  writeTrajectoryBag(folder / "drive.mcap", drive);
  writeText(folder / "read.mjs", kMcapReader);
  ASSERT_EQ(std::system((inside + "node read.mjs drive.mcap > rows 2> errors").c_str()),
            0)
      << readText(folder / "errors");
  EXPECT_EQ(readText(folder / "rows"), expected);
}

} // namespace
