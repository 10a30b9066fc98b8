// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

namespace pcl6d::sources {

/** \brief Appends numbers and texts in sequence, in little-endian order. */
class ByteWriter {
public:
  template <typename T>
  ByteWriter&
  number(T value)
  {
    char bytes[sizeof(T)]; // x86-64 is little-endian
    std::memcpy(bytes, &value, sizeof(T));
    bytes_.append(bytes, sizeof(T));
    return *this;
  }

  ByteWriter&
  raw(const std::string& bytes)
  {
    bytes_ += bytes;
    return *this;
  }

  /** \brief Appends bytes with a 32-bit length prefix. */
  ByteWriter&
  counted(const std::string& bytes)
  {
    return number(static_cast<std::uint32_t>(bytes.size())).raw(bytes);
  }

  const std::string&
  bytes() const
  {
    return bytes_;
  }

private:
  std::string bytes_;
};

/** \brief Writes the values of a message in little-endian CDR: each number is aligned to a
 * multiple of its size, counted from the end of the four-byte header. */
class CdrWriter {
public:
  CdrWriter() : bytes_("\0\1\0\0", kHeader) {}

  template <typename T>
  CdrWriter&
  number(T value)
  {
    bytes_.append((sizeof(T) - (bytes_.size() - kHeader) % sizeof(T)) % sizeof(T),
                  '\0');
    bytes_ += ByteWriter().number(value).bytes();
    return *this;
  }

  /** \brief Appends a text with a terminating zero. */
  CdrWriter&
  text(const std::string& value)
  {
    number(static_cast<std::uint32_t>(value.size() + 1));
    bytes_.append(value.c_str(), value.size() + 1);
    return *this;
  }

  /** \brief A std_msgs/Header. \param[in] stamp [ns], >= 0 */
  CdrWriter&
  header(std::int64_t stamp, const std::string& frame)
  {
    constexpr std::int64_t kSecond = 1000000000;
    number(static_cast<std::int32_t>(stamp / kSecond));
    number(static_cast<std::uint32_t>(stamp % kSecond));
    return text(frame);
  }

  const std::string&
  bytes() const
  {
    return bytes_;
  }

private:
  static constexpr std::size_t kHeader = 4;
  std::string bytes_;
};

} // namespace pcl6d::sources
