// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <cstddef>
#include <vector>

/** \file
 * Filters along the lines of a scan (book 4.1.5): points come in the order of their
 * acquisition, line_length of them a line; the last line may be shorter. Points that
 * are not finite are skipped, but count in the length of the line. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of the scan-line median. */
struct ScanLineMedianOptions {
  int window = 7;         ///< values around a value, itself included; odd, >= 3
  double threshold = 2.0; ///< [m] largest difference left unfiltered; finite, > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Removes mixed pixels: a point whose distance from the scanner (the origin)
 * differs from the median distance of its window by more than the threshold is moved
 * along its ray to the median. Every other point keeps its bits.
 *
 * At the ends of a line, and where values are invalid, the window has fewer values; of
 * an even number, the median is the nearer of the middle two to the value. A point at
 * the origin has no ray: it counts as invalid, like NaN, and stays.
 * \param[in] line_length values a line, > 0 \return the same number of points, in order
 * \throws BadArgument an option or line_length is invalid
 * \note Source: book 4.1.5; 7 values and 2 m are from the literature on 6D SLAM. */
Points
medianAlongLines(const Points& points,
                 std::size_t line_length,
                 const ScanLineMedianOptions& options = {});

/** \brief Knobs of the scan-line reduction. */
struct ScanLineReductionOptions {
  double max_distance = 0.1; ///< [m] from the first point of a group, not reached; > 0
  int line_step = 1;         ///< take each n-th line, from the first on; >= 1
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Consecutive points of a line, from begin to before end. The first point is
 * finite; points in between may not be finite. */
struct LineGroup {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/** \brief Cuts lines into groups: a point joins the group if its distance to the first
 * point of the group is below max_distance, else it begins the next group.
 * \return the groups in the order of the points; every finite point of the lines
 * taken is in a group
 * \throws BadArgument an option or line_length is invalid */
std::vector<LineGroup>
groupAlongLines(const Points& points,
                std::size_t line_length,
                const ScanLineReductionOptions& options = {});

/** \brief The means of the groups of groupAlongLines(): noise averages out, and the
 * density near the scanner shrinks. \throws BadArgument see groupAlongLines() */
Points
reduceAlongLines(const Points& points,
                 std::size_t line_length,
                 const ScanLineReductionOptions& options = {});

/** \brief The line length of a PCL cloud: the width of an organized cloud (height > 1),
 * else the given length; 1 for an empty cloud without lines.
 * \param[in] given by setLineLength(), 0: not given
 * \throws BadArgument neither organized nor given, or width and given length differ, or
 * width x height is not the number of points */
std::size_t
lineLengthOf(std::size_t width, std::size_t height, std::size_t size, int given);

} // namespace pcl6d
