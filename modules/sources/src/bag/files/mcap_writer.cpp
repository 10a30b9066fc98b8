// SPDX-License-Identifier: BSD-3-Clause
// Format: "MCAP file format specification", mcap.dev/spec.
#include "bag/files/mcap_records.h"
#include "bag/files/mcap_writer.h"

#include <algorithm>
#include <ostream>
#include <zlib.h>

namespace pcl6d::sources {

namespace {
constexpr std::size_t kChunkSize = 786432; ///< [byte] 768 kB, the default of rosbag2

/** \return the kind and the length of a record, followed by the content */
std::string
recordOf(McapOp kind, const ByteWriter& content)
{
  return ByteWriter()
      .number(static_cast<std::uint8_t>(kind))
      .number(static_cast<std::uint64_t>(content.bytes().size()))
      .raw(content.bytes())
      .bytes();
}

std::uint32_t
crcOf(const std::string& bytes)
{
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}
} // namespace

McapWriter::McapWriter(std::ostream& stream) : stream_(stream)
{
  put(std::string(kMcapMagic, sizeof kMcapMagic));
  put(recordOf(kMcapHeader, ByteWriter().counted("ros2").counted("pcl6d")));
}

void
McapWriter::put(const std::string& bytes)
{
  stream_ << bytes;
  place_ += bytes.size();
}

std::uint16_t
McapWriter::addTopic(const std::string& topic,
                     const std::string& type,
                     const std::string& definition)
{
  const auto number = static_cast<std::uint16_t>(counts_.size() + 1);
  counts_[number] = 0;
  const std::string schema = recordOf(
      kMcapSchema,
      ByteWriter().number(number).counted(type).counted("ros2msg").counted(definition));
  const std::string channel = recordOf(
      kMcapChannel,
      ByteWriter().number(number).number(number).counted(topic).counted("cdr").counted(
          "")); // no metadata
  descriptions_ += schema + channel;
  put(schema + channel);
  return number;
}

void
McapWriter::addMessage(std::uint16_t topic,
                       std::uint64_t time,
                       const std::string& message)
{
  const bool is_first = entries_.empty();
  chunk_first_ = is_first ? time : std::min(chunk_first_, time);
  chunk_last_ = is_first ? time : std::max(chunk_last_, time);
  entries_[topic].emplace_back(time, chunk_.bytes().size());
  chunk_.raw(recordOf(kMcapMessage,
                      ByteWriter()
                          .number(topic)
                          .number(static_cast<std::uint32_t>(counts_[topic]++))
                          .number(time)
                          .number(time)
                          .raw(message)));
  if (chunk_.bytes().size() >= kChunkSize)
    endChunk();
}

void
McapWriter::endChunk()
{
  if (entries_.empty())
    return;
  const std::uint64_t size = chunk_.bytes().size(), begin = place_;
  put(recordOf(kMcapChunk,
               ByteWriter()
                   .number(chunk_first_)
                   .number(chunk_last_)
                   .number(size)
                   .number(crcOf(chunk_.bytes()))
                   .counted("") // no compression
                   .number(size)
                   .raw(chunk_.bytes())));
  const std::uint64_t length = place_ - begin, index = place_;
  ByteWriter offsets;
  for (const auto& [topic, entries] : entries_) {
    offsets.number(topic).number(place_);
    ByteWriter rows;
    for (const auto& [time, offset] : entries)
      rows.number(time).number(offset);
    put(recordOf(kMcapMessageIndex, ByteWriter().number(topic).counted(rows.bytes())));
  }
  indices_ += recordOf(kMcapChunkIndex,
                       ByteWriter()
                           .number(chunk_first_)
                           .number(chunk_last_)
                           .number(begin)
                           .number(length)
                           .counted(offsets.bytes())
                           .number(place_ - index)
                           .counted("")
                           .number(size)
                           .number(size));
  first_ = num_chunks_ == 0 ? chunk_first_ : std::min(first_, chunk_first_);
  last_ = num_chunks_ == 0 ? chunk_last_ : std::max(last_, chunk_last_);
  ++num_chunks_;
  entries_.clear();
  chunk_ = ByteWriter();
}

std::string
McapWriter::statistics() const
{
  std::uint64_t messages = 0;
  ByteWriter counts;
  for (const auto& [topic, count] : counts_) {
    messages += count;
    counts.number(topic).number(count);
  }
  constexpr std::uint32_t kNone = 0; // attachments, metadata
  return recordOf(kMcapStatistics,
                  ByteWriter()
                      .number(messages)
                      .number(static_cast<std::uint16_t>(counts_.size()))
                      .number(static_cast<std::uint32_t>(counts_.size()))
                      .number(kNone)
                      .number(kNone)
                      .number(num_chunks_)
                      .number(first_)
                      .number(last_)
                      .counted(counts.bytes()));
}

void
McapWriter::finish()
{
  endChunk();
  constexpr std::uint32_t kNoChecksum = 0; // the chunks have theirs
  put(recordOf(kMcapDataEnd, ByteWriter().number(kNoChecksum)));
  constexpr std::uint64_t kNoOffsets = 0;
  constexpr std::uint64_t kFooterLength = 8 + 8 + 4; // [byte]
  const std::string summary = descriptions_ + statistics() + indices_;
  const std::string footer = ByteWriter()
                                 .number(static_cast<std::uint8_t>(kMcapFooter))
                                 .number(kFooterLength)
                                 .number(place_)
                                 .number(kNoOffsets)
                                 .bytes();
  put(summary);
  put(ByteWriter().raw(footer).number(crcOf(summary + footer)).bytes());
  put(std::string(kMcapMagic, sizeof kMcapMagic));
}

} // namespace pcl6d::sources
