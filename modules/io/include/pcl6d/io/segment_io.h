// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/segment.h>

#include <filesystem>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How the numbers of a plan become metres. */
struct SegmentOptions {
  double scale = 1; ///< [m] per unit of the file; finite, > 0
};

/** \brief Reads a plan of walls, for example a cadastral map (book 6.4.1), as line segments; x
 * to the right (east), y up (north). The extension gives the format, in any case.
 *
 * .csv: rows x1,y1,x2,y2 after an optional heading; # starts a comment. .geojson: Line- and
 * MultiLineString, Polygon and MultiPolygon with holes, alone or in Feature, FeatureCollection,
 * GeometryCollection; points are ignored. Coordinates must be planar: a file without a planar
 * `crs` is rejected if all coordinates could be degrees (|x| <= 180, |y| <= 90) with the
 * decimals of degrees. .svg: path (M L H V Z, absolute and relative), line, polyline, polygon,
 * rect, in any groups; y, downwards in SVG, is flipped. Curves and transform attributes are
 * rejected: a partly wrong plan is worse than no plan. Segments without length are left out.
 * \throws IoFailed naming file, position, value and rule: also a file without any segment
 * \throws BadArgument scale is invalid \ingroup io */
Segments
readSegments(const std::filesystem::path& path, const SegmentOptions& options = {});

/** \brief Writes rows x1,y1,x2,y2 under a header, with 17 digits, atomically.
 * \throws IoFailed the file cannot be written */
void
writeSegments(const std::filesystem::path& path, const Segments& segments);

} // namespace pcl6d
