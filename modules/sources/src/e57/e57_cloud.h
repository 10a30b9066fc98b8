// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "e57/e57_layout.h"

#include <pcl6d/io/scan_reader.h>

namespace pcl6d::sources {

/** \brief How coordinates are kept in memory. */
enum class Coordinates { kFloat, kDouble };

/** \brief Reads all points of a scan: x, y, z; intensity; rgb; normal_x, normal_y, normal_z;
 * time; row, column; return_index, return_count. Points without a return, marked by the invalid
 * state or coordinates of (0, 0, 0), get NaN coordinates.
 * \return an organized cloud, if each cell of the file's grid has at most one point
 * \throws IoFailed under the conditions of readRecords(), or without coordinates */
ScanCloud
readE57Cloud(PageReader& file,
             const E57Scan& scan,
             const std::string& title,
             Coordinates coordinates);

/** \brief Organizes the points of a scan in rows, by the fields `row` and `column`. Empty cells
 * get a NaN point. No effect if two points have the same cell, or if more than three cells of
 * four would be empty. \param[in] lines_are_columns the scan lines are columns and become the
 * rows */
void
arrangeInRows(bool lines_are_columns, pcl::PCLPointCloud2& cloud);

} // namespace pcl6d::sources
