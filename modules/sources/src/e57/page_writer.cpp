// SPDX-License-Identifier: BSD-3-Clause
#include "e57/crc32c.h"
#include "e57/page_writer.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace pcl6d::sources {

void
storeLittleEndian(std::uint64_t value, std::size_t n, std::uint8_t* bytes)
{
  for (std::size_t i = 0; i < n; ++i)
    bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

void
storeChecksum(std::uint8_t* page)
{
  const std::uint32_t crc = crc32c(page, kPageContent);
  for (std::size_t i = 0; i < 4; ++i)
    page[kPageContent + i] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
}

void
storeHeader(const E57Header& header, std::uint8_t* page)
{
  std::memcpy(page, kE57Signature, 8);
  storeLittleEndian(1, 4, page + 8); // version 1.0
  storeLittleEndian(0, 4, page + 12);
  storeLittleEndian(header.length, 8, page + 16);
  storeLittleEndian(header.xml_offset, 8, page + 24);
  storeLittleEndian(header.xml_length, 8, page + 32);
  storeLittleEndian(kPageSize, 8, page + 40);
}

PageWriter::PageWriter(const std::filesystem::path& path)
: path_(path)
, stream_(path, std::ios::binary | std::ios::trunc)
, page_(kPageSize)
, used_(kE57HeaderSize)
{
  if (!stream_)
    text::fail(path_, text::systemReason("cannot be written"));
}

void
PageWriter::put(const std::vector<std::uint8_t>& page)
{
  errno = 0;
  stream_.write(reinterpret_cast<const char*>(page.data()),
                static_cast<std::streamsize>(page.size()));
  if (!stream_)
    text::fail(path_, text::systemReason("cannot be written"));
}

void
PageWriter::flush()
{
  if (pages_ == 0)
    first_ = page_;
  else
    storeChecksum(page_.data());
  put(page_);
  std::fill(page_.begin(), page_.end(), std::uint8_t{0});
  ++pages_;
  used_ = 0;
}

void
PageWriter::write(const void* data, std::size_t count)
{
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  while (count > 0) {
    const std::size_t part = std::min(count, kPageContent - used_);
    std::memcpy(&page_[used_], bytes, part);
    used_ += part;
    bytes += part;
    count -= part;
    if (used_ == kPageContent)
      flush();
  }
}

void
PageWriter::align()
{
  constexpr std::uint8_t kZeros[4] = {};
  write(kZeros, (4 - logical() % 4) % 4);
}

void
PageWriter::finish(std::uint64_t xml_offset, std::uint64_t xml_length)
{
  if (used_ > 0)
    flush();
  storeHeader({pages_ * kPageSize, xml_offset, xml_length}, first_.data());
  storeChecksum(first_.data());
  stream_.seekp(0);
  put(first_);
  stream_.flush();
  if (!stream_)
    text::fail(path_, text::systemReason("cannot be written"));
}

} // namespace pcl6d::sources
