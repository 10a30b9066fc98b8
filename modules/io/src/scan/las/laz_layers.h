// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/las/las_bytes.h"

#include <cstddef>

/** \file The parts of a layered LAZ point. Source: LAZ Specification 1.4 R1. */
namespace pcl6d::io {

/** \brief The first 30 bytes of a point of formats 6 to 10. */
struct LazPoint14 {
  std::int32_t x = 0, y = 0, z = 0;
  std::uint16_t intensity = 0;
  std::uint8_t returns = 0; ///< return number, number of returns: 4 bits each
  /** of the classification (4 bits), channel of the scanner (2), direction of the scan, edge
   * of the flight line */
  std::uint8_t flags = 0;
  std::uint8_t classification = 0;
  std::uint8_t user_data = 0;
  std::int16_t angle = 0;
  std::uint16_t source = 0;
  std::int64_t time = 0; ///< the bits of a double

  static LazPoint14
  of(const std::uint8_t* record)
  {
    return {lasNumber<std::int32_t>(record),
            lasNumber<std::int32_t>(record + 4),
            lasNumber<std::int32_t>(record + 8),
            lasNumber<std::uint16_t>(record + 12),
            record[14],
            record[15],
            record[16],
            record[17],
            lasNumber<std::int16_t>(record + 18),
            lasNumber<std::uint16_t>(record + 20),
            lasNumber<std::int64_t>(record + 22)};
  }

  void
  store(std::uint8_t* record) const
  {
    storeLasNumber(record, x);
    storeLasNumber(record + 4, y);
    storeLasNumber(record + 8, z);
    storeLasNumber(record + 12, intensity);
    record[14] = returns;
    record[15] = flags;
    record[16] = classification;
    record[17] = user_data;
    storeLasNumber(record + 18, angle);
    storeLasNumber(record + 20, source);
    storeLasNumber(record + 22, time);
  }

  unsigned
  number() const
  {
    return returns & 15;
  }
  unsigned
  count() const
  {
    return returns >> 4;
  }
  unsigned
  channel() const
  {
    return flags >> 4 & 3;
  }
  /** \return the six bits of the flags without the channel */
  std::uint8_t
  otherFlags() const
  {
    return static_cast<std::uint8_t>((flags & 15) | (flags >> 2 & 48));
  }
};

/** \brief The layers of a chunk of formats 6 to 10, in file order: each has separate bytes and a
 * separate coder, and is left out if its values never change. */
enum LazLayer : std::size_t {
  kLazXy, ///< x, y, returns, channel of the scanner, and flags of changes
  kLazZ,
  kLazClassification,
  kLazFlags,
  kLazIntensity,
  kLazAngle,
  kLazUserData,
  kLazSource,
  kLazTime,
  kLazLayers14 ///< number of layers of a point; colours and extra bytes follow
};

/** \brief A coder of a layer. */
template <typename Coder>
struct LazLayerCoder {
  Coder coder;
  bool is_there = Coder::kEncodes; ///< to be coded
  bool has_changed = false;        ///< of an encoder: the layer cannot be left out
};

/** \brief Changes between consecutive points of a channel: bits of a symbol. */
namespace laz_change {
constexpr std::uint32_t kNumber = 3; ///< return number: 0 equal, 1 next, 2 before
constexpr std::uint32_t kCount = 4;
constexpr std::uint32_t kAngle = 8;
constexpr std::uint32_t kTime = 16;
constexpr std::uint32_t kSource = 32;
constexpr std::uint32_t kChannel = 64;
} // namespace laz_change

} // namespace pcl6d::io
