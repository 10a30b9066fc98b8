// SPDX-License-Identifier: BSD-3-Clause
#include "sources/made_bag.h"

#include <algorithm>
#include <bzlib.h>
#include <lz4frame.h>
#include <map>
#include <zlib.h>
#include <zstd.h>

namespace pcl6d::test {

namespace {
using Fields = std::vector<std::pair<std::string, std::string>>;

std::string
rosRecord(const Fields& fields, const std::string& data)
{
  std::string header;
  for (const auto& [name, value] : fields)
    header += counted32(name + "=" + value);
  return counted32(header) + counted32(data);
}

std::string
op(int code)
{
  return std::string(1, static_cast<char>(code));
}

std::string
rosTime(std::int64_t time)
{
  return lowFirst(static_cast<std::uint32_t>(time / 1000000000)) +
         lowFirst(static_cast<std::uint32_t>(time % 1000000000));
}

/** \return a number for each pair of topic and type, in the order of the messages */
std::map<std::pair<std::string, std::string>, std::uint32_t>
connectionsOf(const std::vector<MadeMessage>& messages)
{
  std::map<std::pair<std::string, std::string>, std::uint32_t> connections;
  for (const auto& message : messages)
    connections.emplace(std::make_pair(message.topic, message.type),
                        static_cast<std::uint32_t>(connections.size()));
  return connections;
}

std::string
rosConnection(std::uint32_t number, const MadeMessage& message)
{
  return rosRecord(
      {{"op", op(7)}, {"conn", lowFirst(number)}, {"topic", message.topic}},
      counted32("topic=" + message.topic) + counted32("type=" + message.type) +
          counted32("md5sum=*") + counted32("message_definition="));
}

/** \brief Writes a ROS 1 bag chunk by chunk. */
class RosBagFile {
public:
  RosBagFile(const std::vector<MadeMessage>& messages, const MadeBagOptions& options)
  : messages_(messages), options_(options), connections_(connectionsOf(messages))
  {}

  std::string
  finish()
  {
    for (std::size_t i = 0; i < messages_.size(); ++i)
      add(i);
    const std::uint64_t index = options_.has_index ? kStart + body_.size() : 0;
    const Fields fields = {
        {"op", op(3)},
        {"index_pos", lowFirst(index)},
        {"conn_count", lowFirst(static_cast<std::uint32_t>(connections_.size()))},
        {"chunk_count", lowFirst(num_chunks_)}};
    const std::size_t head = rosRecord(fields, "").size();
    std::string file =
        "#ROSBAG V2.0\n" + rosRecord(fields, std::string(kHeader - head, ' ')) + body_;
    if (!options_.has_index)
      return file;
    for (const auto& [number, record] : described_)
      file += record;
    return file + infos_;
  }

private:
  static constexpr std::size_t kHeader = 4096;        // [byte]
  static constexpr std::size_t kStart = 13 + kHeader; // [byte] version and header

  void
  add(std::size_t i)
  {
    const MadeMessage& message = messages_[i];
    const std::uint32_t number = connections_.at({message.topic, message.type});
    if (described_.count(number) == 0)
      chunk_ += described_[number] = rosConnection(number, message);
    index_[number] +=
        rosTime(message.time) + lowFirst(static_cast<std::uint32_t>(chunk_.size()));
    chunk_ += rosRecord(
        {{"op", op(2)}, {"conn", lowFirst(number)}, {"time", rosTime(message.time)}},
        message.data);
    if (++in_chunk_ == options_.messages_per_chunk || i + 1 == messages_.size())
      closeChunk();
  }

  void
  closeChunk()
  {
    const std::uint64_t place = kStart + body_.size();
    body_ += rosRecord({{"op", op(5)},
                        {"compression", options_.compression},
                        {"size", lowFirst(static_cast<std::uint32_t>(chunk_.size()))}},
                       compressedBy(options_.compression, chunk_));
    const auto version = lowFirst(std::uint32_t{1});
    std::string counts;
    for (const auto& [number, entries] : index_) {
      const auto count = lowFirst(static_cast<std::uint32_t>(entries.size() / 12));
      body_ += rosRecord({{"op", op(4)},
                          {"ver", version},
                          {"conn", lowFirst(number)},
                          {"count", count}},
                         entries);
      counts += lowFirst(number) + count;
    }
    infos_ +=
        rosRecord({{"op", op(6)},
                   {"ver", version},
                   {"chunk_pos", lowFirst(place)},
                   {"start_time", rosTime(0)},
                   {"end_time", rosTime(0)},
                   {"count", lowFirst(static_cast<std::uint32_t>(index_.size()))}},
                  counts);
    ++num_chunks_;
    chunk_.clear();
    index_.clear();
    in_chunk_ = 0;
  }

