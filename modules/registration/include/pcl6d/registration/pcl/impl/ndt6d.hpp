// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/registration/pcl/ndt6d.h>

#include <pcl/common/transforms.h>

#include <algorithm>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointSource, typename PointTarget, typename Scalar>
NDT6D<PointSource, PointTarget, Scalar>::NDT6D()
{
  this->reg_name_ = "NDT6D";
  this->max_iterations_ = options_.max_iterations;
  this->transformation_epsilon_ = options_.translation_epsilon;
  this->tree_.reset(new KdTree<PointTarget>);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
NDT6D<PointSource, PointTarget, Scalar>::setInputSource(
    const typename Base::PointCloudSourceConstPtr& cloud)
{
  if (!cloud)
    throw BadArgument("NDT6D: the input source is null");
  this->source_cloud_updated_ = true;
  pcl::PCLBase<PointSource>::setInputCloud(cloud);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
NDT6D<PointSource, PointTarget, Scalar>::setInputTarget(
    const typename Base::PointCloudTargetConstPtr& cloud)
{
  if (!cloud)
    throw BadArgument("NDT6D: the input target is null");
  this->target_ = cloud;
  this->target_cloud_updated_ = true;
  grid_.reset();
}

template <typename PointSource, typename PointTarget, typename Scalar>
NdtOptions
NDT6D<PointSource, PointTarget, Scalar>::effectiveOptions() const
{
  NdtOptions options = options_;
  options.max_iterations = std::max(1, this->max_iterations_);
  options.translation_epsilon = std::max(0.0, this->transformation_epsilon_);
  options.rotation_epsilon = options.translation_epsilon;
  if (this->transformation_rotation_epsilon_ > 0)
    options.rotation_epsilon =
        portableAcos(std::min(1.0, this->transformation_rotation_epsilon_));
  return options;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
NDT6D<PointSource, PointTarget, Scalar>::computeTransformation(PointCloudSource& output,
                                                               const Matrix4& guess)
{
  result_ = NdtResult();
  const NdtOptions options = effectiveOptions();
  options.validate();
  if (!grid_) {
    Points points = toPoints(*this->target_);
    const Eigen::Vector3f origin = localOrigin(points);
    for (auto& p : points)
      p -= origin;
    origin_ = origin.template cast<double>();
    grid_ = std::make_shared<DistributionGrid>(
        points, resolution_, least_points_, line_growth_);
  }
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.matrix() = guess.template cast<double>();
  start.pretranslate(-origin_);
  result_ = ndt(*grid_, toPoints(*this->input_, *this->indices_), start, options);
  result_.T_target_source.pretranslate(origin_);
  result_.last_step.pretranslate(origin_);
  result_.last_step.translate(-origin_);
  result_.localizability.centroid += origin_;
  this->converged_ =
      result_.status == Status::kOk ||
      (iteration_limit_converges_ && result_.stop == IcpStop::kIterationLimit);
  this->nr_iterations_ = result_.iterations;
  const Eigen::Matrix4d T = result_.T_target_source.matrix();
  this->final_transformation_ = T.template cast<Scalar>();
  this->transformation_ = result_.last_step.matrix().template cast<Scalar>();
  const PointCloudSource chosen = output;
  if constexpr (pcl::traits::has_normal<PointSource>::value)
    pcl::transformPointCloudWithNormals(chosen, output, T);
  else
    pcl::transformPointCloud(chosen, output, T);
}

} // namespace pcl6d
