// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/scan_line.h>
#include <pcl6d/io/scan_reader.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Which filters along its lines a scan goes through (book 4.1.5). */
enum class LineFilter {
  kNone,
  kMedian,    ///< medianAlongLines(): mixed pixels
  kReduction, ///< reduceAlongLines(): noise, and density near the scanner
  kBoth       ///< the median, then the reduction
};

/** \return the filter called "none", "scanline-median", "scanline-reduction" or
 * "scanline-both" \throws BadArgument another name */
LineFilter
lineFilterFromName(const std::string& name);

/** \return the names of all filters */
std::vector<std::string>
lineFilterNames();

/** \return the filter's name */
std::string
toString(LineFilter filter);

/** \brief Moves the mixed pixels of a scan along their rays, in its points and its cloud.
 * Points at noReturnRange() count as values without an echo, and stay.
 * \throws BadArgument the scan has no rows (Scan::row_length), or its points are not
 * those of its rows \ingroup filters */
void
filterByMedian(Scan& scan, const ScanLineMedianOptions& options = {});

/** \brief Merges the points of a scan that follow each other on a line. Its cloud stays;
 * points at noReturnRange() are left out. \throws BadArgument as filterByMedian() \ingroup filters */
void
reduceLines(Scan& scan, const ScanLineReductionOptions& options = {});

} // namespace pcl6d
