// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require.h>
#include <pcl6d/verification/pcl/registration_verifier.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointSource, typename PointTarget>
void
RegistrationVerifier<PointSource, PointTarget>::setInputSource(
    const typename PointCloudSource::ConstPtr& cloud)
{
  require(cloud != nullptr, "input source", "null", "set");
  source_ = cloud;
  passSource();
}

template <typename PointSource, typename PointTarget>
void
RegistrationVerifier<PointSource, PointTarget>::setInputTarget(
    const typename PointCloudTarget::ConstPtr& cloud)
{
  require(cloud != nullptr, "input target", "null", "set");
  target_ = cloud;
  passTarget();
}

template <typename PointSource, typename PointTarget>
void
RegistrationVerifier<PointSource, PointTarget>::setSourceOrigin(
    const std::optional<Eigen::Vector3f>& origin)
{
  source_origin_ = origin;
  if (source_)
    passSource();
}

template <typename PointSource, typename PointTarget>
void
RegistrationVerifier<PointSource, PointTarget>::setTargetOrigin(
    const std::optional<Eigen::Vector3f>& origin)
{
  target_origin_ = origin;
  if (target_)
    passTarget();
}

template <typename PointSource, typename PointTarget>
void
RegistrationVerifier<PointSource, PointTarget>::passSource()
{
  const Eigen::Vector3f own = source_->sensor_origin_.template head<3>();
  core_.setSource({toPoints(*source_), source_origin_.value_or(own)});
}

template <typename PointSource, typename PointTarget>
void
RegistrationVerifier<PointSource, PointTarget>::passTarget()
{
  const Eigen::Vector3f own = target_->sensor_origin_.template head<3>();
  core_.setTarget({toPoints(*target_), target_origin_.value_or(own)});
}

template <typename PointSource, typename PointTarget>
PairVerdict
RegistrationVerifier<PointSource, PointTarget>::verify(
    const Eigen::Matrix4f& T_target_source)
{
  return verify(Eigen::Matrix4d(T_target_source.template cast<double>()));
}

template <typename PointSource, typename PointTarget>
PairVerdict
RegistrationVerifier<PointSource, PointTarget>::verify(
    const Eigen::Matrix4d& T_target_source)
{
  return core_.verify(Eigen::Isometry3d(T_target_source));
}

} // namespace pcl6d
