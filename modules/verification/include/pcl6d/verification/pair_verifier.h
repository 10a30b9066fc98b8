// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/verification/link_evidence.h>
#include <pcl6d/verification/prepared_scans.h>

#include <Eigen/Geometry>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The verdict on a relative pose of two scans, with its evidence. */
struct PairVerdict {
  LinkTestResult test_result;
  LinkEvidence evidence;
  double background = 0; ///< share of patches that may be contradicted in a right link
};

/** \brief Verifies a link as a map of two scans. Identical scans are no evidence: the link is at
 * best unverified.
 * \param[in] T_first_second pose of the second scan seen from the first */
PairVerdict
verifyLink(const PreparedScans& scans,
           std::size_t first,
           std::size_t second,
           const Eigen::Isometry3d& T_first_second);

/** \brief Verifies poses of two clouds: the compiled core of RegistrationVerifier. Prepared clouds
 * are kept until a cloud or a parameter changes.
 * \ingroup verification */
class PairVerifier {
public:
  /** \brief A cloud in its own frame [m], and the position of the scanner in it. */
  struct Cloud {
    Points points;
    Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  };

  void
  setSource(Cloud cloud);
  void
  setTarget(Cloud cloud);

  /** \brief Range gate and reduction; empty options are derived from both clouds.
   * \throws BadArgument naming the invalid value */
  void
  setParameters(const ScanParameterOptions& options);

  /** \return the parameters, given or derived
   * \throws BadArgument, ComputeFailed as verify() */
  const ScanParameters&
  parameters();

  /** \throws BadArgument a cloud is not set, an origin is not finite, or the pose is no
   * rigid motion
   * \throws ComputeFailed a cloud has fewer than 3 points within the range gate, or is too
   * large for the voxels */
  PairVerdict
  verify(const Eigen::Isometry3d& T_target_source);

private:
  void
  prepare();

  std::optional<Cloud> source_, target_;
  ScanParameterOptions options_;
  std::optional<PreparedScans> prepared_; ///< the target, then the source
};

} // namespace pcl6d
