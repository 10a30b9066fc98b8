// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/graph_relaxation/stage_agreement.h>
#include <pcl6d/registration/icp.h>

#include <optional>

namespace pcl6d::slam6d {

/** \return the share, in [0, 1], of finite points within a distance [m] of a target point; 0
 * without a finite point. Large clouds are sampled. The same for any number of threads. */
PCL6D_EXPORTS double // exported for its test
agreementOf(const IcpTarget& target,
            const Points& points,
            const Eigen::Isometry3d& T_target_points,
            double distance,
            unsigned int num_threads);

/** \return agreementOf() at two poses, over the same points.
 * \param[in] cube [m] edge of the cubes whose points count as one sample; > 0 */
PCL6D_EXPORTS AgreementChange // exported for its test
agreementChange(const IcpTarget& target,
                const Points& points,
                const Eigen::Isometry3d& T_target_before,
                const Eigen::Isometry3d& T_target_after,
                double distance,
                double cube,
                unsigned int num_threads);

/** \brief All measured points of a scan within the range gate: a finer test of a fit than the
 * reduced points. The tree is built on first use. */
class MeasuredScan {
public:
  MeasuredScan() = default;
  explicit MeasuredScan(Points points) : points_(std::move(points)) {}

  const Points&
  points() const
  {
    return points_;
  }
  const PointTree&
  tree(unsigned int num_threads) const;

private:
  Points points_;
  mutable std::optional<PointTree> tree_;
};

/** \brief The mean change for two scans: each scan's points against the other scan. */
PCL6D_EXPORTS AgreementChange // exported for its test
agreementChange(const MeasuredScan& a,
                const MeasuredScan& b,
                const Eigen::Isometry3d& T_a_b_before,
                const Eigen::Isometry3d& T_a_b_after,
                double distance,
                double cube,
                unsigned int num_threads);

} // namespace pcl6d::slam6d
