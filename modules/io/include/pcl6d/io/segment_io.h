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

/** \brief Reads a plan of walls, such as a cadastral map (book 6.4.1), as line segments;
 * x to the right (east), y up (north). The extension tells the format, whatever its case.
 *
 * .csv: rows x1,y1,x2,y2; one header row may come first; # starts a comment.
 * .geojson: Line- and MultiLineString, Polygon and MultiPolygon with their holes, alone
 * or in Feature, FeatureCollection, GeometryCollection; points are left out. Coordinates
 * must be planar: if the file does not name a planar `crs` and all of them could be
 * degrees (|x| <= 180, |y| <= 90) with decimals as degrees need, it is refused.
 * .svg: path (M L H V Z, absolute and relative), line, polyline, polygon, rect, in any
 * groups; y, which points down in SVG, is turned up. Curves and transform attributes are
 * refused: a plan that is wrong in parts is worse than none.
 * Segments without length are left out.
 * \throws IoFailed naming file, place, value and rule: also a file without any segment
 * \throws BadArgument scale breaks its rule \ingroup io */
Segments
readSegments(const std::filesystem::path& path, const SegmentOptions& options = {});

/** \brief Writes rows x1,y1,x2,y2 under a header, with 17 digits, atomically.
 * \throws IoFailed the file cannot be written */
void
writeSegments(const std::filesystem::path& path, const Segments& segments);

} // namespace pcl6d
