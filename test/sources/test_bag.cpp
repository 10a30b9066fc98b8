// SPDX-License-Identifier: BSD-3-Clause
#include "sources/made_bag.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/sources/bag.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <sqlite3.h>

namespace {

using namespace pcl6d::test;

/** \return messages of two topics whose order in the file is not that of their times */
std::vector<MadeMessage>
sampleMessages()
{
  std::mt19937 random(7);
  std::vector<MadeMessage> messages;
  for (int i = 0; i < 11; ++i) {
    MadeMessage message;
    message.topic = i % 3 == 0 ? "/odom" : "/points";
    message.type = i % 3 == 0 ? "nav_msgs/Odometry" : "sensor_msgs/PointCloud2";
    message.time = 1600000000000000000 + (i ^ 1) * 100000000LL;
    for (unsigned k = 0; k < 300u * i; ++k)
      message.data += static_cast<char>(random() & 7);
    messages.push_back(message);
  }
  return messages;
}

/** Expects the sample, ordered by time. */
void
expectSample(const pcl6d::Bag& bag)
{
  auto wanted = sampleMessages();
  std::stable_sort(wanted.begin(), wanted.end(), [](const auto& a, const auto& b) {
    return a.time < b.time;
  });
  ASSERT_EQ(bag.messages().size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto& message = bag.messages()[i];
    EXPECT_EQ(message.time, wanted[i].time);
    EXPECT_EQ(bag.topics()[message.topic].name, wanted[i].topic);
    EXPECT_EQ(bag.topics()[message.topic].type, wanted[i].type);
    const auto bytes = bag.read(message);
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()), wanted[i].data);
  }
  std::uint64_t odometry = 0;
  for (const auto& topic : bag.topics())
    if (topic.name == "/odom")
      odometry = topic.num_messages;
  EXPECT_EQ(odometry, 4u);
}

/** \return the message of the error, or "" */
std::string
errorOf(const std::function<void()>& call)
{
  try {
    call();
  } catch (const pcl6d::IoFailed& e) {
    return e.what();
  }
  return "";
}

std::string
errorOfOpening(const std::filesystem::path& path)
{
  return errorOf([&] {
    const auto bag = pcl6d::openBag(path);
    for (const auto& message : bag->messages())
      bag->read(message);
  });
}

#define EXPECT_SAYS(text, part)                                                        \
  EXPECT_NE((text).find(part), std::string::npos) << "it says: " << (text)

TEST(Bag, GivesBackTheMessagesOfEachCompressionWithAndWithoutIndex)
{
  const TempFolder folder;
  for (const std::string kind : {".bag", ".mcap"})
    for (const std::string compression :
         {"none", "lz4", kind == ".bag" ? "bz2" : "zstd"})
      for (const bool has_index : {true, false}) {
        SCOPED_TRACE(kind + " " + compression + (has_index ? "" : " without index"));
        MadeBagOptions options;
        options.compression = compression;
        options.has_index = has_index;
        const auto file = folder / ("a" + kind);
        writeText(file,
                  kind == ".bag" ? rosBagOf(sampleMessages(), options)
                                 : mcapOf(sampleMessages(), options));
        const auto bag = pcl6d::openBag(file);
        EXPECT_EQ(bag->format(), kind == ".bag" ? "ROS 1 bag" : "MCAP");
        EXPECT_EQ(bag->damage().empty(), has_index);
        expectSample(*bag);
      }
}

TEST(Bag, ReadsMcapWithoutChunks)
{
  const TempFolder folder;
  MadeBagOptions options;
  options.has_chunks = false;
  writeText(folder / "a.MCAP", mcapOf(sampleMessages(), options));
  const auto bag = pcl6d::openBag(folder / "a.MCAP");
  EXPECT_EQ(bag->damage(), "");
  expectSample(*bag);
}

TEST(Bag, ACutRecordingIsReadUpToTheCut)
{
  const TempFolder folder;
  for (const std::string kind : {".bag", ".mcap"}) {
    const std::string whole =
        kind == ".bag" ? rosBagOf(sampleMessages()) : mcapOf(sampleMessages());
    const auto file = folder / ("cut" + kind);
    std::size_t most = 0;
    for (std::size_t length = kind == ".bag" ? 4200 : 100; length < whole.size();
         length += 97) {
      writeText(file, whole.substr(0, length));
      const auto bag = pcl6d::openBag(file);
      EXPECT_SAYS(bag->damage(), "cut off");
      EXPECT_SAYS(bag->damage(), kind == ".bag" ? "rosbag reindex" : "mcap recover");
      EXPECT_GE(bag->messages().size(), most);
      most = bag->messages().size();
      for (const auto& message : bag->messages())
        bag->read(message);
    }
    EXPECT_EQ(most, sampleMessages().size());
  }
}

TEST(Bag, AnIndexThatDoesNotFitIsNotBelieved)
{
  const TempFolder folder;
  std::string bytes = mcapOf(sampleMessages());
  const std::size_t count =
      bytes.find(lowFirst(std::uint64_t{11}) + std::string(34, '\0'));
  ASSERT_NE(count, std::string::npos);
  bytes[count] = 12;
  writeText(folder / "a.mcap", bytes);
  expectSample(*pcl6d::openBag(folder / "a.mcap"));
}

TEST(Bag, AWrongChecksumNamesTheChunk)
{
  const TempFolder folder;
  std::string bytes = mcapOf(sampleMessages());
  bytes[bytes.find(sampleMessages()[4].data) + 5] ^= 1;
  writeText(folder / "a.mcap", bytes);
  const std::string error = errorOfOpening(folder / "a.mcap");
  EXPECT_SAYS(error, "a.mcap: chunk 1 (byte ");
  EXPECT_SAYS(error, "wrong checksum");
}

