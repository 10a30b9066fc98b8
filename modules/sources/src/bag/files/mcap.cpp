// SPDX-License-Identifier: BSD-3-Clause
// Format: "MCAP file format specification", mcap.dev/spec.
#include "bag/files/chunked_bag.h"
#include "bag/files/mcap_records.h"

#include <pcl6d/common/error.h>

#include <algorithm>
#include <cstring>
#include <map>

namespace pcl6d::sources {

namespace {
constexpr std::size_t kMcapHead = 9; // [byte] kind and length of a record
constexpr std::size_t kFooterSize = kMcapHead + 8 + 8 + 4;
constexpr const char* kRecover = "`mcap recover` writes an index";

/** \brief An MCAP file. */
class Mcap : public ChunkedBag {
public:
  explicit Mcap(const std::filesystem::path& path) : ChunkedBag(path)
  {
    if (!input_.has(0, sizeof kMcapMagic) || !hasMagic(0))
      text::fail(path_, "is no MCAP file: does not begin with the bytes 89 MCAP 0");
    if (!readIndex())
      lookThrough();
    finishIndex();
  }

  std::string
  format() const override
  {
    return "MCAP";
  }

protected:
  Bytes
  payloadAt(Bytes content, std::uint64_t offset, const std::string& what) const override
  {
    ByteReader reader(path_, what, content);
    reader.take(offset);
    if (reader.number<std::uint8_t>() != kMcapMessage)
      text::fail(path_,
                 what + ": no message at offset " + std::to_string(offset) +
                     ", the index is damaged; " + kRecover);
    const Bytes record = reader.take(reader.number<std::uint64_t>());
    ByteReader message(path_, what, record);
    message.take(kMessageHead);
    return message.take(message.left());
  }

private:
  static constexpr std::size_t kMessageHead = 22; ///< [byte] channel, number, two times

  bool
  hasMagic(std::uint64_t place)
  {
    const auto bytes = input_.read(place, sizeof kMcapMagic, "the magic bytes");
    return std::memcmp(bytes.data(), kMcapMagic, sizeof kMcapMagic) == 0;
  }

  /** \brief The head of a record in the file. */
  struct Record {
    std::uint8_t op = 0;
    std::uint64_t data = 0; ///< [byte] offset in the file
    std::uint64_t size = 0; ///< [byte]
    std::uint64_t
    end() const
    {
      return data + size;
    }
  };

  /** \return whether the whole record is in the file */
  bool
  readRecord(std::uint64_t place, Record& record)
  {
    if (!input_.has(place, kMcapHead))
      return false;
    const auto head = input_.read(place, kMcapHead, "a record");
    ByteReader reader(path_, kRecord, {head.data(), head.size()});
    record.op = reader.number<std::uint8_t>();
    record.size = reader.number<std::uint64_t>();
    record.data = place + kMcapHead;
    return input_.has(record.data, record.size);
  }

  void
  addSchema(ByteReader reader)
  {
    const auto id = reader.number<std::uint16_t>();
    schemas_[id] = plainTypeName(reader.string());
  }

  void
  addChannel(ByteReader reader)
  {
    const auto id = reader.number<std::uint16_t>();
    const auto schema = schemas_.find(reader.number<std::uint16_t>());
    const std::string topic = reader.string(), encoding = reader.string();
    topics_of_[id] = topicOf(topic,
                             schema == schemas_.end() ? "" : schema->second,
                             encoding == "ros1"  ? BagEncoding::kRos1
                             : encoding == "cdr" ? BagEncoding::kCdr
                                                 : BagEncoding::kOther);
  }

  std::size_t
  topicOfChannel(std::uint16_t channel) const
  {
    const auto found = topics_of_.find(channel);
    if (found == topics_of_.end())
      text::fail(path_,
                 "a message is of channel " + std::to_string(channel) +
                     ", not described earlier in the file");
    return found->second;
  }

  void
  addMessage(ByteReader reader, std::size_t chunk, std::uint64_t offset)
  {
    const std::size_t topic = topicOfChannel(reader.number<std::uint16_t>());
    reader.number<std::uint32_t>(); // sequence number
    messages_.push_back({topic,
                         static_cast<std::int64_t>(reader.number<std::uint64_t>()),
                         chunk,
                         offset});
  }

  /** \brief Content of the summary at the end of the file. */
  struct Summary {
    std::optional<std::uint64_t> num_messages;
    std::vector<std::uint64_t> indices; ///< offsets of the message indices
    std::vector<std::size_t> chunks;    ///< chunk of each message index
  };

  /** \return whether the file ends with an index of all messages; otherwise the index is
   * discarded */
  bool
  readIndex()
  {
    const std::uint64_t end = sizeof kMcapMagic + kFooterSize;
    if (!input_.has(sizeof kMcapMagic, end) || !hasMagic(input_.size() - 8))
      return false;
    is_closed_ = true;
    const std::uint64_t footer = input_.size() - end;
    Record record;
    if (!readRecord(footer, record) || record.op != kMcapFooter)
      return false;
    const auto bytes = input_.read(record.data, 8, "the footer");
    std::uint64_t place = ByteReader(path_, kRecord, {bytes.data(), bytes.size()})
                              .number<std::uint64_t>();
    Summary summary;
    bool is_whole = place > 0 && place < footer;
    while (is_whole && place < footer) {
      is_whole = readRecord(place, record);
      if (is_whole)
        readSummary(record, summary);
      place = record.end();
    }
    for (std::size_t i = 0; is_whole && i < summary.indices.size(); ++i)
      is_whole = readMessageIndex(summary.indices[i], summary.chunks[i]);
    if (is_whole && summary.num_messages == messages_.size())
      return true;
    chunks_.clear();
    messages_.clear();
    return false;
  }

