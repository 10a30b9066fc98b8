// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/localization_scene.h>
#include <pcl6d/object_localization/scene_surface.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What a scan says of an object at a pose: each point of the model's surface that
 * faces the scanner and that the object itself does not hide is one of five. */
struct PoseCheck {
  std::size_t elements = 0; ///< of the model that face the scanner, met by a ray or not
  std::size_t supported = 0; ///< the scan has a surface there
  std::size_t refuted = 0;   ///< the scanner saw through
  std::size_t misfit = 0;    ///< there is a surface, but off or turned otherwise
  std::size_t occluded = 0;  ///< something is in front
  std::size_t unseen = 0;    ///< no measurement in this direction
  std::size_t continued = 0; ///< of `support`: from where the surface goes on smoothly
                             ///< beyond the object
  double rms = 0;            ///< [m] distance to the surface, of those supported
  /** places of the scan's points that support it, ascending, each once */
  std::vector<std::uint32_t> support;

  /** \return the number of points that face the scanner */
  std::size_t
  facing() const
  {
    return supported + refuted + misfit + occluded + unseen;
  }

  /** \return the share of the facing surface that is seen */
  double
  visibleFraction() const
  {
    return facing() == 0
               ? 0
               : static_cast<double>(supported) / static_cast<double>(facing());
  }

  /** \return of the surface that the scan shows where the object would be, the share that
   * is the object's */
  double
  agreement() const
  {
    const std::size_t known = supported + misfit;
    return known == 0 ? 0 : static_cast<double>(supported) / static_cast<double>(known);
  }

  /** \return how much of the surface goes on where the object ends, as on a piece of a
   * wall: as a share of the perimeter of a square of as many elements */
  double
  continuation() const
  {
    return support.empty() ? 0
                           : static_cast<double>(continued) /
                                 (4 * std::sqrt(static_cast<double>(support.size())));
  }

  /** \return of what the scan speaks of, the share that speaks against the pose */
  double
  freeSpaceViolation() const
  {
    const std::size_t known = supported + refuted;
    return known == 0 ? 1 : static_cast<double>(refuted) / static_cast<double>(known);
  }
};

/** \brief The surface of a model in elements of one size. */
struct ModelSurface {
  /** \param[in] dense the model \param[in] size [m] > 0 */
  ModelSurface(const OrientedPoints& dense, double size)
  : surface(reduceOriented(dense, size)), tree(surface.points), element(size)
  {}

  OrientedPoints surface;
  PointTree tree; ///< over its points
  double element; ///< [m]
};

/** \brief Compares an object at a pose with a scan (book 7.2.2, step 4): each element of
 * its surface with the rays of the scan through it. Where the scan is too coarse for a
 * ray to meet an element, it says nothing of it.
 * \param[in] surface of the scan, in elements of the model's size or larger; what is on
 * a large plane is no object
 * \param[in] tolerance [m] of a pose that is right, without the noise of the scan
 * \ingroup object_localization */
PoseCheck
checkPose(const LocalizationScene& scene,
          const SceneSurface& surface,
          const ModelSurface& model,
          const Eigen::Isometry3d& T_scene_model,
          double tolerance);

} // namespace pcl6d
