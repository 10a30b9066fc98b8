// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Byte layout of a message. kRos1: little-endian, packed (ROS 1). kCdr: aligned, with a
 * header for the byte order (ROS 2, OMG DDS-XTypes). kOther: not supported. */
enum class BagEncoding { kRos1, kCdr, kOther };

/** \brief A named stream of messages of a single type. */
struct BagTopic {
  std::string name; ///< "/points"
  std::string type; ///< of the messages, without "msg/": "sensor_msgs/PointCloud2"
  BagEncoding encoding = BagEncoding::kOther;
  std::uint64_t num_messages = 0;
};

/** \brief Where a message is. */
struct BagMessage {
  std::size_t topic = 0;    ///< index in Bag::topics()
  std::int64_t time = 0;    ///< [ns] since 1970, time of recording
  std::size_t part = 0;     ///< file of a recording in several, or chunk
  std::uint64_t offset = 0; ///< within the part [byte], or a key
};

/** \brief A recording of messages, read message by message.
 *
 * Opening reads the index; a recording without index, for example after a crash of the
 * recorder, is scanned once. Reading takes the memory of a chunk. \ingroup sources */
class Bag {
public:
  virtual ~Bag();

  /** \return the file, or the folder of several */
  const std::filesystem::path&
  path() const
  {
    return path_;
  }

  /** \return "ROS 1 bag", "MCAP" or "ROS 2 bag (db3)" */
  virtual std::string
  format() const = 0;

  /** \return the topics in the order of the file; a name appears twice for messages of two types */
  const std::vector<BagTopic>&
  topics() const
  {
    return topics_;
  }

  /** \return all messages by time; messages of equal time in the order of the file */
  const std::vector<BagMessage>&
  messages() const
  {
    return messages_;
  }

  /** \return the missing parts, for example behind a cut, as a single line; empty if undamaged */
  const std::string&
  damage() const
  {
    return damage_;
  }

  /** \brief Reads the bytes of a message. Thread-safe; reading the messages of a chunk in
   * sequence is the fastest.
   * \throws IoFailed the file or the message's chunk is damaged, or of an unknown compression */
  virtual std::vector<std::uint8_t>
  read(const BagMessage& message) const = 0;

protected:
  explicit Bag(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
  std::vector<BagTopic> topics_;
  std::vector<BagMessage> messages_;
  std::string damage_;
};

/** \return whether the name belongs to a recording: .bag, .mcap, .db3 or .db3.zstd, in any case,
 * or a folder with a metadata.yaml (ROS 2) \ingroup sources */
bool
isBag(const std::filesystem::path& path);

/** \return whether BagSource reads the messages of the topic as scans: PointCloud2, CustomMsg of
 * Livox or LaserScan \ingroup sources */
bool
holdsClouds(const BagTopic& topic);

/** \brief Opens a recording: ROS 1 bag 2.0 (uncompressed, bz2, lz4), MCAP (uncompressed, lz4,
 * zstd), ROS 2 db3, or a folder of ROS 2 with metadata.yaml.
 * \throws IoFailed the file is missing, of an unknown format or version, or broken
 * \ingroup sources */
std::shared_ptr<const Bag>
openBag(const std::filesystem::path& path);

} // namespace pcl6d
