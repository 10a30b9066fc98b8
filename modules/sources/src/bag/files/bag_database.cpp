// SPDX-License-Identifier: BSD-3-Clause
// Tables as rosbag2_storage_sqlite3 writes them: topics (id, name, type, serialization_format,
// ...) and messages (id, topic_id, timestamp, data).
#include "bag/bag_parts.h"
#include "bag/files/chunked_bag.h"
#include "bag/files/decompression.h"

#include <pcl6d/common/error.h>

#include <cstdlib>
#include <map>
#include <mutex>
#include <sqlite3.h>
#include <unistd.h>
#include <zstd.h>

namespace pcl6d::sources {

namespace {
namespace fs = std::filesystem;

/** \brief A temporary uncompressed copy of a file, removed with the object. */
class PlainCopy {
public:
  explicit PlainCopy(const fs::path& packed)
  {
    std::string name = (fs::temp_directory_path() / "pcl6d_db3_XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0)
      text::fail(name, text::systemReason("cannot be written"));
    path_ = name;
    close(file);
    try {
      unpack(packed);
    } catch (...) {
      remove();
      throw;
    }
  }
  PlainCopy(const PlainCopy&) = delete;
  PlainCopy&
  operator=(const PlainCopy&) = delete;
  ~PlainCopy() { remove(); }

  const fs::path&
  path() const
  {
    return path_;
  }

private:
  void
  remove()
  {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }

  void
  unpack(const fs::path& packed)
  {
    std::ifstream in = text::open(packed);
    std::ofstream out(path_, std::ios::binary);
    const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(
        ZSTD_createDStream(), ZSTD_freeDStream);
    std::vector<char> from(ZSTD_DStreamInSize()), to(ZSTD_DStreamOutSize());
    std::size_t more = 1;
    while (in.read(from.data(), static_cast<std::streamsize>(from.size())),
           in.gcount() > 0) {
      ZSTD_inBuffer input = {from.data(), static_cast<std::size_t>(in.gcount()), 0};
      while (input.pos < input.size) {
        ZSTD_outBuffer output = {to.data(), to.size(), 0};
        more = ZSTD_decompressStream(stream.get(), &output, &input);
        if (ZSTD_isError(more) != 0)
          text::fail(packed, "the zstd content is damaged");
        if (!out.write(to.data(), static_cast<std::streamsize>(output.pos)))
          text::fail(path_, text::systemReason("cannot be written"));
      }
    }
    if (more != 0)
      text::fail(packed, "the zstd content is cut off");
    if (!out.flush())
      text::fail(path_, text::systemReason("cannot be written"));
  }

  fs::path path_;
};

/** \brief A database of ROS 2. */
class BagDatabase : public Bag {
public:
  BagDatabase(const fs::path& path, MessageCompression compression)
  : Bag(path), compression_(compression)
  {
    text::open(path); // reports why the file cannot be read
    if (path.extension() == ".zstd")
      copy_ = std::make_unique<PlainCopy>(path);
    const std::string file = (copy_ ? copy_->path() : path).string();
    sqlite3* opened = nullptr;
    const int result = sqlite3_open_v2(
        file.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_FULLMUTEX, nullptr);
    database_.reset(opened);
    if (result != SQLITE_OK)
      fail();
    readTopics();
    readTimes();
    reading_ = prepare("SELECT data FROM messages WHERE rowid = ?");
  }

  std::string
  format() const override
  {
    return "ROS 2 bag (db3)";
  }

  std::vector<std::uint8_t>
  read(const BagMessage& message) const override
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    sqlite3_reset(reading_.get());
    sqlite3_bind_int64(reading_.get(), 1, static_cast<sqlite3_int64>(message.offset));
    if (!step(reading_))
      text::fail(path_, "message " + std::to_string(message.offset) + " is missing");
    const auto* const data =
        static_cast<const std::uint8_t*>(sqlite3_column_blob(reading_.get(), 0));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(reading_.get(), 0));
    std::vector<std::uint8_t> bytes;
    if (compression_ == MessageCompression::kZstd)
      bytes = decompressedZstd(
          path_, "message " + std::to_string(message.offset), {data, size});
    else if (size > 0)
      bytes.assign(data, data + size);
    sqlite3_reset(reading_.get()); // a statement under way keeps the file locked
    return bytes;
  }

private:
  struct Close {
    void
    operator()(sqlite3* database) const
    {
      sqlite3_close(database);
    }
    void
    operator()(sqlite3_stmt* statement) const
    {
      sqlite3_finalize(statement);
    }
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Close>;

  [[noreturn]] void
  fail() const
  {
    text::fail(path_,
               std::string("is no bag of ROS 2, or damaged: ") +
                   sqlite3_errmsg(database_.get()) +
                   "; `sqlite3 FILE .recover` writes the rest of a database");
  }

  Statement
  prepare(const char* query) const
  {
    sqlite3_stmt* made = nullptr;
    if (sqlite3_prepare_v2(database_.get(), query, -1, &made, nullptr) != SQLITE_OK)
      fail();
    return Statement(made);
  }

  /** \return whether a further row exists */
  bool
  step(const Statement& statement) const
  {
    const int result = sqlite3_step(statement.get());
    if (result != SQLITE_ROW && result != SQLITE_DONE)
      fail();
    return result == SQLITE_ROW;
  }

  static std::string
  textOf(const Statement& statement, int column)
  {
    const auto* const text = sqlite3_column_text(statement.get(), column);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
  }

  void
  readTopics()
  {
    const Statement rows =
        prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id");
    while (step(rows)) {
      topics_of_[sqlite3_column_int64(rows.get(), 0)] = topics_.size();
      topics_.push_back(
          {plainName(textOf(rows, 1)),
           plainName(plainTypeName(textOf(rows, 2))),
           textOf(rows, 3) == "cdr" ? BagEncoding::kCdr : BagEncoding::kOther,
           0});
    }
  }

  void
  readTimes()
  {
    const Statement rows = prepare(
        "SELECT rowid, topic_id, timestamp FROM messages ORDER BY timestamp, rowid");
    while (step(rows)) {
      const auto topic = topics_of_.find(sqlite3_column_int64(rows.get(), 1));
      if (topic == topics_of_.end())
        text::fail(path_,
                   "a message is of topic " +
                       std::to_string(sqlite3_column_int64(rows.get(), 1)) +
                       ", not described in the database");
      ++topics_[topic->second].num_messages;
      messages_.push_back(
          {topic->second,
           sqlite3_column_int64(rows.get(), 2),
           0,
           static_cast<std::uint64_t>(sqlite3_column_int64(rows.get(), 0))});
    }
  }

  MessageCompression compression_;
  std::unique_ptr<PlainCopy> copy_;
  std::unique_ptr<sqlite3, Close> database_;
  std::map<std::int64_t, std::size_t> topics_of_; ///< by their ids
  mutable std::mutex mutex_;                      ///< of the statement
  Statement reading_;
};
} // namespace

std::shared_ptr<const Bag>
openBagDatabase(const fs::path& path, MessageCompression compression)
{
  return std::make_shared<BagDatabase>(path, compression);
}

} // namespace pcl6d::sources
