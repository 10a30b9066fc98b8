// SPDX-License-Identifier: BSD-3-Clause
#include "text/file_input.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace pcl6d::io {

namespace {
constexpr std::size_t kReadAtOnce = 1 << 18; // [byte] read at once
constexpr std::size_t kLargeBlock = 1 << 24; // [byte] where the size is not known
} // namespace

FileInput::FileInput(const std::filesystem::path& path)
: path_(path), stream_(text::open(path))
{}

FileInput::FileInput(std::ifstream stream,
                     const std::filesystem::path& path,
                     std::size_t lines)
: path_(path), stream_(std::move(stream)), number_(lines)
{}

/** Reads a block behind the unread bytes. \return false at the end of the file */
bool
FileInput::fill()
{
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_),
            buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() < end_ + kReadAtOnce)
    buffer_.resize(std::max(end_ + kReadAtOnce, 2 * end_)); // a long line grows fast
  errno = 0;
  stream_.read(buffer_.data() + end_,
               static_cast<std::streamsize>(buffer_.size() - end_));
  if (stream_.bad())
    text::fail(path_, text::systemReason("cannot be read"));
  end_ += static_cast<std::size_t>(stream_.gcount());
  return stream_.gcount() > 0;
}

bool
FileInput::next()
{
  std::size_t searched = 0;
  const void* found = nullptr;
  while (!found) {
    const std::size_t rest = end_ - begin_;
    if (rest > searched)
      found = std::memchr(buffer_.data() + begin_ + searched, '\n', rest - searched);
    searched = rest;
    if (!found && !fill()) {
      if (rest == 0)
        return false;
      break; // the last line may lack a line end
    }
  }
  const char* const start = buffer_.data() + begin_;
  const std::size_t size =
      found ? static_cast<std::size_t>(static_cast<const char*>(found) - start)
            : end_ - begin_;
  begin_ += size + (found ? 1 : 0);
  offset_ += size + (found ? 1 : 0);
  line_ = {start, size};
  if (!line_.empty() && line_.back() == '\r')
    line_.remove_suffix(1);
  ++number_;
  return true;
}

std::size_t
FileInput::read(std::uint8_t* target, std::size_t size)
{
  const std::size_t buffered = std::min(size, end_ - begin_);
  if (buffered > 0)
    std::memcpy(target, buffer_.data() + begin_, buffered);
  begin_ += buffered;
  if (buffered == size)
    return size;
  if (size - buffered < kReadAtOnce)
    return fill() ? buffered + read(target + buffered, size - buffered) : buffered;
  errno = 0;
  stream_.read(reinterpret_cast<char*>(target + buffered),
               static_cast<std::streamsize>(size - buffered));
  if (stream_.bad())
    text::fail(path_, text::systemReason("cannot be read"));
  return buffered + static_cast<std::size_t>(stream_.gcount());
}

bool
FileInput::append(std::size_t size, std::vector<std::uint8_t>& data)
{
  const std::size_t known = sizeAhead().value_or(kLargeBlock);
  while (size > 0) {
    const std::size_t before = data.size();
    const std::size_t block = std::min(size, std::max(known, kLargeBlock));
    data.resize(before + block);
    const std::size_t count = read(&data[before], block);
    data.resize(before + count);
    if (count < block)
      return false;
    size -= count;
  }
  return true;
}

void
FileInput::appendRest(std::vector<std::uint8_t>& data)
{
  const auto known = sizeAhead();
  if (known)
    append(*known, data);
  while (!known && append(kLargeBlock, data)) {}
}

std::optional<std::size_t>
FileInput::sizeAhead()
{
  stream_.clear(); // of end-of-file, which a small file reaches in the first block
  const auto place = stream_.tellg();
  if (place == std::ifstream::pos_type(-1)) // a pipe
    return std::nullopt;
  stream_.seekg(0, std::ios::end);
  const auto end = stream_.tellg();
  stream_.clear();
  stream_.seekg(place);
  if (end < place) // a device
    return std::nullopt;
  return end_ - begin_ + static_cast<std::size_t>(end - place);
}

} // namespace pcl6d::io
