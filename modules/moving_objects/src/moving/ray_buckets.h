// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace pcl6d::moving_objects {

/** \brief The points of a scan in buckets that no ray image can resolve: in one cell of
 * directions, with no gap in range. */
struct RayBuckets {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  Points places; ///< [m] of each bucket the point in the middle
  std::vector<std::uint32_t>
      bucket; ///< of each point; kNone: not finite, or the origin
};

/** \param[in] origin [m] of the rays \param[in] cell [rad] > 0
 * \param[in] noise [m] standard deviation of a range */
RayBuckets
bucketsOf(const Points& points,
          const Eigen::Vector3f& origin,
          double cell,
          double noise);

} // namespace pcl6d::moving_objects
