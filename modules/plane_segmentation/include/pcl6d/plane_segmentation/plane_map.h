// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <memory>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of PlaneMap. */
struct PlaneMapOptions {
  PlaneMethod method = PlaneMethod::kRegionGrowing;
  PlaneSegmentationOptions segmentation; ///< of each scan
  double cell = 0.05;                    ///< [m] of the cells that planes occupy; > 0
  double max_step = 0.025;      ///< [m] between a scan's plane and the map's; > 0
  double max_angle = 0.09;      ///< [rad] between them; in (0, pi/2)
  double max_gap = 0.25;        ///< [m] between what they cover; >= 0
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief The planes of a map. */
struct MapPlanes {
  std::vector<PlaneSegment> planes; ///< in the world, largest first; without `points`
  /** Of each number that PlaneMap::addScan() returned, its place in planes. */
  std::vector<std::size_t> place_of;
};

/** \brief The planes of a whole registered map, scan by scan, in bounded memory: each
 * scan is segmented on its own, its planes join those of the map that they continue, and
 * its points are forgotten. A plane keeps the sums of its points and the cells that
 * they occupy, so memory grows with the surface that was seen and not with the points.
 * The two faces of a wall are seen from different sides and stay two planes.
 *
 * The rms of a plane, over all its points of all scans, is its thickness: poses that do
 * not agree make it grow. \code
 * pcl6d::PlaneMap map;
 * for (std::size_t i = 0; i < scans.size(); ++i)
 *   map.addScan(scans[i], poses[i]);
 * const auto planes = map.planes();
 * \endcode \ingroup plane_segmentation */
class PlaneMap {
public:
  /** \throws BadArgument an option breaks its rule */
  explicit PlaneMap(const PlaneMapOptions& options = {});
  ~PlaneMap();
  PlaneMap(PlaneMap&&) noexcept;
  PlaneMap&
  operator=(PlaneMap&&) noexcept;

  /** \brief Segments a scan and adds its planes.
   * \param[in] points [m] in the frame of the sensor; those that are not finite are
   * left out
   * \param[in] T_world_scan pose of the scan
   * \return per plane of the scan, largest first, the number that the map gave it, see
   * MapPlanes::place_of
   * \throws BadArgument the pose is not finite; see also PlaneCloud */
  std::vector<std::size_t>
  addScan(const Points& points, const Eigen::Isometry3d& T_world_scan);

  /** \brief The same with a segmentation of the scan that is there already. */
  std::vector<std::size_t>
  addScan(const Points& points,
          const PlaneSegments& segments,
          const Eigen::Isometry3d& T_world_scan);

  /** \return the planes so far, with hulls and areas of the cells that they occupy */
  MapPlanes
  planes() const;

  /** \return the number of points on planes so far */
  std::size_t
  numPoints() const;

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

} // namespace pcl6d
