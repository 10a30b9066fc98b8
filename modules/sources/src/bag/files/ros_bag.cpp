// SPDX-License-Identifier: BSD-3-Clause
// Format: "ROS bag format 2.0", wiki.ros.org/Bags/Format/2.0.
#include "bag/files/chunked_bag.h"

#include <pcl6d/common/error.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pcl6d::sources {

namespace {
constexpr char kRosBagVersion[] = "#ROSBAG V2.0\n";
constexpr std::size_t kRosBagStart = sizeof kRosBagVersion - 1; // [byte]
constexpr const char* kReindex = "`rosbag reindex` writes an index";

/** The field `op` of a record. */
enum RosBagOp : std::uint8_t {
  kOpMessage = 2,
  kOpHeader = 3,
  kOpIndex = 4,
  kOpChunk = 5,
  kOpChunkInfo = 6,
  kOpConnection = 7
};

/** \brief Fields "name=value" of a header. */
class RosBagFields {
public:
  RosBagFields(const std::filesystem::path& path, const std::string& what, Bytes bytes)
  : path_(path), what_(what)
  {
    ByteReader reader(path, what, bytes);
    while (reader.left() > 0) {
      std::string field = reader.string();
      const std::size_t equals = field.find('=');
      if (equals == std::string::npos)
        text::fail(path, what + " has a field without '=': " + text::quoted(field));
      values_[field.substr(0, equals)] = field.substr(equals + 1);
    }
  }

  const std::string*
  find(const std::string& name) const
  {
    const auto found = values_.find(name);
    return found == values_.end() ? nullptr : &found->second;
  }

  /** \return a number of the width of T \throws IoFailed the field is missing, or of another
   * width */
  template <typename T>
  T
  number(const std::string& name) const
  {
    const std::string* const value = find(name);
    if (value == nullptr || value->size() != sizeof(T))
      text::fail(path_,
                 what_ + " has no field " + name + " of " + std::to_string(sizeof(T)) +
                     " bytes");
    return ByteReader(path_,
                      what_,
                      {reinterpret_cast<const std::uint8_t*>(value->data()), sizeof(T)})
        .number<T>();
  }

private:
  const std::filesystem::path& path_;
  std::string what_;
  std::map<std::string, std::string> values_;
};

/** \return [ns] of seconds (low half) and nanoseconds (high half) */
std::int64_t
nanosecondsOf(std::uint64_t time)
{
  return static_cast<std::int64_t>(time & 0xFFFFFFFFu) * 1000000000 +
         static_cast<std::int64_t>(time >> 32);
}

/** \brief A ROS 1 bag. */
class RosBag : public ChunkedBag {
public:
  explicit RosBag(const std::filesystem::path& path) : ChunkedBag(path)
  {
    const std::uint64_t index = readStart();
    if (index == 0 || !readIndex(index))
      lookThrough();
    finishIndex();
  }

  std::string
  format() const override
  {
    return "ROS 1 bag";
  }

protected:
  Bytes
  payloadAt(Bytes content, std::uint64_t offset, const std::string& what) const override
  {
    ByteReader reader(path_, what, content);
    reader.take(offset);
    const RosBagFields fields(path_, what, reader.take(reader.number<std::uint32_t>()));
    if (fields.number<std::uint8_t>("op") != kOpMessage)
      text::fail(path_,
                 what + ": no message at offset " + std::to_string(offset) +
                     ", the index is damaged; " + kReindex);
    return reader.take(reader.number<std::uint32_t>());
  }

private:
  /** \brief A record of the file, with the data unread. */
  struct Record {
    std::vector<std::uint8_t> header;
    std::uint64_t data = 0; ///< [byte] offset in the file
    std::uint64_t size = 0; ///< [byte] of the data
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
    const auto lengthAt = [&](std::uint64_t at) {
      const auto bytes = input_.read(at, 4, "a length");
      return ByteReader(path_, kRecord, {bytes.data(), bytes.size()})
          .number<std::uint32_t>();
    };
    if (!input_.has(place, 4))
      return false;
    const std::uint64_t header = lengthAt(place);
    if (!input_.has(place + 4, header + 4))
      return false;
    record.header = input_.read(place + 4, header, "a header");
    record.data = place + 8 + header;
    record.size = lengthAt(place + 4 + header);
    return input_.has(record.data, record.size);
  }

  RosBagFields
  fieldsOf(const Record& record) const
  {
    return {path_,
            "the record before byte " + std::to_string(record.data),
            {record.header.data(), record.header.size()}};
  }

  /** \return the position of the index; 0: no index */
  std::uint64_t
  readStart()
  {
    const std::uint64_t known = std::min<std::uint64_t>(kRosBagStart, input_.size());
    const auto start = input_.read(0, known, "the version");
    const std::string version(start.begin(), start.end());
    if (version != kRosBagVersion)
      text::fail(path_,
                 "is no ROS bag of version 2.0: begins with " +
                     text::quoted(version.substr(0, version.find('\n'))) +
                     (version.rfind("#ROSBAG V1", 0) == 0
                          ? "; `rosbag fix` converts older bags"
                          : ""));
    Record record;
    if (!readRecord(kRosBagStart, record))
      text::fail(path_, "ends within the header: empty recording");
    const RosBagFields fields = fieldsOf(record);
    if (fields.number<std::uint8_t>("op") != kOpHeader)
      text::fail(path_, "does not begin with the header of a bag");
    const std::string* const encryptor = fields.find("encryptor");
    if (encryptor != nullptr && !encryptor->empty())
      text::fail(path_,
                 "is encrypted by " + text::quoted(*encryptor) +
                     "; `rosbag decrypt` writes a plain bag");
    first_ = record.end();
    return fields.number<std::uint64_t>("index_pos");
  }