  void
  readSummary(const Record& record, Summary& summary)
  {
    if (record.op != kMcapSchema && record.op != kMcapChannel &&
        record.op != kMcapChunkIndex && record.op != kMcapStatistics)
      return;
    const auto bytes = input_.read(record.data, record.size, "the summary");
    ByteReader reader(path_, kRecord, {bytes.data(), bytes.size()});
    if (record.op == kMcapSchema)
      addSchema(reader);
    else if (record.op == kMcapChannel)
      addChannel(reader);
    else if (record.op == kMcapStatistics)
      summary.num_messages = reader.number<std::uint64_t>();
    else
      readChunkIndex(reader, summary);
  }

  void
  readChunkIndex(ByteReader& reader, Summary& summary)
  {
    reader.take(16); // first and last time
    Record record;
    const auto place = reader.number<std::uint64_t>();
    reader.number<std::uint64_t>(); // length of the chunk
    if (!readRecord(place, record) || record.op != kMcapChunk)
      text::fail(path_,
                 "no chunk at byte " + std::to_string(place) +
                     ", where the index says; " + kRecover);
    addChunk(record);
    ByteReader offsets(path_, kRecord, reader.take(reader.number<std::uint32_t>()));
    while (offsets.left() > 0) {
      offsets.number<std::uint16_t>(); // channel
      summary.indices.push_back(offsets.number<std::uint64_t>());
      summary.chunks.push_back(chunks_.size() - 1);
    }
  }

  /** Reads the head of a chunk. */
  void
  addChunk(const Record& record)
  {
    const std::uint64_t most =
        8 + 8 + 8 + 4 + 4 + 64 + 8; // a compression of 64 letters
    const auto bytes =
        input_.read(record.data, std::min(record.size, most), "the head of a chunk");
    ByteReader reader(path_, kRecord, {bytes.data(), bytes.size()});
    reader.take(16); // first and last time
    BagChunk chunk;
    chunk.size = reader.number<std::uint64_t>();
    chunk.crc = reader.number<std::uint32_t>();
    chunk.compression = reader.string();
    chunk.length = reader.number<std::uint64_t>();
    chunk.place = record.data + reader.position();
    if (chunk.length > record.end() - chunk.place)
      text::fail(path_,
                 "the chunk at byte " + std::to_string(record.data) +
                     " is damaged: messages go on behind the end of the chunk");
    chunks_.push_back(std::move(chunk));
  }

  bool
  readMessageIndex(std::uint64_t place, std::size_t chunk)
  {
    Record record;
    if (!readRecord(place, record) || record.op != kMcapMessageIndex)
      return false;
    const auto bytes = input_.read(record.data, record.size, "an index");
    ByteReader reader(path_, kRecord, {bytes.data(), bytes.size()});
    const std::size_t topic = topicOfChannel(reader.number<std::uint16_t>());
    ByteReader entries(path_, kRecord, reader.take(reader.number<std::uint32_t>()));
    while (entries.left() > 0) {
      const auto time = static_cast<std::int64_t>(entries.number<std::uint64_t>());
      messages_.push_back({topic, time, chunk, entries.number<std::uint64_t>()});
    }
    return true;
  }

  /** Finds the messages of a file without an index, or without chunks, up to the first truncated
   * record. */
  void
  lookThrough()
  {
    std::uint64_t place = sizeof kMcapMagic;
    std::string reason;
    bool has_ended = false;
    try {
      Record record;
      while (!has_ended && readRecord(place, record)) {
        readDataRecord(place, record);
        has_ended = record.op == kMcapDataEnd || record.op == kMcapFooter;
        place = record.end();
      }
    } catch (const IoFailed& e) {
      reason = e.what();
    }
    if (!has_ended || !is_closed_)
      noteCut(place, reason, kRecover);
  }

  void
  readDataRecord(std::uint64_t place, const Record& record)
  {
    if (record.op == kMcapChunk) {
      addChunk(record);
      lookThroughChunk(chunks_.size() - 1);
    }
    else if (record.op == kMcapSchema || record.op == kMcapChannel)
      describe(record);
    else if (record.op == kMcapMessage) {
      const std::uint64_t length = record.end() - place;
      chunks_.push_back({place, length, length, 0, ""});
      const auto head = input_.read(
          record.data, std::min<std::uint64_t>(record.size, kMessageHead), "a message");
      addMessage({path_, kRecord, {head.data(), head.size()}}, chunks_.size() - 1, 0);
    }
  }

  void
  describe(const Record& record)
  {
    const auto bytes = input_.read(record.data, record.size, "a description");
    const ByteReader reader(path_, kRecord, {bytes.data(), bytes.size()});
    if (record.op == kMcapSchema)
      addSchema(reader);
    else
      addChannel(reader);
  }

  void
  lookThroughChunk(std::size_t chunk)
  {
    const auto content = contentOf(chunk);
    const std::string what = titleOf(chunk);
    ByteReader reader(path_, what, {content->data(), content->size()});
    while (reader.left() > 0) {
      const std::uint64_t offset = reader.position();
      const auto op = reader.number<std::uint8_t>();
      const ByteReader record(path_, what, reader.take(reader.number<std::uint64_t>()));
      if (op == kMcapSchema)
        addSchema(record);
      else if (op == kMcapChannel)
        addChannel(record);
      else if (op == kMcapMessage)
        addMessage(record, chunk, offset);
    }
  }

  inline static const std::string kRecord = "a record";
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, std::size_t> topics_of_; ///< of channels
  bool is_closed_ = false; ///< the file ends with the magic bytes
};
} // namespace

std::shared_ptr<const Bag>
openMcap(const std::filesystem::path& path)
{
  return std::make_shared<Mcap>(path);
}

} // namespace pcl6d::sources
