// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <vector>

/** \file Where the view of a scan ends. Internal to the module object_localization. */
namespace pcl6d::object_localization {

/** \brief The directions covered by a scan: a camera's convex field of view, or a band
 * of elevations of an all-around scanner (azimuth without border). */
class ViewBorder {
public:
  explicit ViewBorder(const PlaneCloud& cloud);

  /** \return whether every point is in one direction, as for a camera */
  bool
  isNarrow() const
  {
    return narrow_;
  }

  /** \return the angle [rad] between neighbouring points, the median */
  double
  angularSpacing() const
  {
    return angular_spacing_;
  }

  /** \return whether a point lies at the border of the view \param[in] point index into
   * PlaneCloud::points() */
  bool
  touches(std::size_t point) const;

private:
  Eigen::Vector3d
  rayTo(std::size_t point) const;
  void
  makeField();
  void
  makeBand();

  const PlaneCloud& cloud_;
  double angular_spacing_ = 0;
  bool narrow_ = false;
  Eigen::Matrix3d R_view_cloud_ = Eigen::Matrix3d::Identity(); // z: the middle
  std::vector<Eigen::Vector3d>
      sides_;                        // of the field, a.u + b.v <= c of (u, v) = xy / z
  double lowest_ = -1, highest_ = 1; // of z over range
};

} // namespace pcl6d::object_localization
