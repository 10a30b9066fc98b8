// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/oriented_points.h>
#include <pcl6d/search/point_tree.h>
#include <pcl6d/visibility/ray_image.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan prepared for the search for objects: all points, its rays, and how
 * close these are. The scanner is at the origin. \ingroup object_localization */
class LocalizationScene {
public:
  /** \param[in] points [m] in the scan's frame; those that are not finite are left out
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

  /** \return its rays, in cells about as wide as they are apart, without the noise of
   * their ranges */
  const RayImage&
  rays() const
  {
    return rays_;
  }

  /** \return whether it looks one way, as a camera does, and not all around */
  bool
  isNarrow() const
  {
    return is_narrow_;
  }

  /** \return median distance of a point and its nearest neighbour over its range [rad] */
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
