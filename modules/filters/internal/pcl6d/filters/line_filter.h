// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/scan_line.h>
#include <pcl6d/io/scan_reader.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Filters along the lines of a scan (book 4.1.5). */
enum class LineFilter {
  kNone,
  kMedian,    ///< medianAlongLines(): mixed pixels
  kReduction, ///< reduceAlongLines(): noise, and density near the scanner
  kBoth       ///< the median, then the reduction
};

/** \return the filter named "none", "scanline-median", "scanline-reduction" or "scanline-both"
 * \throws BadArgument another name */
LineFilter
lineFilterFromName(const std::string& name);

/** \return the names of the filters */
std::vector<std::string>
lineFilterNames();

/** \return the filter's name */
std::string
toString(LineFilter filter);

/** \brief Moves the mixed pixels of a scan along their rays, in its points and its cloud. Points at
 * noReturnRange() count like values without an echo, and stay.
 * \throws BadArgument the scan has no rows (Scan::row_length), or the points do not match the rows
 * \ingroup filters */
void
filterByMedian(Scan& scan, const ScanLineMedianOptions& options = {});

/** \brief Merges successive points on a line of a scan. The cloud stays; points at noReturnRange()
 * are left out. \throws BadArgument see filterByMedian() \ingroup filters */
void
reduceLines(Scan& scan, const ScanLineReductionOptions& options = {});

} // namespace pcl6d
