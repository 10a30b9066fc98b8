// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/plane_segmentation/plane_segment.h>

#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Points of a map with normals, and the scan that each came from. */
struct MapPoints {
  Points points;                    ///< [m] in the world
  Normals normals;                  ///< towards the scanner; zero where there is none
  std::vector<std::uint32_t> scans; ///< one per point
};

/** \brief Knobs of the thickness of planes. \ingroup benchmarking */
struct PlaneThicknessOptions {
  double gate = 0.3;            ///< [m] farther points are not of the plane; > 0
  double max_angle = 0.35;      ///< [rad] between normals; in (0, pi/2)
  double min_area = 1;          ///< [m^2] of a plane; smaller ones are not taken; >= 0
  std::size_t min_points = 50;  ///< of a plane, over all scans; >= 4
  std::size_t max_planes = 200; ///< largest ones; >= 1
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief A plane of the map with the points of all scans around it. */
struct ThickPlane {
  Plane plane;           ///< fitted to these points; area and hull: as given
  std::size_t scans = 0; ///< that have points on it
  double thickness = 0;  ///< [m] rms distance of all its points
};

/** \brief How thick the planes of a map are. */
struct PlaneThickness {
  std::vector<ThickPlane> planes; ///< largest area first
  double rms = 0;            ///< [m] of all points of all planes; NaN without planes
  double median = 0;         ///< [m] of the planes' thicknesses; NaN without planes
  std::vector<double> scans; ///< [m] per scan: rms of its points; NaN without any
};

/** \brief Thickness: rms of the points of all scans to the planes that they show.
 *
 * The planes come from single scans, in which a wall is sharp; in the whole map a bent wall
 * would pass for two sharp ones. A plane collects the points over its outline whose normals
 * look to where it was seen from and that lie within the gate, is fitted to them anew, and
 * collects again. One that has its middle in the hull and the gate of a larger one is taken
 * for the same surface and left out, and so is one that fewer than two scans see.
 * \param[in] planes [m] in the world; without an outline the hull counts, without a hull
 * of at least 3 corners they are left out
 * \param[in] num_scans how many scans the map has
 * \throws BadArgument an option breaks its rule, sizes differ, or a point is of no scan */
PlaneThickness
planeThickness(const std::vector<PlaneSegment>& planes,
               const MapPoints& map,
               std::size_t num_scans,
               const PlaneThicknessOptions& options = PlaneThicknessOptions());

} // namespace pcl6d
