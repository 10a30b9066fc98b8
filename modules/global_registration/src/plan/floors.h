// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/icp_model.h>

#include <Eigen/Core>

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Heights of the level surfaces of a scan - floors, ceilings, tables - by cells of its
 * plan. */
class Floors {
public:
  /** \param[in] cell [m] */
  Floors(const IcpModel& surfaces, const Eigen::Matrix3d& R_level_scan, double cell);

  /** \return [m] how far the level surfaces of `other` lie below the surfaces here, most
   * frequent first
   * \param[in] R turns the level frame of `other` about z
   * \param[in] shift [m] of `other` after the turn
   * \param[in] step [m] resolution of heights */
  std::vector<double>
  heightsAbove(const Floors& other,
               const Eigen::Matrix2d& R,
               const Eigen::Vector2d& shift,
               double step) const;

private:
  using Cell = std::pair<int, int>;

  Cell
  cellOf(const Eigen::Vector3d& p) const;

  double cell_;
  std::vector<Eigen::Vector3d> points_; ///< level
  std::vector<bool> up_;                ///< whether a point is seen from above
  std::map<Cell, std::vector<std::size_t>> heights_;
};

} // namespace pcl6d::global_registration
