// SPDX-License-Identifier: BSD-3-Clause
#include "bag/bag_parts.h"
#include "bag/files/chunked_bag.h"

#include <algorithm>
#include <cctype>

namespace pcl6d {

using namespace sources;

namespace {
namespace fs = std::filesystem;

constexpr const char* kBagMetadata = "metadata.yaml";

bool
endsWith(const std::string& name, const std::string& end)
{
  return name.size() > end.size() &&
         std::equal(end.rbegin(), end.rend(), name.rbegin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

bool
isBagFolder(const fs::path& path)
{
  std::error_code missing;
  return fs::is_directory(path, missing) && text::isThere(path / kBagMetadata);
}

/** \brief Content of a metadata.yaml. */
struct BagMetadata {
  std::vector<std::string> files;
  MessageCompression compression = MessageCompression::kNone;
};

std::string
withoutQuotes(std::string_view word)
{
  while (!word.empty() &&
         (word.front() == ' ' || word.front() == '"' || word.front() == '\''))
    word.remove_prefix(1);
  while (!word.empty() &&
         (word.back() == ' ' || word.back() == '"' || word.back() == '\''))
    word.remove_suffix(1);
  return std::string(word);
}

/** Reads the relevant keys: the file has a fixed layout, a key or an entry of a list per line
 * (rosbag2_storage, metadata_io). */
BagMetadata
readBagMetadata(const fs::path& file)
{
  BagMetadata metadata;
  const std::string content = text::readFile(file);
  text::Lines lines(content);
  bool in_files = false;
  while (lines.next()) {
    const std::string line = withoutQuotes(lines.line());
    if (in_files && line.rfind("- ", 0) == 0) {
      metadata.files.push_back(withoutQuotes(std::string_view(line).substr(2)));
      continue;
    }
    in_files = line == "relative_file_paths:";
    if (line.rfind("compression_mode:", 0) == 0 &&
        withoutQuotes(std::string_view(line).substr(17)) == "MESSAGE")
      metadata.compression = MessageCompression::kZstd;
  }
  if (metadata.files.empty())
    text::fail(file,
               "names no file under relative_file_paths; give the .db3 or .mcap file "
               "itself, or `ros2 bag reindex` the folder");
  return metadata;
}

/** \return the file, or the compressed file if the plain file is missing */
fs::path
foundFile(const fs::path& folder, const std::string& name)
{
  fs::path file = folder / name;
  fs::path packed = file.string() + ".zstd";
  if (text::isThere(file))
    return file;
  if (text::isThere(packed))
    return packed;
  text::fail(folder / kBagMetadata,
             "names " + text::quoted(name) +
                 ", but the file is missing in the folder; copy the file into the "
                 "folder, or `ros2 bag reindex` the folder");
}

std::shared_ptr<const Bag>
openBagFile(const fs::path& path, MessageCompression compression)
{
  const std::string name = path.filename().string();
  if (endsWith(name, ".mcap"))
    return openMcap(path);
  if (endsWith(name, ".db3") || endsWith(name, ".db3.zstd"))
    return openBagDatabase(path, compression);
  if (endsWith(name, ".bag") || endsWith(name, ".bag.active"))
    return openRosBag(path);
  text::fail(path, "is no recording: .bag, .mcap, .db3 or .db3.zstd is needed");
}

/** \brief A recording in several files. */
class BagFolder : public Bag {
public:
  explicit BagFolder(const fs::path& folder) : Bag(folder)
  {
    const BagMetadata metadata = readBagMetadata(folder / kBagMetadata);
    for (const std::string& name : metadata.files)
      add(openBagFile(foundFile(folder, name), metadata.compression));
    std::stable_sort(
        messages_.begin(),
        messages_.end(),
        [](const BagMessage& a, const BagMessage& b) { return a.time < b.time; });
  }

  std::string
  format() const override
  {
    return parts_.front()->format();
  }

  std::vector<std::uint8_t>
  read(const BagMessage& message) const override
  {
    const Bag& part = *parts_.at(message.part);
    return part.read(part.messages().at(message.offset));
  }

private:
  void
  add(const std::shared_ptr<const Bag>& part)
  {
    std::vector<std::size_t> here; // index of each topic of the part
    for (const BagTopic& topic : part->topics()) {
      const auto known =
          std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& other) {
            return other.name == topic.name && other.type == topic.type &&
                   other.encoding == topic.encoding;
          });
      here.push_back(static_cast<std::size_t>(known - topics_.begin()));
      if (known == topics_.end())
        topics_.push_back(topic);
      else
        known->num_messages += topic.num_messages;
    }
    for (std::size_t i = 0; i < part->messages().size(); ++i) {
      const BagMessage& message = part->messages()[i];
      messages_.push_back({here[message.topic], message.time, parts_.size(), i});
    }
    if (damage_.empty() && !part->damage().empty())
      damage_ = part->path().filename().string() + ": " + part->damage();
    parts_.push_back(part);
  }

  std::vector<std::shared_ptr<const Bag>> parts_;
};
} // namespace

Bag::~Bag() = default;

bool
isBag(const fs::path& path)
{
  const std::string name = path.filename().string();
  std::error_code missing;
  if (fs::is_directory(path, missing))
    return isBagFolder(path);
  for (const char* const end : {".bag", ".bag.active", ".mcap", ".db3", ".db3.zstd"})
    if (endsWith(name, end))
      return true;
  return false;
}

std::shared_ptr<const Bag>
openBag(const fs::path& path)
{
  return isBagFolder(path) ? sources::openBagFolder(path)
                           : openBagFile(path, MessageCompression::kNone);
}

std::shared_ptr<const Bag>
sources::openBagFolder(const fs::path& folder)
{
  return std::make_shared<BagFolder>(folder);
}

} // namespace pcl6d
