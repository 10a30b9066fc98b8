// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/oriented_points.h>
#include <pcl6d/search/point_tree.h>
#include <pcl6d/visibility/ray_image.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan prepared for object search: points, search tree, rays and angular
 * spacing. The scanner is at the origin. \ingroup object_localization */
class LocalizationScene {
public:
  /** \param[in] points [m] in the scan's frame; points with a non-finite coordinate are
   * left out
   * \param[in] num_threads 0: one per core; never changes the result
   * \throws BadArgument fewer than 10 finite points */
  explicit LocalizationScene(const Points& points, unsigned int num_threads = 0);

  const Points&
  points() const
  {
    return points_;
  }
  const PointTree&
  tree() const
  {
    return tree_;
  }

  /** \return the rays, in cells about as wide as the angular spacing, without noise of
   * the ranges */
  const RayImage&
  rays() const
  {
    return rays_;
  }

  /** \return whether the field of view is narrow, like a camera's, and not all
   * around */
  bool
  isNarrow() const
  {
    return is_narrow_;
  }

  /** \return median distance of a point and its nearest neighbour over the point's
   * range [rad], at most 0.05 */
  double
  angularSpacing() const
  {
    return angular_spacing_;
  }

private:
  Points points_;
  PointTree tree_;
  double angular_spacing_;
  RayImage rays_;
  bool is_narrow_ = false;
};

} // namespace pcl6d
