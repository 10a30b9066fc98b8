// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl6d::sources {

/** \return the checksum CRC-32C (Castagnoli, reflected polynomial 0x82F63B78; RFC 3720, appendix
 * B.4) of bytes, stored in every page of E57 */
std::uint32_t
crc32c(const std::uint8_t* data, std::size_t size);

} // namespace pcl6d::sources
