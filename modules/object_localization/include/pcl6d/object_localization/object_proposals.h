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

/** \brief Knobs of proposeObjects(). Spacings are those of the scan at the range of the
 * object, so that the defaults suit a lidar as well as a depth camera. */
struct ProposalOptions {
  /** Which way is up in the cloud's frame; none: z of a scan that looks all around, and
   * for a camera's narrow view the side of the plane that most things touch. */
  std::optional<Eigen::Vector3d> up;
  double max_tilt = 0.26;    ///< [rad] of a plane that carries things; in (0, pi/2)
  double max_extent = 2.5;   ///< [m] of a thing; larger planes are walls, say; > 0
  double max_height = 2.1;   ///< [m] of a thing's top over its support; > 0
  double min_height = 0.015; ///< [m] the same, at least; > 0
  double contact = 0.12;     ///< [m] from a thing's lowest point to its support; > 0
  double overhang = 0.5; ///< [m] of a thing beyond what is seen of its support, such as
                         ///< the floor under a shelf; >= 0
  double gap = 2;        ///< [spacings] that part two things; >= 1
  double crease = 0.3;   ///< sine of the angle to the chord over a concave crease,
                         ///< across which two things touch; in (0, 1)
  /** [m] that a thing may seem to float over its support, because its feet are hidden or
   * too thin for the scan; >= 0 */
  double max_float = 1;
  std::size_t min_points = 12; ///< of a thing; >= 3
  bool parts = true; ///< whether to propose also the parts of what creases and
                     ///< planes divide, such as each box of a stack
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Points that may be one object: they stand on a plane and hang together. */
struct ObjectProposal {
  std::vector<std::uint32_t> points; ///< places in the cloud, ascending
  /** Upright frame of the box around them: z up, x along the longer side of the smallest
   * rectangle around their footprint, origin in its middle, on the support. */
  Eigen::Isometry3d T_scene_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Zero(); ///< [m] along the axes of that frame
  std::size_t support = 0; ///< the plane it stands on, as a place in the list of planes
  bool touches_border = false;        ///< ends where the measurements do: may be cut
  std::optional<std::size_t> part_of; ///< the larger proposal that it is a piece of
};

/** \brief Proposes objects without knowing what they look like (book 7.2.2 without a
 * detector): segments that stand on planes.
 *
 * Planes that are too large for things are taken away, what is left over those that face
 * up is grouped by gaps against the spacing of the scan, and groups divide at creases
 * into which their surface bends (local convexity) and where they stand on a level plane
 * that is part of another group, such as a table's. \code
 * const pcl6d::PlaneCloud cloud(points);
 * const auto planes = pcl6d::segmentPlanes(cloud);
 * for (const auto& thing : pcl6d::proposeObjects(cloud, planes))
 *   use(thing.points, thing.T_scene_box, thing.size);
 * \endcode
 * \param[in] planes of the cloud; without any that carries things nothing is proposed
 * \return most points first, but parts right behind what they are part of. The same for
 * any number of threads
 * \throws BadArgument an option breaks its rule
 * \note Source: S. C. Stein, M. Schoeler, J. Papon, F. Wörgötter, "Object partitioning
 * using local convexity", CVPR 2014, for the criterion at creases.
 * \ingroup object_localization */
std::vector<ObjectProposal>
proposeObjects(const PlaneCloud& cloud,
               const PlaneSegments& planes,
               const ProposalOptions& options = {});

} // namespace pcl6d
