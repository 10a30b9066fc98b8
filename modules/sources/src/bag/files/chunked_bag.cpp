// SPDX-License-Identifier: BSD-3-Clause
#include "bag/files/chunked_bag.h"
#include "bag/files/decompression.h"

#include <algorithm>
#include <zlib.h>

namespace pcl6d::sources {

ChunkedBag::ChunkedBag(const std::filesystem::path& path) : Bag(path), input_(path)
{}

std::string
ChunkedBag::titleOf(std::size_t chunk) const
{
  return "chunk " + std::to_string(chunk) + " (byte " +
         std::to_string(chunks_[chunk].place) + ")";
}

std::shared_ptr<const std::vector<std::uint8_t>>
ChunkedBag::contentOf(std::size_t chunk) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (loaded_ == chunk)
    return content_;
  loaded_.reset();
  content_.reset(); // frees memory before the next chunk
  const BagChunk& found = chunks_[chunk];
  const std::string what = titleOf(chunk);
  std::vector<std::uint8_t> bytes =
      decompressed(path_,
                   what,
                   found.compression,
                   input_.read(found.place, found.length, what),
                   found.size);
  if (found.crc != 0 && crc32_z(0, bytes.data(), bytes.size()) != found.crc)
    text::fail(path_,
               what + ": wrong checksum, the messages are damaged; copy the file anew, "
                      "or repair the file (mcap recover)");
  content_ = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
  loaded_ = chunk;
  return content_;
}

std::vector<std::uint8_t>
ChunkedBag::read(const BagMessage& message) const
{
  const auto content = contentOf(message.part);
  const std::string what = titleOf(message.part);
  const Bytes bytes =
      payloadAt({content->data(), content->size()}, message.offset, what);
  return {bytes.data, bytes.data + bytes.size};
}

std::size_t
ChunkedBag::topicOf(const std::string& recorded_name,
                    const std::string& recorded_type,
                    BagEncoding encoding)
{
  const std::string name = plainName(recorded_name), type = plainName(recorded_type);
  const auto known =
      std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& topic) {
        return topic.name == name && topic.type == type && topic.encoding == encoding;
      });
  if (known != topics_.end())
    return static_cast<std::size_t>(known - topics_.begin());
  topics_.push_back({name, type, encoding, 0});
  return topics_.size() - 1;
}

void
ChunkedBag::finishIndex()
{
  std::stable_sort(
      messages_.begin(), messages_.end(), [](const BagMessage& a, const BagMessage& b) {
        return a.time < b.time;
      });
  for (BagTopic& topic : topics_)
    topic.num_messages = 0;
  for (const BagMessage& message : messages_)
    ++topics_[message.topic].num_messages;
}

void
ChunkedBag::noteCut(std::uint64_t place,
                    const std::string& reason,
                    const std::string& next_step)
{
  damage_ = "the recording is cut off or still being written, read up to byte " +
            std::to_string(place) + " of " + std::to_string(input_.size()) +
            (reason.empty() ? "" : " (" + reason + ")") + "; " + next_step;
}

std::string
plainTypeName(std::string type)
{
  const std::string part = "/msg/";
  const std::size_t found = type.find(part);
  if (found != std::string::npos)
    type.replace(found, part.size(), "/");
  return type;
}

} // namespace pcl6d::sources
