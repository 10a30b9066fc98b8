// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief An estimator's status, to distinguish "identity, no solution found" from "identity,
 * already aligned". \ingroup common */
enum class Status {
  kOk,            ///< unique minimiser; converged
  kRankDeficient, ///< a family of minimisers; returns the smallest motion
  kTooFewPairs,   ///< fewer than 3 pairs; the transform is the input guess or identity
  kMaxIterations, ///< iteration limit reached; the last iterate
  kDiverged       ///< non-finite value, or the error exceeded the limit; returns guess
};

/** \return "ok", "rank-deficient", "too-few-pairs", "max-iterations" or "diverged" */
const char*
toString(Status status);

/** \throws BadArgument unknown name */
Status
statusFromName(const std::string& name);

/** \brief A rigid motion with status. \ingroup common */
struct RigidEstimate {
  Status status = Status::kTooFewPairs;
  Eigen::Isometry3d transform =
      Eigen::Isometry3d::Identity(); ///< maps source to target
};

} // namespace pcl6d
