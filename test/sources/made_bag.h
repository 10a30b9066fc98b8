// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/** \file Recordings of robots written for tests, byte by byte as their formats say. */
namespace pcl6d::test {

/** \brief A message to record. */
struct MadeMessage {
  std::string topic;
  std::string type;      ///< "sensor_msgs/PointCloud2"
  std::int64_t time = 0; ///< [ns] of recording
  std::string data;
};

/** \brief How messages are recorded. */
struct MadeBagOptions {
  std::string compression = "none"; ///< of chunks: none, lz4, bz2 (ROS 1), zstd (MCAP)
  bool has_index = true;            ///< false: as of a recorder that was killed
  bool has_chunks = true;           ///< MCAP only
  bool has_checksums = true;        ///< MCAP only
  std::size_t messages_per_chunk = 3;
  std::string encoding = "ros1"; ///< of the messages in an MCAP file
};

/** \return the bytes of a ROS 1 bag of version 2.0 */
std::string
rosBagOf(const std::vector<MadeMessage>& messages, const MadeBagOptions& options = {});

/** \return the bytes of an MCAP file */
std::string
mcapOf(const std::vector<MadeMessage>& messages, const MadeBagOptions& options = {});

/** \return compressed bytes: none, lz4 (frame), bz2 or zstd */
std::string
compressedBy(const std::string& compression, const std::string& bytes);

/** \return the number with its lowest byte first */
template <typename T>
std::string
lowFirst(T value)
{
  std::string bytes;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i));
  return bytes;
}

/** \return the text with its length (32 bits) before it */
inline std::string
counted32(const std::string& text)
{
  return lowFirst(static_cast<std::uint32_t>(text.size())) + text;
}

} // namespace pcl6d::test