TEST(Bag, UnknownAndBrokenFilesAreRefusedInOneLine)
{
  const TempFolder folder;
  MadeBagOptions options;
  options.compression = "snappy";
  writeText(folder / "a.bag", rosBagOf(sampleMessages(), options));
  EXPECT_SAYS(errorOfOpening(folder / "a.bag"), "unknown compression 'snappy'");
  writeText(folder / "b.bag", "#ROSBAG V1.2\nx");
  EXPECT_SAYS(errorOfOpening(folder / "b.bag"), "rosbag fix");
  writeText(folder / "c.mcap", "");
  EXPECT_SAYS(errorOfOpening(folder / "c.mcap"), "is no MCAP file");
  writeText(folder / "d.db3", "not a database at all");
  EXPECT_SAYS(errorOfOpening(folder / "d.db3"), "is no bag of ROS 2");
  options.compression = "lz4";
  std::string bytes = rosBagOf(sampleMessages(), options);
  bytes[bytes.find("\x04\x22\x4d\x18") + 9] ^= 0x55;
  writeText(folder / "e.bag", bytes);
  EXPECT_SAYS(errorOfOpening(folder / "e.bag"), "lz4 content is damaged");
  EXPECT_SAYS(errorOfOpening(folder / "missing.bag"), "missing.bag");
}

TEST(Bag, AChunkOfMuchMoreThanItsBytesIsRefused)
{
  const TempFolder folder;
  MadeBagOptions options;
  options.compression = "zstd";
  std::vector<MadeMessage> messages(1);
  messages[0].data.assign(std::size_t{129} << 20, 'a'); // packed into 12 kB
  writeText(folder / "a.mcap", mcapOf(messages, options));
  EXPECT_SAYS(errorOfOpening(folder / "a.mcap"), "more than chunks of clouds hold");
}

TEST(Bag, NamesOfTopicsStayInOneLine)
{
  const TempFolder folder;
  auto messages = sampleMessages();
  for (auto& message : messages)
    message.topic += "\n\x01";
  writeText(folder / "a.bag", rosBagOf(messages));
  EXPECT_EQ(pcl6d::openBag(folder / "a.bag")->topics()[0].name, "/odom??");
}

/** Writes the sample as a database of ROS 2. */
void
writeDatabase(const std::filesystem::path& file,
              const std::vector<MadeMessage>& messages,
              const std::string& compression = "none")
{
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  const auto run = [&](const char* command) {
    ASSERT_EQ(sqlite3_exec(database, command, nullptr, nullptr, nullptr), SQLITE_OK);
  };
  run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, "
      "serialization_format TEXT)");
  run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp "
      "INTEGER, data BLOB)");
  run("INSERT INTO topics VALUES(1, '/odom', 'nav_msgs/msg/Odometry', 'cdr')");
  run("INSERT INTO topics VALUES(2, '/points', 'sensor_msgs/msg/PointCloud2', 'cdr')");
  for (const auto& message : messages) {
    sqlite3_stmt* row = nullptr;
    sqlite3_prepare_v2(
        database,
        "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
        -1,
        &row,
        nullptr);
    const std::string data = compressedBy(compression, message.data);
    sqlite3_bind_int(row, 1, message.topic == "/odom" ? 1 : 2);
    sqlite3_bind_int64(row, 2, message.time);
    sqlite3_bind_blob(row, 3, data.data(), static_cast<int>(data.size()), nullptr);
    EXPECT_EQ(sqlite3_step(row), SQLITE_DONE);
    sqlite3_finalize(row);
  }
  sqlite3_close(database);
}

TEST(BagDatabase, GivesBackTheMessagesPlainAndCompressed)
{
  const TempFolder folder;
  writeDatabase(folder / "a.db3", sampleMessages());
  expectSample(*pcl6d::openBag(folder / "a.db3"));
  writeText(folder / "b.db3.zstd", compressedBy("zstd", readText(folder / "a.db3")));
  expectSample(*pcl6d::openBag(folder / "b.db3.zstd"));
  writeText(folder / "c.db3.zstd", readText(folder / "b.db3.zstd").substr(0, 300));
  EXPECT_SAYS(errorOfOpening(folder / "c.db3.zstd"), "cut off");
}

TEST(BagFolder, SplitFilesAreOneRecording)
{
  const TempFolder folder;
  const auto all = sampleMessages();
  writeDatabase(folder / "a_0.db3", {all.begin(), all.begin() + 5}, "zstd");
  writeDatabase(folder / "a_1.db3", {all.begin() + 5, all.end()}, "zstd");
  writeText(folder / "metadata.yaml",
            "rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths:\n"
            "    - a_0.db3\n    - a_1.db3\n  compression_format: zstd\n"
            "  compression_mode: MESSAGE\n");
  EXPECT_TRUE(pcl6d::isBag(folder.path()));
  const auto bag = pcl6d::openBag(folder.path());
  EXPECT_EQ(bag->topics().size(), 2u);
  expectSample(*bag);
  std::filesystem::remove(folder / "a_1.db3");
  EXPECT_SAYS(errorOfOpening(folder.path()),
              "names 'a_1.db3', but the file is missing");
  writeText(folder / "metadata.yaml", "rosbag2_bagfile_information:\n");
  EXPECT_SAYS(errorOfOpening(folder.path()), "names no file");
}

TEST(Bag, IsKnownByItsName)
{
  for (const char* const name :
       {"a.bag", "b.MCAP", "c.db3", "d.db3.zstd", "e.bag.active"})
    EXPECT_TRUE(pcl6d::isBag(name)) << name;
  for (const char* const name : {"bag", ".mcap", "a.bag.pcd", "a.zstd", "a.e57"})
    EXPECT_FALSE(pcl6d::isBag(name)) << name;
}

} // namespace
