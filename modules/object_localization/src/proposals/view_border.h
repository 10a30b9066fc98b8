// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <vector>

/** \file Where the view of a scan ends. Internal to the module object_localization. */
namespace pcl6d::object_localization {

/** \brief The directions that a scan covers: a camera's convex field of view, or a band of
 * elevations around a scanner that looks all around (its azimuth has no border here). */
class ViewBorder {
public:
  explicit ViewBorder(const PlaneCloud& cloud);

  /** \return whether all is in one direction, as seen by a camera */
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

  /** \return whether a point lies where the view ends
   * \param[in] point a place in PlaneCloud::points() */
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
