// SPDX-License-Identifier: BSD-3-Clause
#include "e57/crc32c.h"
#include "e57/page_reader.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace pcl6d::sources {

std::uint64_t
littleEndian(const std::uint8_t* bytes, std::size_t n)
{
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < n; ++i)
    value |= std::uint64_t{bytes[i]} << (8 * i);
  return value;
}

PageReader::PageReader(const std::filesystem::path& path)
: path_(path), stream_(text::open(path)), pages_(kBufferedPages * kPageSize)
{
  readHeader();
}

void
PageReader::readHeader()
{
  std::array<std::uint8_t, kE57HeaderSize> bytes{};
  stream_.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
  if (stream_.gcount() < static_cast<std::streamsize>(bytes.size()) ||
      std::memcmp(bytes.data(), kE57Signature, 8) != 0)
    text::fail(path_, "is no E57 file: does not begin with ASTM-E57 and a header");
  const std::uint64_t major = littleEndian(&bytes[8], 4);
  if (major != 1)
    text::fail(path_, "E57 version " + std::to_string(major) + ", but only 1 is known");
  header_.length = littleEndian(&bytes[16], 8);
  header_.xml_offset = littleEndian(&bytes[24], 8);
  header_.xml_length = littleEndian(&bytes[32], 8);
  const std::uint64_t page = littleEndian(&bytes[40], 8);
  if (page != kPageSize)
    text::fail(path_, "pages of " + std::to_string(page) + " bytes, but must be 1024");
  if (header_.length == 0 || header_.length % kPageSize != 0)
    text::fail(path_,
               "header: file length " + std::to_string(header_.length) +
                   ", but must be a multiple of 1024");
  stream_.seekg(0, std::ios::end);
  const auto size = stream_ ? static_cast<std::int64_t>(stream_.tellg()) : -1;
  if (size < 0)
    text::fail(path_,
               "is a pipe, but E57 is read in any order: save the data to a file");
  if (static_cast<std::uint64_t>(size) < header_.length)
    text::fail(path_,
               "is cut off: " + std::to_string(size) + " bytes, but the header says " +
                   std::to_string(header_.length));
}

std::uint64_t
PageReader::logicalOf(std::uint64_t physical, const std::string& what) const
{
  const std::uint64_t within = physical % kPageSize;
  if (physical >= header_.length)
    text::fail(path_,
               what + " begins at byte " + std::to_string(physical) +
                   ", but the file ends at " + std::to_string(header_.length));
  if (within >= kPageContent)
    text::fail(path_,
               what + " begins at byte " + std::to_string(physical) +
                   ", inside the checksum of a page");
  return physical / kPageSize * kPageContent + within;
}

void
PageReader::load(std::uint64_t page)
{
  const std::uint64_t count =
      std::min<std::uint64_t>(kBufferedPages, header_.length / kPageSize - page);
  const auto bytes = static_cast<std::streamsize>(count * kPageSize);
  loaded_ = 0;
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(page * kPageSize));
  stream_.read(reinterpret_cast<char*>(pages_.data()), bytes);
  if (stream_.gcount() != bytes)
    text::fail(path_, text::systemReason("cannot be read"));
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint8_t* const content = &pages_[i * kPageSize];
    const std::uint8_t* const sum = content + kPageContent;
    const std::uint32_t stored = std::uint32_t{sum[0]} << 24 |
                                 std::uint32_t{sum[1]} << 16 |
                                 std::uint32_t{sum[2]} << 8 | sum[3];
    if (crc32c(content, kPageContent) != stored) {
      if (i > 0) { // reported when the page is needed
        loaded_ = i;
        break;
      }
      text::fail(path_,
                 "page " + std::to_string(page) + " (bytes from " +
                     std::to_string(page * kPageSize) +
                     "): wrong checksum, the content is damaged");
    }
    loaded_ = i + 1;
  }
  first_ = page;
}

void
PageReader::read(std::uint64_t place, std::uint8_t* target, std::size_t count)
{
  if (place > size() || count > size() - place)
    text::fail(path_, "content goes on behind the end of the file");
  while (count > 0) {
    const std::uint64_t page = place / kPageContent;
    const std::size_t within = place % kPageContent;
    if (page < first_ || page >= first_ + loaded_)
      load(page);
    const std::size_t part = std::min(count, kPageContent - within);
    std::memcpy(target, &pages_[(page - first_) * kPageSize + within], part);
    target += part;
    place += part;
    count -= part;
  }
}

} // namespace pcl6d::sources
