// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <cstddef>
#include <vector>

namespace pcl6d {

/** \brief What the surfels of a cloud say of the surface, judged by the noise. */
struct SurfelTrust {
  std::vector<float> sigma; ///< [m] noise of a point there
  std::vector<char> smooth; ///< whether the neighbours lie on a plane: trust the normal

  explicit SurfelTrust(const PlaneCloud& cloud);
};

} // namespace pcl6d
