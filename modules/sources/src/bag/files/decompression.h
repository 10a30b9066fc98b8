// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/files/byte_reader.h"

#include <string>
#include <vector>

namespace pcl6d::sources {

/** \brief Decompresses a block.
 * \param[in] path, what for messages \param[in] compression "", "none", "lz4" (frames), "bz2"
 * or "zstd" \param[in] size [byte] of the content, claimed by the file
 * \throws IoFailed the compression is unknown, the content damaged or of another size, or the
 * size more than a chunk of a recording has */
std::vector<std::uint8_t>
decompressed(const std::filesystem::path& path,
             const std::string& what,
             const std::string& compression,
             std::vector<std::uint8_t> stored,
             std::uint64_t size);

/** \brief Decompresses zstd bytes, with or without a stored size.
 * \throws IoFailed under the conditions of decompressed() */
std::vector<std::uint8_t>
decompressedZstd(const std::filesystem::path& path,
                 const std::string& what,
                 Bytes bytes);

} // namespace pcl6d::sources
