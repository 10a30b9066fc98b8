// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>

#include <Eigen/Geometry>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A candidate link between two scans: its measurements, its result and the reason.
 * Rejected candidates are kept. from and to are the indices of its scans.
 * \ingroup graph_relaxation */
struct ScanLink : RunLink {
  /** of a loop: the pose of `to` seen from `from`, as matched */
  std::optional<Eigen::Isometry3d> T_from_to;
  /** of T_from_to, x y z roll pitch yaw [m, rad]; empty if the pairs do not fix the pose */
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
};

template <typename Archive>
void
packFields(Archive& archive, ScanLink& link)
{
  archive(link.from, link.to, link.kind, link.verdict, link.rejection, link.distance);
  archive(link.pairs, link.rms, link.overlap, link.condition, link.weight);
  archive(link.T_from_to, link.covariance);
}

} // namespace pcl6d
