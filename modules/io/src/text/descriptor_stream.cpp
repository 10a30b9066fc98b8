// SPDX-License-Identifier: BSD-3-Clause
#include "text/descriptor_stream.h"

#include <cerrno>
#include <unistd.h>
#include <utility>

namespace pcl6d::io {

namespace {
constexpr std::size_t kWrittenAtOnce = 1 << 16; // [byte]
} // namespace

bool
Descriptor::close()
{
  const int number = std::exchange(number_, -1);
  return number < 0 || ::close(number) == 0 || errno == EINTR; // closed nonetheless
}

DescriptorBuffer::DescriptorBuffer(int file) : file_(file), buffer_(kWrittenAtOnce)
{
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

bool
DescriptorBuffer::write(const char* bytes, std::size_t count)
{
  while (count > 0 && error_ == 0) {
    const ssize_t written = ::write(file_, bytes, count);
    if (written > 0) {
      bytes += written;
      count -= static_cast<std::size_t>(written);
    }
    else if (written == 0 || errno != EINTR)
      error_ = written == 0 ? EIO : errno;
  }
  errno = error_; // for callers that check errno immediately
  return error_ == 0;
}

bool
DescriptorBuffer::flushBuffer()
{
  const auto count = static_cast<std::size_t>(pptr() - pbase());
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  return write(buffer_.data(), count);
}

DescriptorBuffer::int_type
DescriptorBuffer::overflow(int_type c)
{
  if (!flushBuffer())
    return traits_type::eof();
  if (!traits_type::eq_int_type(c, traits_type::eof()))
    sputc(traits_type::to_char_type(c));
  return traits_type::not_eof(c);
}

std::streamsize
DescriptorBuffer::xsputn(const char* bytes, std::streamsize count)
{
  if (count <= epptr() - pptr()) {
    traits_type::copy(pptr(), bytes, static_cast<std::size_t>(count));
    pbump(static_cast<int>(count)); // at most the size of the buffer
    return count;
  }
  return flushBuffer() && write(bytes, static_cast<std::size_t>(count)) ? count : 0;
}

DescriptorBuffer::pos_type
DescriptorBuffer::seekpos(pos_type place, std::ios_base::openmode /*which*/)
{
  if (!flushBuffer())
    return pos_type(off_type(-1));
  if (::lseek(file_, static_cast<off_t>(off_type(place)), SEEK_SET) < 0) {
    error_ = errno;
    return pos_type(off_type(-1));
  }
  return place;
}

int
DescriptorBuffer::sync()
{
  return flushBuffer() ? 0 : -1;
}

} // namespace pcl6d::io
