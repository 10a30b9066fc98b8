// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/files/byte_reader.h"

#include <fstream>
#include <vector>

namespace pcl6d::sources {

/** \brief A file with random access. */
class BagInput {
public:
  /** \throws IoFailed under the conditions of text::open(), or for a pipe */
  explicit BagInput(const std::filesystem::path& path);

  const std::filesystem::path&
  path() const
  {
    return path_;
  }

  std::uint64_t
  size() const
  {
    return size_;
  }

  /** \return whether the bytes are inside the file */
  bool
  has(std::uint64_t place, std::uint64_t count) const
  {
    return place <= size_ && count <= size_ - place;
  }

  /** \brief Reads bytes. \param[in] what name of the bytes, for the message
   * \throws IoFailed the file ends early, or cannot be read */
  std::vector<std::uint8_t>
  read(std::uint64_t place, std::uint64_t count, const std::string& what);

private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

} // namespace pcl6d::sources
