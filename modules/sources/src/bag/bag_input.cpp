// SPDX-License-Identifier: BSD-3-Clause
#include "bag/bag_input.h"

namespace pcl6d::sources {

BagInput::BagInput(const std::filesystem::path& path)
: path_(path), stream_(text::open(path))
{
  stream_.seekg(0, std::ios::end);
  const auto size = stream_ ? static_cast<std::int64_t>(stream_.tellg()) : -1;
  if (size < 0)
    text::fail(path_,
               "is a pipe, but a recording is read in any order: save the recording to "
               "a file");
  size_ = static_cast<std::uint64_t>(size);
}

std::vector<std::uint8_t>
BagInput::read(std::uint64_t place, std::uint64_t count, const std::string& what)
{
  if (!has(place, count))
    text::fail(
        path_,
        what + " at byte " + std::to_string(place) + " of " + std::to_string(count) +
            " bytes goes on behind the end of the file, " + std::to_string(size_));
  std::vector<std::uint8_t> bytes(count);
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(place));
  stream_.read(reinterpret_cast<char*>(bytes.data()),
               static_cast<std::streamsize>(count));
  if (static_cast<std::uint64_t>(stream_.gcount()) != count)
    text::fail(path_, text::systemReason("cannot be read"));
  return bytes;
}

} // namespace pcl6d::sources
