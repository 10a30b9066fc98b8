// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What an estimator says of its own result, so that "identity, because nothing
 * was found" can never pass for "identity, because already aligned". \ingroup common */
enum class Status {
  kOk,            ///< unique minimiser; converged
  kRankDeficient, ///< a whole family of minimisers; the one with the smallest motion
  kTooFewPairs,   ///< fewer than 3 pairs; the transform is the input guess or identity
  kMaxIterations, ///< iteration limit reached; the last iterate
  kDiverged       ///< non-finite value, or the error grew beyond its limit; the guess
};

/** \return "ok", "rank-deficient", "too-few-pairs", "max-iterations" or "diverged" */
const char*
toString(Status status);

/** \throws BadArgument no status has that name */
Status
statusFromName(const std::string& name);

/** \brief A rigid motion and how far it can be believed. \ingroup common */
struct RigidEstimate {
  Status status = Status::kTooFewPairs;
  Eigen::Isometry3d transform =
      Eigen::Isometry3d::Identity(); ///< maps source to target
};

} // namespace pcl6d
