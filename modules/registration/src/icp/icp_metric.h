// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "icp/correspondence_search.h"

namespace pcl6d::registration {

/** \brief The pairs of one pose, summed up, and the step that follows from them. */
struct MetricStep {
  std::size_t pairs = 0;
  double rms = 0;      ///< [m] distance of the pairs
  double residual = 0; ///< [m] rms of the residuals of the metric
  Eigen::Vector3d centroid =
      Eigen::Vector3d::Zero(); ///< of the moved source points [m]
  RigidEstimate motion;        ///< in the target's frame, to be put before the pose
  double scale = 1; ///< of the moved points about their centroid, if estimated
};

/** \brief One metric over the pairs of a CorrespondenceSearch. */
class IcpMetric {
public:
  IcpMetric(const IcpSource& source, const IcpOptions& options)
  : source_(source), options_(options)
  {}

  /** Applies trimming and robust weights to the pairs, if set. */
  void
  weigh(const Placement& at, std::vector<Partner>& partners) const;

  /** \return the best step from a pose */
  MetricStep
  step(const Placement& at, const std::vector<Partner>& partners) const;

  /** Fills in how well the pairs fix the pose. */
  void
  rate(const std::vector<Partner>& partners, IcpResult& result) const;

private:
  PairSums
  pairSums(const Placement& at, const std::vector<Partner>& partners) const;
  PlaneSums
  planeSums(const Eigen::Isometry3d& T, const std::vector<Partner>& partners) const;

  /** The normal of a pair of a symmetric objective. */
  Eigen::Vector3d
  sumOfNormals(const Eigen::Isometry3d& T, const Partner& partner, std::size_t i) const;

  /** N of a pair, for kGicp. */
  Eigen::Matrix3d
  normOf(const Eigen::Isometry3d& T, const Partner& partner, std::size_t i) const;

  const IcpSource& source_;
  const IcpOptions& options_;
};

} // namespace pcl6d::registration
