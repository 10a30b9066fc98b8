// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>
#include <pcl6d/plane_segmentation/plane_segment.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of proposeObjects(). Lengths in units of the scan's spacing at the
 * object's range suit a lidar as well as a depth camera. */
struct ProposalOptions {
  /** Up in the cloud's frame. Default: z for a scan all around; for a camera's narrow
   * view the side of the plane on which most points stand. */
  std::optional<Eigen::Vector3d> up;
  double max_tilt = 0.26;    ///< [rad] of a supporting plane; in (0, pi/2)
  double max_extent = 2.5;   ///< [m] of an object; larger planes are structure, such as
                             ///< walls; > 0
  double max_height = 2.1;   ///< [m] of an object's top over its support; > 0
  double min_height = 0.015; ///< [m] of an object's top over its support, at least; > 0
  double contact = 0.12;     ///< [m] from an object's lowest point to its support; > 0
  double overhang = 0.5; ///< [m] of an object beyond the visible part of its support,
                         ///< for example the floor under a shelf; >= 0
  double gap = 2;        ///< [spacings] between two objects; >= 1
  double crease = 0.3; ///< sine of the angle to the chord over a concave crease between
                       ///< two touching objects; in (0, 1)
  /** [m] largest visible gap between an object and its support, where feet are hidden
   * or too thin for the scan; >= 0 */
  double max_float = 1;
  std::size_t min_points = 12; ///< of an object; >= 3
  bool parts = true; ///< whether to propose also the parts between creases and planes,
                     ///< for example each box of a stack
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A connected group of points on a plane, possibly one object. */
struct ObjectProposal {
  std::vector<std::uint32_t> points; ///< indices into the cloud, ascending
  /** Upright frame of the points' bounding box: z up, x along the longer side of the
   * smallest rectangle around the footprint, origin in the middle of the footprint, on
   * the support. */
  Eigen::Isometry3d T_scene_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Zero(); ///< [m] along the axes of the box
  std::size_t support = 0;     ///< index of the supporting plane in the list of planes
  bool touches_border = false; ///< reaches the border of the measurements: may be cut
  std::optional<std::size_t> part_of; ///< index of the larger proposal that contains
                                      ///< this part
};

/** \brief Proposes objects without a model or detector (book 7.2.2): segments that
 * stand on planes.
 *
 * Planes too large for an object are removed. The points left over level planes are
 * grouped by gaps, relative to the spacing of the scan. Groups are divided at concave
 * creases (local convexity) and at level planes inside another group, such as a table
 * top. \code
 * const pcl6d::PlaneCloud cloud(points);
 * const auto planes = pcl6d::segmentPlanes(cloud);
 * for (const auto& thing : pcl6d::proposeObjects(cloud, planes))
 *   use(thing.points, thing.T_scene_box, thing.size);
 * \endcode
 * \param[in] planes of the cloud; without a supporting plane the result is empty
 * \return most points first, but parts right behind their whole. Equal for any number
 * of threads
 * \throws BadArgument an option is invalid
 * \note Source: S. C. Stein, M. Schoeler, J. Papon, F. Wörgötter, "Object partitioning
 * using local convexity", CVPR 2014, for the criterion at creases.
 * \ingroup object_localization */
std::vector<ObjectProposal>
proposeObjects(const PlaneCloud& cloud,
               const PlaneSegments& planes,
               const ProposalOptions& options = {});

} // namespace pcl6d
