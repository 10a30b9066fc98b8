// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/scan_reader.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan of a PTX file: header and position of the points in the file. */
struct PtxScan {
  std::uint64_t offset = 0;            ///< [byte] of the first row with a point
  std::size_t line = 0;                ///< line number of the row in the file
  std::uint32_t columns = 0, rows = 0; ///< of the grid; points follow column by column
  /** from the matrix of four rows; equal to the position and axes in the header */
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
};

/** \brief Lists the scans of a PTX file: text of one or several scans, each with the size of the
 * grid, the position and axes of the scanner, the transposed matrix (PTX multiplies row
 * vectors) and a row `x y z`, `x y z intensity` or `x y z intensity r g b` [m] for each cell.
 * \throws IoFailed naming file, line, value and rule: a header is broken, the matrix is not a
 * rigid motion, or rows are missing \ingroup io */
std::vector<PtxScan>
listPtxScans(const std::filesystem::path& path);

/** \brief Reads the points of a scan, in order of scan lines (columns of the grid). A row with
 * x, y and z of 0 is a missing return: the coordinates become NaN. The cloud is organized with
 * a row for each column of the grid. Fields: x, y, z (float, or double if far from the origin),
 * and, if present, intensity and rgb.
 * \throws IoFailed naming file, line, value and rule \ingroup io */
ScanCloud
readPtxScan(const std::filesystem::path& path, const PtxScan& scan);

} // namespace pcl6d
