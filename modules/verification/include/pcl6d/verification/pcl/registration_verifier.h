// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/verification/pair_verifier.h>

#include <pcl/memory.h>
#include <pcl/point_cloud.h>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Whether the result of a registration is to be believed, for any
 * pcl::Registration: neither its fitness nor hasConverged() tells a right pose from a wrong
 * one that fits as well.
 *
 * Points of each scan that stand where the rays of the other went through contradict the
 * pose, and so do surfaces that ask for another place. Clouds must be scans: unreduced, in
 * one piece, seen from one place. That place is the cloud's sensor_origin_ in its own
 * coordinates, as pcl::NormalEstimation takes it; what a VIEWPOINT of a PCD file is by PCL6D
 * (the pose of the scan in the world) is no such place: call setSourceOrigin() and
 * setTargetOrigin() with 0 after reading one.
 * \code
 * icp.align(aligned);
 * pcl6d::RegistrationVerifier<Point, Point> verifier;
 * verifier.setInputSource(source);
 * verifier.setInputTarget(target);
 * const pcl6d::PairVerdict verdict = verifier.verify(icp.getFinalTransformation());
 * if (verdict.opinion.trust != pcl6d::LinkTrust::kGood)
 *   std::cerr << verdict.opinion.reason << '\n';
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

  /** \brief The cloud that was moved; copied. \throws BadArgument it is null */
  void
  setInputSource(const typename PointCloudSource::ConstPtr& cloud);

  /** \brief The cloud that stayed; copied. \throws BadArgument it is null */
  void
  setInputTarget(const typename PointCloudTarget::ConstPtr& cloud);

  /** \brief Where the scanner stood in the source [m]; none: its sensor_origin_. */
  void
  setSourceOrigin(const std::optional<Eigen::Vector3f>& origin);

  /** \brief Where the scanner stood in the target [m]; none: its sensor_origin_. */
  void
  setTargetOrigin(const std::optional<Eigen::Vector3f>& origin);

  /** \brief Range gate and reduction; what is left open is derived from both clouds.
   * \throws BadArgument naming the value that breaks its rule */
  void
  setParameters(const ScanParameterOptions& options)
  {
    core_.setParameters(options);
  }

  /** \brief The same as they are used. \throws BadArgument, ComputeFailed as verify() */
  const ScanParameters&
  parameters()
  {
    return core_.parameters();
  }

  /** \brief Judges a pose; several of the same clouds take the time of one.
   * \param[in] T_target_source as getFinalTransformation() gives it
   * \throws BadArgument a cloud is not set, its origin is not finite, or the pose is no
   * rigid motion
   * \throws ComputeFailed a cloud has fewer than 3 points within the range gate, or is too
   * large for the voxels */
  PairVerdict
  verify(const Eigen::Matrix4f& T_target_source);

  /** \brief The same of a pose in double. */
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
