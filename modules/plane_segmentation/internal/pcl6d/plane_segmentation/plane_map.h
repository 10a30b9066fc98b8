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
  double cell = 0.05;                    ///< [m] of the cells occupied by planes; > 0
  double max_step = 0.025; ///< [m] between a scan's plane and the map's; > 0
  double max_angle = 0.09; ///< [rad] between a scan's plane and the map's; in (0, pi/2)
  double max_gap = 0.25;   ///< [m] between the surfaces they cover; >= 0
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief The planes of a map. */
struct MapPlanes {
  std::vector<PlaneSegment> planes; ///< in the world frame, largest first; without
                                    ///< `points`
  /** Maps each number returned by PlaneMap::addScan() to an index into planes. */
  std::vector<std::size_t> place_of;
};

/** \brief Planes of a registered map, built scan by scan in bounded memory. Each scan
 * is segmented on its own, its planes extend planes of the map, and its points are
 * dropped. A plane keeps the sums of its points and its occupied cells, so memory grows
 * with the measured surface, not with the number of points. The two faces of a wall are
 * seen from different sides and stay two planes.
 *
 * The rms of a plane, over its points of every scan, is its thickness: inconsistent
 * poses increase it. \code
 * pcl6d::PlaneMap map;
 * for (std::size_t i = 0; i < scans.size(); ++i)
 *   map.addScan(scans[i], poses[i]);
 * const auto planes = map.planes();
 * \endcode
 * \ingroup plane_segmentation */
class PlaneMap {
public:
  /** \throws BadArgument an option is invalid */
  explicit PlaneMap(const PlaneMapOptions& options = {});
  ~PlaneMap();
  PlaneMap(PlaneMap&&) noexcept;
  PlaneMap&
  operator=(PlaneMap&&) noexcept;

  /** \brief Segments a scan and adds its planes.
   * \param[in] points [m] in the frame of the sensor; points with a non-finite
   * coordinate are left out
   * \param[in] T_world_scan pose of the scan
   * \return per plane of the scan, largest first, its number in the map, see
   * MapPlanes::place_of
   * \throws BadArgument the pose is not finite; see also PlaneCloud */
  std::vector<std::size_t>
  addScan(const Points& points, const Eigen::Isometry3d& T_world_scan);

  /** \brief Adds the planes of a scan that is already segmented. */
  std::vector<std::size_t>
  addScan(const Points& points,
          const PlaneSegments& segments,
          const Eigen::Isometry3d& T_world_scan);

  /** \return the planes up to now, with hulls and areas of their occupied cells */
  MapPlanes
  planes() const;

  /** \return the number of points on planes up to now */
  std::size_t
  numPoints() const;

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

} // namespace pcl6d
