// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

/** \file Changes of a file that keep so much of its structure that its reader gets beyond
 * the first line. */
namespace pcl6d::fuzz {

/** \brief What a format is made of. */
enum class Structure {
  kBytes,     ///< nothing is known
  kText,      ///< lines and tokens
  kPcd,       ///< a header that ends with the line DATA, then text or bytes
  kPly,       ///< a header that ends with the line end_header, then text or bytes
  kStl,       ///< 80 bytes, a count, 50 bytes per triangle
  kRecordFile ///< a line, then records with sizes and checksums (RecordFile)
};

/** \brief Changes bytes in place in any way. \return the new size, at most max_size */
using ByteMutator = std::function<
    std::size_t(std::uint8_t* data, std::size_t size, std::size_t max_size)>;

/** \brief Changes a file: now and then without any regard to its structure, else one thing
 * in it - a number by one that breaks programs, a line, a count with all that have to be
 * equal to it, the body alone - and mends what a reader checks first (sizes, checksums).
 * \param[in] seed chooses \param[in] bytes for what has no structure
 * \return the new content, at most max_size bytes */
std::string
mutate(const std::string& content,
       Structure structure,
       std::size_t max_size,
       unsigned int seed,
       const ByteMutator& bytes);

} // namespace pcl6d::fuzz
