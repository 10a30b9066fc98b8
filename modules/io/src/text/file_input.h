// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/text.h>

#include <cstdint>
#include <optional>

/** \file Reading files of any size with the memory of a block. */
namespace pcl6d::io {

/** \brief A file read in blocks from start to end, as lines and as bytes. */
class FileInput {
public:
  /** \brief Opens a file. \throws IoFailed with the system's reason */
  explicit FileInput(const std::filesystem::path& path);

  /** \brief Takes over a stream at the current position.
   * \param[in] lines number of lines already read */
  FileInput(std::ifstream stream, const std::filesystem::path& path, std::size_t lines);

  const std::filesystem::path&
  path() const
  {
    return path_;
  }

  /** \brief Reads the next line. \return false at the end of the file
   * \throws IoFailed the file cannot be read */
  bool
  next();

  /** \return the last line read, without the line end; valid until the next read */
  std::string_view
  line() const
  {
    return line_;
  }

  /** \return the number of the line, for messages */
  std::size_t
  number() const
  {
    return number_;
  }

  /** \return [byte] total size of the lines read so far, with line ends */
  std::uint64_t
  offset() const
  {
    return offset_;
  }

  /** \brief Reads bytes. \return the number of bytes read, less than size only at the end
   * \throws IoFailed the file cannot be read */
  std::size_t
  read(std::uint8_t* target, std::size_t size);

  /** \brief Appends bytes to data. For a file of known size, allocates no more memory than the
   * file has bytes. \return whether `size` bytes were available */
  bool
  append(std::size_t size, std::vector<std::uint8_t>& data);

  /** \brief Appends all remaining bytes. */
  void
  appendRest(std::vector<std::uint8_t>& data);

  /** \return how many bytes follow, unless the file is a pipe or a device */
  std::optional<std::size_t>
  sizeAhead();

private:
  bool
  fill();

  std::filesystem::path path_;
  std::ifstream stream_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0; ///< of the unread bytes
  std::size_t end_ = 0;
  std::string_view line_;
  std::size_t number_ = 0;
  std::uint64_t offset_ = 0;
};

} // namespace pcl6d::io