  const std::vector<MadeMessage>& messages_;
  const MadeBagOptions& options_;
  std::map<std::pair<std::string, std::string>, std::uint32_t> connections_;
  std::map<std::uint32_t, std::string> described_;
  std::string body_, infos_, chunk_;
  std::map<std::uint32_t, std::string> index_; ///< of the chunk, by connection
  std::size_t in_chunk_ = 0;
  std::uint32_t num_chunks_ = 0;
};

std::string
mcapRecord(int code, const std::string& data)
{
  return op(code) + lowFirst(static_cast<std::uint64_t>(data.size())) + data;
}

std::uint32_t
crcOf(const std::string& bytes)
{
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/** \brief Writes an MCAP file message by message. */
class McapFile {
public:
  McapFile(const std::vector<MadeMessage>& messages, const MadeBagOptions& options)
  : messages_(messages), options_(options), channels_(connectionsOf(messages))
  {
    file_ = kMagic + mcapRecord(1, counted32(options.encoding) + counted32("test"));
  }

  std::string
  finish()
  {
    for (std::size_t i = 0; i < messages_.size(); ++i)
      add(i);
    if (!options_.has_index)
      return file_;
    file_ += mcapRecord(15, lowFirst(std::uint32_t{0}));
    const std::uint64_t summary = file_.size();
    for (const auto& [key, number] : channels_)
      file_ += description(key, number);
    file_ += chunk_indices_;
    file_ += mcapRecord(11,
                        lowFirst(static_cast<std::uint64_t>(messages_.size())) +
                            std::string(2 + 4 * 4 + 8 * 2, '\0') + counted32(""));
    file_ += mcapRecord(2, lowFirst(summary) + std::string(12, '\0'));
    return file_ + kMagic;
  }

private:
  inline static const std::string kMagic = "\x89MCAP0\r\n";

  std::string
  description(const std::pair<std::string, std::string>& key, std::uint32_t number)
  {
    const auto id = lowFirst(static_cast<std::uint16_t>(number + 1));
    return mcapRecord(
               3, id + counted32(key.second) + counted32("ros1msg") + counted32("")) +
           mcapRecord(4,
                      id + id + counted32(key.first) + counted32(options_.encoding) +
                          counted32(""));
  }

  void
  add(std::size_t i)
  {
    const MadeMessage& message = messages_[i];
    const auto key = std::make_pair(message.topic, message.type);
    const std::uint32_t number = channels_.at(key);
    std::string& target = options_.has_chunks ? chunk_ : file_;
    if (std::find(described_.begin(), described_.end(), number) == described_.end()) {
      target += description(key, number);
      described_.push_back(number);
    }
    const auto id = static_cast<std::uint16_t>(number + 1);
    const auto time = lowFirst(static_cast<std::uint64_t>(message.time));
    index_[id] += time + lowFirst(static_cast<std::uint64_t>(target.size()));
    target += mcapRecord(
        5, lowFirst(id) + lowFirst(std::uint32_t{0}) + time + time + message.data);
    ++in_chunk_;
    if (options_.has_chunks &&
        (in_chunk_ == options_.messages_per_chunk || i + 1 == messages_.size()))
      closeChunk();
  }

  void
  closeChunk()
  {
    const std::string packed = compressedBy(options_.compression, chunk_);
    const std::string name = options_.compression == "none" ? "" : options_.compression;
    const std::uint64_t place = file_.size(), size = chunk_.size();
    file_ += mcapRecord(
        6,
        std::string(16, '\0') + lowFirst(size) +
            lowFirst(options_.has_checksums ? crcOf(chunk_) : std::uint32_t{0}) +
            counted32(name) + lowFirst(static_cast<std::uint64_t>(packed.size())) +
            packed);
    const std::uint64_t length = file_.size() - place;
    std::string offsets;
    for (const auto& [id, entries] : index_) {
      offsets += lowFirst(id) + lowFirst(static_cast<std::uint64_t>(file_.size()));
      file_ += mcapRecord(7, lowFirst(id) + counted32(entries));
    }
    chunk_indices_ += mcapRecord(
        8,
        std::string(16, '\0') + lowFirst(place) + lowFirst(length) +
            counted32(offsets) + lowFirst(std::uint64_t{0}) + counted32(name) +
            lowFirst(static_cast<std::uint64_t>(packed.size())) + lowFirst(size));
    chunk_.clear();
    index_.clear();
    in_chunk_ = 0;
  }

  const std::vector<MadeMessage>& messages_;
  const MadeBagOptions& options_;
  std::map<std::pair<std::string, std::string>, std::uint32_t> channels_;
  std::vector<std::uint32_t> described_;
  std::string file_, chunk_, chunk_indices_;
  std::map<std::uint16_t, std::string> index_; ///< of the chunk, by channel
  std::size_t in_chunk_ = 0;
};
} // namespace

std::string
compressedBy(const std::string& compression, const std::string& bytes)
{
  if (compression == "lz4") {
    std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
    packed.resize(LZ4F_compressFrame(
        packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
    return packed;
  }
  if (compression == "zstd") {
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    packed.resize(
        ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
    return packed;
  }
  if (compression == "bz2") {
    std::string packed(bytes.size() + bytes.size() / 50 + 1000, '\0');
    auto size = static_cast<unsigned>(packed.size());
    BZ2_bzBuffToBuffCompress(packed.data(),
                             &size,
                             const_cast<char*>(bytes.data()),
                             static_cast<unsigned>(bytes.size()),
                             9,
                             0,
                             0);
    packed.resize(size);
    return packed;
  }
  return bytes;
}

std::string
rosBagOf(const std::vector<MadeMessage>& messages, const MadeBagOptions& options)
{
  return RosBagFile(messages, options).finish();
}

std::string
mcapOf(const std::vector<MadeMessage>& messages, const MadeBagOptions& options)
{
  return McapFile(messages, options).finish();
}

} // namespace pcl6d::test
