// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/range_lines.h>

#include <filesystem>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads raw 2D lines: a row per line, the drive's angle [deg] and the ranges.
 *
 * Cells are separated by commas, by semicolons, or by blanks and tabs. Empty rows and rows that
 * start with # are skipped. The first row may name the columns (angle, time, range...); only
 * with such a heading may the second column be the time [s] of the line's start. A range that
 * is empty, nan, inf or 0 means no return.
 * \param[in] lines file with angles and ranges; ranges alone if angles is given
 * \param[in] angles file with rows of angle [deg] and an optional second column, time [s]
 * \param[in] range_unit [m] per unit of the ranges, > 0
 * \throws IoFailed naming file, line, value and rule: unreadable, no line, rows of different
 * length, text where a number belongs, an angle that is not finite, a negative range, times
 * that do not increase, a number of angles that differs from the number of lines
 * \throws BadArgument range_unit is not above 0 \ingroup io */
RangeLines
readRangeLines(const std::filesystem::path& lines,
               const std::filesystem::path& angles = {},
               double range_unit = 1);

} // namespace pcl6d
