// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "e57/page_reader.h"

#include <fstream>

namespace pcl6d::sources {

/** \brief Writes the pages of a new E57 file. The first page, with the header, is kept until
 * finish(). */
class PageWriter {
public:
  /** \throws IoFailed the file cannot be made */
  explicit PageWriter(const std::filesystem::path& path);

  /** \return where the next byte goes */
  std::uint64_t
  logical() const
  {
    return pages_ * kPageContent + used_;
  }
  std::uint64_t
  physical() const
  {
    return pages_ * kPageSize + used_;
  }

  /** \throws IoFailed the disk is full, or the like */
  void
  write(const void* data, std::size_t count);

  /** \brief Adds zeros up to a multiple of four bytes, where sections begin. */
  void
  align();

  /** \brief Ends the last page and writes the header.
   * \param[in] xml_offset physical \param[in] xml_length logical */
  void
  finish(std::uint64_t xml_offset, std::uint64_t xml_length);

private:
  void
  flush();
  void
  put(const std::vector<std::uint8_t>& page);

  std::filesystem::path path_;
  std::ofstream stream_;
  std::vector<std::uint8_t> page_;
  std::vector<std::uint8_t> first_;
  std::uint64_t pages_ = 0; ///< that are complete
  std::size_t used_ = 0;    ///< bytes of the unfinished page
};

/** \brief Stores the checksum of a page behind the content. */
void
storeChecksum(std::uint8_t* page);

/** \brief Puts the numbers of a header into a page. */
void
storeHeader(const E57Header& header, std::uint8_t* page);

/** \brief Puts a number in n bytes, lowest first. */
void
storeLittleEndian(std::uint64_t value, std::size_t n, std::uint8_t* bytes);

} // namespace pcl6d::sources
