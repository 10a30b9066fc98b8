// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/registration/pcl/coarse_registration.h>
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/common/transforms.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointSource, typename PointTarget, typename Scalar>
CoarseRegistration<PointSource, PointTarget, Scalar>::CoarseRegistration(
    const std::string& name)
{
  this->reg_name_ = name;
  this->tree_.reset(new KdTree<PointTarget>);
  unused_ = unused();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CoarseRegistration<PointSource, PointTarget, Scalar>::setInputSource(
    const typename Base::PointCloudSourceConstPtr& cloud)
{
  if (!cloud)
    throw BadArgument(this->reg_name_ + ": the input source is null");
  if (this->use_indices_ && this->indices_)
    requireIndices(*this->indices_, cloud->size()); // align() of PCL's class
                                                    // reads the indices
  this->source_cloud_updated_ = true;
  pcl::PCLBase<PointSource>::setInputCloud(cloud);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CoarseRegistration<PointSource, PointTarget, Scalar>::setInputTarget(
    const typename Base::PointCloudTargetConstPtr& cloud)
{
  if (!cloud)
    throw BadArgument(this->reg_name_ + ": the input target is null");
  this->target_ = cloud;
  this->target_cloud_updated_ = true;
}

/** \return the settings of PCL's setters that are not used here */
template <typename PointSource, typename PointTarget, typename Scalar>
typename CoarseRegistration<PointSource, PointTarget, Scalar>::Unused
CoarseRegistration<PointSource, PointTarget, Scalar>::unused() const
{
  return {this->max_iterations_,
          this->transformation_epsilon_,
          this->transformation_rotation_epsilon_,
          this->euclidean_fitness_epsilon_,
          this->corr_dist_threshold_};
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CoarseRegistration<PointSource, PointTarget, Scalar>::requireNoneSet() const
{
  if (!this->correspondence_rejectors_.empty() || this->correspondence_estimation_ ||
      this->transformation_estimation_)
    throw BadArgument(this->reg_name_ +
                      ": rejectors and estimations have no place in this search");
  if (unused() != unused_)
    throw BadArgument(this->reg_name_ +
                      ": there is no iteration over pairs that a maximum "
                      "of iterations or distance, or an epsilon, could end");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CoarseRegistration<PointSource, PointTarget, Scalar>::computeTransformation(
    PointCloudSource& output,
    const Matrix4& guess)
{
  result_ = CoarseEstimate();
  requireNoneSet();
  requireIndices(*this->indices_, this->input_->size());
  Points target = toPoints(*this->target_);
  Points source = toPoints(*this->input_, *this->indices_);
  const Eigen::Vector3f to =
      originOf(target, this->target_->sensor_origin_.template head<3>());
  const Eigen::Vector3f from =
      originOf(source, this->input_->sensor_origin_.template head<3>());
  for (auto& p : target)
    p -= to;
  for (auto& p : source)
    p -= from;
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.matrix() = guess.template cast<double>();
  Eigen::Isometry3d start_here = start;
  start_here.translate(from.template cast<double>());
  start_here.pretranslate(-to.template cast<double>());
  result_ = search(target, source, start_here);
  result_.T_target_source.translate(-from.template cast<double>());
  result_.T_target_source.pretranslate(to.template cast<double>());
  if (result_.status == Status::kTooFewPairs)
    result_.T_target_source = start;
  this->converged_ = result_.status == Status::kOk;
  const Eigen::Matrix4d T = result_.T_target_source.matrix(); // double, whatever Scalar
  this->final_transformation_ = T.template cast<Scalar>();
  const PointCloudSource chosen = output;
  if constexpr (pcl::traits::has_normal<PointSource>::value)
    pcl::transformPointCloudWithNormals(chosen, output, T);
  else
    pcl::transformPointCloud(chosen, output, T);
  if (this->update_visualizer_)
    this->update_visualizer_(output, {}, *this->target_, {});
}

} // namespace pcl6d
