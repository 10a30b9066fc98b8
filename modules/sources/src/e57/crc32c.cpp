// SPDX-License-Identifier: BSD-3-Clause
#include "e57/crc32c.h"

#include <array>
#include <cstring>

namespace pcl6d::sources {

namespace {
using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

/** \return table k: the contribution of a byte to the checksum with k bytes following, for steps
 * of eight bytes */
CrcTables
crcTables()
{
  constexpr std::uint32_t kPolynomial = 0x82F63B78;
  CrcTables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc >> 1) ^ ((crc & 1) != 0 ? kPolynomial : 0);
    tables[0][byte] = crc;
  }
  for (std::size_t k = 1; k < tables.size(); ++k)
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[k - 1][byte];
      tables[k][byte] = (before >> 8) ^ tables[0][before & 0xFF];
    }
  return tables;
}
} // namespace

std::uint32_t
crc32c(const std::uint8_t* data, std::size_t size)
{
  static const CrcTables kTables = crcTables();
  std::uint32_t crc = ~std::uint32_t{0};
  for (; size >= 8; size -= 8, data += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, data, sizeof word);
    word ^= crc;
    crc = 0;
    for (std::size_t byte = 0; byte < 8; ++byte)
      crc ^= kTables[7 - byte][(word >> (8 * byte)) & 0xFF];
  }
  for (; size > 0; --size, ++data)
    crc = (crc >> 8) ^ kTables[0][(crc ^ *data) & 0xFF];
  return ~crc;
}

} // namespace pcl6d::sources
