// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/plane_segmentation/plane_segment.h>

#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Points of a map with normals, and the scan of each point. */
struct MapPoints {
  Points points;                    ///< [m] in the world
  Normals normals;                  ///< towards the scanner; zero if unknown
  std::vector<std::uint32_t> scans; ///< one per point
};

/** \brief Options of the thickness of planes. \ingroup benchmarking */
struct PlaneThicknessOptions {
  double gate = 0.3;       ///< [m] farther points are not of the plane; > 0
  double max_angle = 0.35; ///< [rad] between normals; in (0, pi/2)
  double min_area = 1;     ///< [m^2] least area of a plane; >= 0
  /** least number of points of a plane, over the scans together; >= 4 */
  std::size_t min_points = 50;
  std::size_t max_planes = 200; ///< largest ones; >= 1
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A plane of the map with the surrounding points of every scan. */
struct ThickPlane {
  Plane plane;           ///< fitted to the points; area and hull as given
  std::size_t scans = 0; ///< number of scans with points on the plane
  double thickness = 0;  ///< [m] rms distance of the points
};

/** \brief How thick the planes of a map are. */
struct PlaneThickness {
  std::vector<ThickPlane> planes; ///< largest area first
  double rms = 0;            ///< [m] over the points of every plane; NaN without planes
  double median = 0;         ///< [m] of the planes' thicknesses; NaN without planes
  std::vector<double> scans; ///< [m] per scan: rms of its points; NaN without points
};

/** \brief Thickness: rms distance of the points of the scans to the planes of the map.
 *
 * The planes come from single scans, where a wall is sharp; in the whole map a bent
 * wall would look like two sharp walls. A plane collects the points over its outline,
 * within the gate, with normals towards its observer; the plane is fitted to these
 * points, and collects again. A plane with its middle in the hull and the gate of a
 * larger plane counts as a duplicate and is left out; likewise a plane seen by fewer
 * than two scans.
 * \param[in] planes [m] in the world; without an outline the hull counts; planes
 * without a hull of at least 3 corners are left out
 * \param[in] num_scans number of scans of the map
 * \throws BadArgument an option is invalid, sizes differ, or a point has no scan */
PlaneThickness
planeThickness(const std::vector<PlaneSegment>& planes,
               const MapPoints& map,
               std::size_t num_scans,
               const PlaneThicknessOptions& options = PlaneThicknessOptions());

} // namespace pcl6d
