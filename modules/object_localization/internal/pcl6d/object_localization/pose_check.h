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

/** \brief Result of comparing a scan with an object at a pose. Each element of the
 * model's surface that faces the scanner, not hidden by the object itself, is in one of
 * five classes. */
struct PoseCheck {
  std::size_t elements = 0;  ///< that face the scanner, met by a ray or not
  std::size_t supported = 0; ///< on a surface of the scan
  std::size_t refuted = 0;   ///< a ray of the scan passed through
  std::size_t misfit = 0;    ///< a surface is near, but apart or turned
  std::size_t occluded = 0;  ///< a surface is in front
  std::size_t unseen = 0;    ///< no measurement in this direction
  std::size_t continued = 0; ///< of `support`: elements whose surface continues
                             ///< smoothly beyond the object
  double rms = 0; ///< [m] distance of supported elements to the scan's surface
  /** indices of the scan's surface elements on the object, ascending, each once */
  std::vector<std::uint32_t> support;

  /** \return the number of elements of the five classes */
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

  /** \return of the scan's surface at the pose, the share that agrees with the
   * object */
  double
  agreement() const
  {
    const std::size_t known = supported + misfit;
    return known == 0 ? 0 : static_cast<double>(supported) / static_cast<double>(known);
  }

  /** \return how much of the surface continues beyond the object, for example on a
   * piece of a wall: as a share of the perimeter of a square of equal area */
  double
  continuation() const
  {
    return support.empty() ? 0
                           : static_cast<double>(continued) /
                                 (4 * std::sqrt(static_cast<double>(support.size())));
  }

  /** \return refuted elements over supported and refuted elements; 1 without any */
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
  PointTree tree; ///< over the points of `surface`
  double element; ///< [m]
};

/** \brief Compares an object at a pose with a scan (book 7.2.2, step 4): each element
 * of the object's surface with the scan's rays through it. Elements between the rays of
 * a coarse scan are in no class.
 * \param[in] surface of the scan, in elements of the model's size or larger; elements
 * on a large plane never support an object
 * \param[in] tolerance [m] of a correct pose, without the noise of the scan
 * \ingroup object_localization */
PoseCheck
checkPose(const LocalizationScene& scene,
          const SceneSurface& surface,
          const ModelSurface& model,
          const Eigen::Isometry3d& T_scene_model,
          double tolerance);

} // namespace pcl6d
