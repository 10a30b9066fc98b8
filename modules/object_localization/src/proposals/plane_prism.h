// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/polygon.h>
#include <pcl6d/plane_segmentation/plane_segment.h>

#include <Eigen/Geometry>

#include <vector>

/** \file Shapes of planes. Internal to the module object_localization. */
namespace pcl6d::object_localization {

/** \brief The space over the hull of a plane, on the side that was seen. */
class PlanePrism {
public:
  explicit PlanePrism(const PlaneSegment& segment);

  /** \return the height [m] over the plane */
  double
  height(const Eigen::Vector3f& point) const
  {
    return side_.dot(point.cast<double>()) - offset_;
  }

  /** \return whether the point is over or under the hull grown by a margin [m] */
  bool
  covers(const Eigen::Vector3f& point, double margin) const
  {
    return hull_.covers(point.cast<double>(), margin);
  }

  /** \return the unit normal on the side that was seen */
  const Eigen::Vector3d&
  side() const
  {
    return side_;
  }

private:
  Eigen::Vector3d side_;
  double offset_; // [m] along side_
  HullPrism hull_;
};

/** \return the largest distance [m] of two corners in plan */
double
widthOf(const std::vector<Eigen::Vector3d>& hull, const Eigen::Vector3d& up);

/** \return the difference [m] of the highest and the lowest corner */
double
heightOf(const std::vector<Eigen::Vector3d>& hull, const Eigen::Vector3d& up);

/** \return the mean of the corners */
Eigen::Vector3d
middleOf(const std::vector<Eigen::Vector3d>& hull);

} // namespace pcl6d::object_localization
