// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

/** \file The pages of an E57 file: 1020 bytes of content and a checksum, four bytes in
 * big-endian order (ASTM E2807, 6.3.1). Physical positions count checksums, logical positions
 * do not. */
namespace pcl6d::sources {

constexpr std::size_t kPageSize = 1024;             ///< [byte]
constexpr std::size_t kPageContent = kPageSize - 4; ///< [byte]
constexpr std::size_t kE57HeaderSize = 48;          ///< [byte]
constexpr const char* kE57Signature = "ASTM-E57";   ///< first bytes of the file
constexpr std::size_t kBufferedPages = 64;          ///< pages in memory

/** \brief The header of the file (ASTM E2807, table 1). */
struct E57Header {
  std::uint64_t length = 0;     ///< [byte] of the file, checksums included
  std::uint64_t xml_offset = 0; ///< physical
  std::uint64_t xml_length = 0; ///< logical
};

/** \brief Reads the content of an E57 file and verifies the checksum of each page read. */
class PageReader {
public:
  /** \throws IoFailed the file cannot be read, is not an E57 file, or shorter than the header
   * says */
  explicit PageReader(const std::filesystem::path& path);

  const std::filesystem::path&
  path() const
  {
    return path_;
  }

  const E57Header&
  header() const
  {
    return header_;
  }

  /** \return the number of bytes of content */
  std::uint64_t
  size() const
  {
    return header_.length / kPageSize * kPageContent;
  }

  /** \return the position without the preceding checksums
   * \param[in] what name of the content at the position, for the message
   * \throws IoFailed the position lies in a checksum or behind the end */
  std::uint64_t
  logicalOf(std::uint64_t physical, const std::string& what) const;

  /** \brief Copies content. \param[in] place logical
   * \throws IoFailed the content exceeds the last page, or a checksum is wrong */
  void
  read(std::uint64_t place, std::uint8_t* target, std::size_t count);

private:
  void
  readHeader();
  void
  load(std::uint64_t page);

  std::filesystem::path path_;
  std::ifstream stream_;
  E57Header header_;
  std::vector<std::uint8_t> pages_; ///< bytes of the file, with checksums
  std::uint64_t first_ = 0;         ///< page in front
  std::uint64_t loaded_ = 0;        ///< pages in memory
};

/** \return a number of n bytes in little-endian order, the order of all numbers of E57 but
 * checksums */
std::uint64_t
littleEndian(const std::uint8_t* bytes, std::size_t n);

} // namespace pcl6d::sources
