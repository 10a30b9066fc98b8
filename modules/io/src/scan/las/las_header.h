// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/las/laz_records.h"
#include "text/file_input.h"

#include <Eigen/Core>

#include <optional>

/** \file The header of LAS files. Source: ASPRS LAS Specification 1.4 R15, 2019. */
namespace pcl6d::io {

/** \brief Offsets of values in the record of a point [byte]; 0: not in the format. */
struct LasLayout {
  std::size_t size = 0; ///< [byte] of the smallest record
  std::size_t time = 0;
  std::size_t colours = 0;
  std::size_t infrared = 0;
  bool has_waveform = false;
  bool is_new = false; ///< formats 6 to 10
};

/** \brief How the points of a LAZ file are compressed. */
struct LazRecord {
  LazItems items;
  bool is_chunked = true;
  std::uint32_t chunk_size = 0; ///< points; ~0: varies
};

/** \brief Parts of a header needed to read the points. */
struct LasHeader {
  int minor = 0; ///< version 1.minor
  int format = 0;
  LasLayout layout;             ///< of the format
  std::size_t record_size = 0;  ///< [byte] of a point
  std::size_t points_begin = 0; ///< [byte]
  std::uint64_t count = 0;      ///< of points
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::optional<LazRecord> laz;      ///< if compressed
  std::string coordinate_system;     ///< well-known text; empty: not given as text
  std::vector<std::string> left_out; ///< see ScanCloud
};

/** \return the layout of a point format, 0 to 10 */
LasLayout
lasLayoutOf(int format);

/** \brief Reads the header and the bytes up to the points.
 * \param[in] input at the start of the file \throws IoFailed with a description of the fault */
LasHeader
readLasHeader(FileInput& input);

} // namespace pcl6d::io
