// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/** \file Constants of the format MCAP, for reader and writer ("MCAP file format specification",
 * mcap.dev/spec). */
namespace pcl6d::sources {

/** First and last bytes of a file. */
constexpr char kMcapMagic[8] = {'\x89', 'M', 'C', 'A', 'P', '0', '\r', '\n'};

/** \brief Kinds of records. */
enum McapOp : std::uint8_t {
  kMcapHeader = 1,
  kMcapFooter = 2,
  kMcapSchema = 3,
  kMcapChannel = 4,
  kMcapMessage = 5,
  kMcapChunk = 6,
  kMcapMessageIndex = 7,
  kMcapChunkIndex = 8,
  kMcapStatistics = 11,
  kMcapDataEnd = 15
};

} // namespace pcl6d::sources
