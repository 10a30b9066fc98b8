// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/files/byte_writer.h"

#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::sources {

/** \brief Writes an MCAP file of ROS 2 messages in chunks without compression, with an index. */
class McapWriter {
public:
  explicit McapWriter(std::ostream& stream);

  /** \brief Describes a topic of CDR messages. \param[in] definition of the type in ros2msg
   * format
   * \return the number of the topic */
  std::uint16_t
  addTopic(const std::string& topic,
           const std::string& type,
           const std::string& definition);

  /** \param[in] time [ns] of recording and of publishing */
  void
  addMessage(std::uint16_t topic, std::uint64_t time, const std::string& message);

  /** \brief Writes the buffered chunk, and the index. */
  void
  finish();

private:
  using Entries = std::vector<std::pair<std::uint64_t, std::uint64_t>>; // time, offset

  void
  put(const std::string& bytes);
  void
  endChunk();
  std::string
  statistics() const;

  std::ostream& stream_;
  std::uint64_t place_ = 0;  ///< [byte] in the file
  std::string descriptions_; ///< records of types and topics
  std::string indices_;      ///< records of the chunks
  std::uint32_t num_chunks_ = 0;
  std::map<std::uint16_t, std::uint64_t> counts_; ///< messages of each topic
  std::uint64_t first_ = 0, last_ = 0;            ///< [ns] of all messages
  ByteWriter chunk_;                              ///< records
  std::map<std::uint16_t, Entries> entries_;      ///< of the chunk
  std::uint64_t chunk_first_ = 0, chunk_last_ = 0;
};

} // namespace pcl6d::sources
