// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/verification/pair_verifier.h>

#include <pcl/memory.h>
#include <pcl/point_cloud.h>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Verifies the result of a registration, for any pcl::Registration: neither its fitness nor
 * hasConverged() distinguishes a right pose from a wrong pose that fits as well.
 *
 * The pose is contradicted by points of each scan that are crossed by rays of the other, and by
 * surfaces that require a shift. Clouds must be scans: unreduced, complete, and seen from one
 * position. This position is the cloud's sensor_origin_ in its own coordinates, as in
 * pcl::NormalEstimation. The VIEWPOINT in PCD files of PCL6D is a different quantity, the pose of
 * the scan in the world: call setSourceOrigin() and setTargetOrigin() with 0 after reading such a
 * file.
 * \code
 * icp.align(aligned);
 * pcl6d::RegistrationVerifier<Point, Point> verifier;
 * verifier.setInputSource(source);
 * verifier.setInputTarget(target);
 * const pcl6d::PairVerdict verdict = verifier.verify(icp.getFinalTransformation());
 * if (verdict.test_result.trust != pcl6d::LinkTrust::kGood)
 *   std::cerr << verdict.test_result.rejection << '\n';
 * \endcode
 * \note Source: share/doc/trust.md \ingroup verification */
template <typename PointSource, typename PointTarget = PointSource>
class RegistrationVerifier {
public:
  using Ptr = pcl::shared_ptr<RegistrationVerifier<PointSource, PointTarget>>;
  using ConstPtr =
      pcl::shared_ptr<const RegistrationVerifier<PointSource, PointTarget>>;
  using PointCloudSource = pcl::PointCloud<PointSource>;
  using PointCloudTarget = pcl::PointCloud<PointTarget>;

  /** \brief The moved cloud; copied. \throws BadArgument the cloud is null */
  void
  setInputSource(const typename PointCloudSource::ConstPtr& cloud);

  /** \brief The fixed cloud; copied. \throws BadArgument the cloud is null */
  void
  setInputTarget(const typename PointCloudTarget::ConstPtr& cloud);

  /** \brief Position of the scanner in the source [m]; none: sensor_origin_ of the cloud. */
  void
  setSourceOrigin(const std::optional<Eigen::Vector3f>& origin);

  /** \brief Position of the scanner in the target [m]; none: sensor_origin_ of the cloud. */
  void
  setTargetOrigin(const std::optional<Eigen::Vector3f>& origin);

  /** \brief Range gate and reduction; empty options are derived from both clouds.
   * \throws BadArgument naming the invalid value */
  void
  setParameters(const ScanParameterOptions& options)
  {
    core_.setParameters(options);
  }

  /** \brief The parameters in use. \throws BadArgument, ComputeFailed as verify() */
  const ScanParameters&
  parameters()
  {
    return core_.parameters();
  }

  /** \brief Verifies a pose; clouds are prepared only once for several poses.
   * \param[in] T_target_source e.g. from getFinalTransformation()
   * \throws BadArgument a cloud is not set, its origin is not finite, or the pose is no rigid
   * motion
   * \throws ComputeFailed a cloud has fewer than 3 points within the range gate, or is too large
   * for the voxels */
  PairVerdict
  verify(const Eigen::Matrix4f& T_target_source);

  /** \brief Verifies a pose in double precision. */
  PairVerdict
  verify(const Eigen::Matrix4d& T_target_source);

private:
  void
  passSource();
  void
  passTarget();

  PairVerifier core_;
  typename PointCloudSource::ConstPtr source_;
  typename PointCloudTarget::ConstPtr target_;
  std::optional<Eigen::Vector3f> source_origin_, target_origin_;
};

} // namespace pcl6d
#include <pcl6d/verification/pcl/impl/registration_verifier.hpp>
namespace PCL6D_EXPORTS pcl6d {
#define PCL6D_DECLARE_VERIFIER_(Class, PointT)                                         \
  extern template class Class<PointT, PointT>;
PCL6D_FOR_POINT_TYPES(PCL6D_DECLARE_VERIFIER_, RegistrationVerifier)
#undef PCL6D_DECLARE_VERIFIER_
} // namespace pcl6d
