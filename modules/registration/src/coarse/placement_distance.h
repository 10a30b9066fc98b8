// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <algorithm>
#include <vector>

namespace pcl6d::registration {

/** \brief Distance between two placements of a set of points: the root mean square of
 * the distances between the two places of each point. */
class PlacementDistance {
public:
  /** \param[in] points [m]; must be finite */
  explicit PlacementDistance(const Points& points);

  /** \return [m] */
  double
  operator()(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;

private:
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

/** \return the first of each group of close placements, at most max_count, any two
 * farther apart than min_distance [m]
 * \tparam Placement has T_target_source \param[in] placements best first */
template <typename Placement>
std::vector<Placement>
firstDistinct(const std::vector<Placement>& placements,
              const PlacementDistance& distance,
              double min_distance,
              std::size_t max_count)
{
  std::vector<Placement> kept;
  for (const auto& p : placements) {
    if (kept.size() == max_count)
      break;
    if (std::none_of(kept.begin(), kept.end(), [&](const auto& k) {
          return distance(p.T_target_source, k.T_target_source) <= min_distance;
        }))
      kept.push_back(p);
  }
  return kept;
}

} // namespace pcl6d::registration
