// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/text.h>

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace pcl6d::sources {

/** \brief A non-owning view of memory. */
struct Bytes {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/** \return the name of a topic, type, frame or field with '?' for control characters, possible
 * in a damaged file \param[in] also further characters to replace */
inline std::string
plainName(std::string name, std::string_view also = {})
{
  for (char& c : name)
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0 ||
        also.find(c) != std::string_view::npos)
      c = '?';
  return name;
}

/** \brief Reads numbers and texts, lowest byte first, from a record in memory. */
class ByteReader {
public:
  /** \param[in] path, what for messages: the file and the name of the record; kept by reference */
  ByteReader(const std::filesystem::path& path, const std::string& what, Bytes bytes)
  : path_(path), what_(what), bytes_(bytes)
  {}

  std::size_t
  left() const
  {
    return bytes_.size - position_;
  }

  std::size_t
  position() const
  {
    return position_;
  }

  /** \brief Takes bytes. \throws IoFailed fewer bytes are left */
  Bytes
  take(std::uint64_t count)
  {
    if (count > left())
      text::fail(path_,
                 what_ + " is damaged: " + std::to_string(count) +
                     " bytes wanted, but it has " + std::to_string(left()) + " more");
    const Bytes taken = {bytes_.data + position_, static_cast<std::size_t>(count)};
    position_ += taken.size;
    return taken;
  }

  /** \return an unsigned number of the width of T */
  template <typename T>
  T
  number()
  {
    const Bytes bytes = take(sizeof(T));
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      value = static_cast<T>(value | static_cast<T>(T{bytes.data[i]} << (8 * i)));
    return value;
  }

  /** \return a string with a 32-bit length prefix */
  std::string
  string()
  {
    const Bytes bytes = take(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data), bytes.size};
  }

private:
  const std::filesystem::path& path_;
  const std::string& what_;
  Bytes bytes_;
  std::size_t position_ = 0;
};

} // namespace pcl6d::sources
