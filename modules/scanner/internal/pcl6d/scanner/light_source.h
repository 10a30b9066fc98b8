// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Light source of a scanner, if apart from the receiver: the projector of a
 * triangulating scanner. A surface in its shadow gives no return.
 * \ingroup scanner */
class LightSource {
public:
  virtual ~LightSource() = default;
  /** \return in the scanner's frame [m] */
  virtual Eigen::Vector3d
  position() const = 0;
  /** \return whether the light reaches a point of the scanner's frame, without regard
   * to occlusion */
  virtual bool
  lights(const Eigen::Vector3d& point) const = 0;
};

} // namespace pcl6d
