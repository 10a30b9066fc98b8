// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/text.h>

#include <cstdint>
#include <optional>

/** \file Reading files of any size with the memory of a block. */
namespace pcl6d::io {

/** \brief A file read block by block from its start to its end, as lines and as bytes.
 */
class FileInput {
public:
  /** \brief Opens a file. \throws IoFailed with the system's reason */
  explicit FileInput(const std::filesystem::path& path);

  /** \brief Takes over a stream from where it stands.
   * \param[in] lines that were read already */
  FileInput(std::ifstream stream, const std::filesystem::path& path, std::size_t lines);

  const std::filesystem::path&
  path() const
  {
    return path_;
  }

  /** \brief Reads the next line. \return whether there was another one
   * \throws IoFailed the file cannot be read */
  bool
  next();

  /** \return the last line read, without its end; valid until something is read */
  std::string_view
  line() const
  {
    return line_;
  }

  /** \return its number, for messages */
  std::size_t
  number() const
  {
    return number_;
  }

  /** \brief Reads bytes. \return how many there were, less than size only at the end
   * \throws IoFailed the file cannot be read */
  std::size_t
  read(std::uint8_t* target, std::size_t size);

  /** \brief Appends bytes to data. Of a file that knows its size no more memory is asked
   * for than it has bytes. \return whether there were as many as wanted */
  bool
  append(std::size_t size, std::vector<std::uint8_t>& data);

  /** \brief Appends all bytes that follow. */
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
  std::size_t begin_ = 0; ///< of what was not taken yet
  std::size_t end_ = 0;
  std::string_view line_;
  std::size_t number_ = 0;
};

} // namespace pcl6d::io
