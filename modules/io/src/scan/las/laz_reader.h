// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/las/las_header.h"

namespace pcl6d::io {

/** \brief Decompresses the points of a LAZ file in order. */
class LazReader {
public:
  /** \param[in] data all bytes after the header; must stay valid
   * \throws IoFailed the table of chunks is broken */
  LazReader(const std::filesystem::path& path,
            const LasHeader& header,
            const std::vector<std::uint8_t>& data);

  /** \brief Reads the next point.
   * \param[in,out] record of LazItems::size() bytes, unchanged since the last call
   * \throws IoFailed the data end early, or are invalid */
  void
  next(std::uint8_t* record);

private:
  [[noreturn]] void
  fail(const std::string& message) const;
  void
  readTable();
  void
  readSizes(std::size_t place);
  std::size_t
  placeOfTable() const;
  void
  beginChunk(std::uint8_t* record);
  void
  beginLayers();

  std::filesystem::path path_;
  LazRecord laz_;
  std::uint64_t count_; ///< points of the file
  std::size_t first_;   ///< [byte] of the file: where data begin
  const std::uint8_t* data_;
  const std::uint8_t* end_;   ///< of the compressed points
  const std::uint8_t* place_; ///< of the next chunk
  /** by the table: points and bytes of each chunk; empty without a table */
  std::vector<std::pair<std::uint64_t, std::size_t>> table_;
  std::size_t num_chunks_ = 0;   ///< begun
  std::uint64_t num_points_ = 0; ///< read
  std::uint64_t left_ = 0;       ///< points left in the chunk
  const std::uint8_t* chunk_end_ = nullptr;
  std::optional<LazPointwise> pointwise_;
  LazDecoder decoder_;
  std::optional<LazLayered> layered_;
  std::vector<LazLayerCoder<LazDecoder>> layers_;
};

} // namespace pcl6d::io
