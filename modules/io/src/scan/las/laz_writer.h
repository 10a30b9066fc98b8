// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/las/laz_records.h"

#include <string>

namespace pcl6d::io {

/** \brief Compresses points to the chunks of a LAZ file, with the chunk table. Layered chunks
 * store the number of points, pointwise chunks only the size in bytes. */
class LazWriter {
public:
  /** \param[in] chunk_size points of each chunk except the last; at least 1 */
  LazWriter(const LazItems& items, std::uint32_t chunk_size);

  /** \brief Adds a point, and appends the chunk to the content when full. */
  void
  add(const std::uint8_t* record, std::string& content);

  /** \brief Appends the rest of the points and the table of chunks.
   * \return [byte] from the first chunk to the table */
  std::size_t
  finish(std::string& content);

  /** \return the content of the record 'laszip encoded', which describes the compression */
  std::string
  description() const;

private:
  void
  endChunk(std::string& content);
  void
  endLayers(std::string& content);

  LazItems items_;
  std::uint32_t chunk_size_;
  std::vector<std::uint8_t> record_; ///< of a point, which the codecs may change
  std::string first_;                ///< point of the chunk
  std::uint32_t num_points_ = 0;     ///< of the chunk
  std::vector<std::uint32_t> sizes_; ///< [byte] of the chunks
  std::optional<LazPointwise> pointwise_;
  LazEncoder encoder_;
  std::optional<LazLayered> layered_;
  std::vector<LazLayerCoder<LazEncoder>> layers_;
};

} // namespace pcl6d::io
