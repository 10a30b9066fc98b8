// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/bag_input.h"

#include <pcl6d/sources/bag.h>

#include <memory>
#include <mutex>
#include <optional>

namespace pcl6d::sources {

/** \brief A compressed block of messages. */
struct BagChunk {
  std::uint64_t place = 0;  ///< of the compressed bytes in the file
  std::uint64_t length = 0; ///< [byte] compressed
  std::uint64_t size = 0;   ///< [byte] of the content
  std::uint32_t crc = 0;    ///< CRC-32 of the content; 0: not known
  std::string compression;
};

/** \brief A recording in separately compressed chunks: common parts of ROS 1 bags and MCAP. */
class ChunkedBag : public Bag {
public:
  std::vector<std::uint8_t>
  read(const BagMessage& message) const override;

protected:
  explicit ChunkedBag(const std::filesystem::path& path);

  /** \return the bytes of the message whose record begins at the offset
   * \param[in] what name of the chunk, for the message */
  virtual Bytes
  payloadAt(Bytes content, std::uint64_t offset, const std::string& what) const = 0;

  /** \return the content of a chunk, cached until a different chunk is requested
   * \throws IoFailed the chunk is damaged */
  std::shared_ptr<const std::vector<std::uint8_t>>
  contentOf(std::size_t chunk) const;

  /** \return "chunk 3 (byte 4117)" */
  std::string
  titleOf(std::size_t chunk) const;

  /** \return the index of the topic, created if new */
  std::size_t
  topicOf(const std::string& recorded_name,
          const std::string& recorded_type,
          BagEncoding encoding);

  /** Sorts the messages by time, and counts the messages of each topic. */
  void
  finishIndex();

  /** Records that the file is unread behind the position.
   * \param[in] reason content found at the position; empty: the file just ends */
  void
  noteCut(std::uint64_t place, const std::string& reason, const std::string& next_step);

  mutable std::mutex mutex_; ///< of the two below
  mutable BagInput input_;
  mutable std::shared_ptr<const std::vector<std::uint8_t>> content_;
  mutable std::optional<std::size_t> loaded_; ///< chunk
  std::vector<BagChunk> chunks_;
};

/** \return the type in ROS 1's notation: "sensor_msgs/PointCloud2" for
 * "sensor_msgs/msg/PointCloud2" */
std::string
plainTypeName(std::string type);

/** \brief Opens a ROS 1 bag of version 2.0. \throws IoFailed under the conditions of openBag() */
std::shared_ptr<const Bag>
openRosBag(const std::filesystem::path& path);

/** \brief Opens an MCAP file. \throws IoFailed under the conditions of openBag() */
std::shared_ptr<const Bag>
openMcap(const std::filesystem::path& path);

} // namespace pcl6d::sources