  void
  addConnection(const RosBagFields& fields, Bytes data)
  {
    const RosBagFields inner(path_, "a connection", data);
    const std::string* const type = inner.find("type");
    const std::string* const topic = fields.find("topic");
    if (type == nullptr || topic == nullptr)
      text::fail(path_, "a connection has no topic or no type");
    topics_of_[fields.number<std::uint32_t>("conn")] =
        topicOf(*topic, *type, BagEncoding::kRos1);
  }

  std::size_t
  topicOfConnection(std::uint32_t connection) const
  {
    const auto found = topics_of_.find(connection);
    if (found == topics_of_.end())
      text::fail(path_,
                 "a message is of connection " + std::to_string(connection) +
                     ", not described in the bag");
    return found->second;
  }

  void
  addChunk(const Record& record, const RosBagFields& fields)
  {
    const std::string* const compression = fields.find("compression");
    chunks_.push_back({record.data,
                       record.size,
                       fields.number<std::uint32_t>("size"),
                       0,
                       compression != nullptr ? *compression : ""});
  }

  /** \return whether the index is complete; otherwise the index is discarded */
  bool
  readIndex(std::uint64_t place)
  {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> infos; // offset, connections
    bool is_whole = place <= input_.size();
    while (is_whole && place < input_.size()) {
      Record record;
      is_whole = readRecord(place, record);
      if (!is_whole)
        break;
      const RosBagFields fields = fieldsOf(record);
      const auto op = fields.number<std::uint8_t>("op");
      if (op == kOpConnection) {
        const auto data = input_.read(record.data, record.size, "a connection");
        addConnection(fields, {data.data(), data.size()});
      }
      else if (op == kOpChunkInfo)
        infos.emplace_back(fields.number<std::uint64_t>("chunk_pos"),
                           fields.number<std::uint32_t>("count"));
      place = record.end();
    }
    for (std::size_t i = 0; is_whole && i < infos.size(); ++i)
      is_whole = readChunkIndex(infos[i].first, infos[i].second);
    if (!is_whole) {
      chunks_.clear();
      messages_.clear();
    }
    return is_whole;
  }

  bool
  readChunkIndex(std::uint64_t place, std::uint32_t connections)
  {
    Record record;
    if (!readRecord(place, record))
      return false;
    const RosBagFields fields = fieldsOf(record);
    if (fields.number<std::uint8_t>("op") != kOpChunk)
      return false;
    addChunk(record, fields);
    for (std::uint32_t i = 0; i < connections; ++i) {
      place = record.end();
      if (!readRecord(place, record))
        return false;
      const RosBagFields index = fieldsOf(record);
      if (index.number<std::uint8_t>("op") != kOpIndex)
        return false;
      const auto data = input_.read(record.data, record.size, "an index");
      const std::size_t topic = topicOfConnection(index.number<std::uint32_t>("conn"));
      ByteReader reader(path_, kRecord, {data.data(), data.size()});
      while (reader.left() > 0) {
        const std::int64_t time = nanosecondsOf(reader.number<std::uint64_t>());
        messages_.push_back(
            {topic, time, chunks_.size() - 1, reader.number<std::uint32_t>()});
      }
    }
    return true;
  }

  /** Finds the messages of a bag without an index, up to the first truncated record. */
  void
  lookThrough()
  {
    std::uint64_t place = first_;
    std::string reason;
    try {
      Record record;
      while (place < input_.size() && readRecord(place, record)) {
        readBodyRecord(place, record);
        place = record.end();
      }
    } catch (const IoFailed& e) {
      reason = e.what();
    }
    noteCut(place, reason, kReindex);
  }

  /** For an unclosed chunk, the records follow uncompressed. */
  void
  readBodyRecord(std::uint64_t place, const Record& record)
  {
    const RosBagFields fields = fieldsOf(record);
    const auto op = fields.number<std::uint8_t>("op");
    if (op == kOpChunk) {
      addChunk(record, fields);
      lookThroughChunk(chunks_.size() - 1);
    }
    else if (op == kOpConnection) {
      const auto data = input_.read(record.data, record.size, "a connection");
      addConnection(fields, {data.data(), data.size()});
    }
    else if (op == kOpMessage) {
      const std::uint64_t length = record.end() - place;
      chunks_.push_back({place, length, length, 0, ""});
      addMessage(fields, chunks_.size() - 1, 0);
    }
  }

  void
  addMessage(const RosBagFields& fields, std::size_t chunk, std::uint64_t offset)
  {
    messages_.push_back({topicOfConnection(fields.number<std::uint32_t>("conn")),
                         nanosecondsOf(fields.number<std::uint64_t>("time")),
                         chunk,
                         offset});
  }

  void
  lookThroughChunk(std::size_t chunk)
  {
    const auto content = contentOf(chunk);
    const std::string what = titleOf(chunk);
    ByteReader reader(path_, what, {content->data(), content->size()});
    while (reader.left() > 0) {
      const std::uint64_t offset = reader.position();
      const RosBagFields fields(
          path_, what, reader.take(reader.number<std::uint32_t>()));
      const Bytes data = reader.take(reader.number<std::uint32_t>());
      const auto op = fields.number<std::uint8_t>("op");
      if (op == kOpConnection)
        addConnection(fields, data);
      else if (op == kOpMessage)
        addMessage(fields, chunk, offset);
    }
  }

  inline static const std::string kRecord = "a record";
  std::uint64_t first_ = 0; ///< offset of the first record behind the header
  std::map<std::uint32_t, std::size_t> topics_of_; ///< of connections
};
} // namespace

std::shared_ptr<const Bag>
openRosBag(const std::filesystem::path& path)
{
  return std::make_shared<RosBag>(path);
}

} // namespace pcl6d::sources
