// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/registration/icp6d.h>
#include <pcl6d/registration/transformation_estimation_quaternion.h>

#include <pcl/common/transforms.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d {

template <typename PointSource, typename PointTarget, typename Scalar>
ICP6D<PointSource, PointTarget, Scalar>::ICP6D()
{
  this->reg_name_ = "ICP6D";
  this->max_iterations_ = options_.max_iterations;
  this->tree_.reset(new KdTree<PointTarget>);
  this->transformation_estimation_.reset(
      new TransformationEstimationQuaternion<PointSource, PointTarget, Scalar>);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setMaxCorrespondenceDistanceStart(
    double distance)
{
  options_.max_distance_start = distance;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setMotionEpsilon(double translation,
                                                          double rotation)
{
  options_.translation_epsilon = translation;
  options_.rotation_epsilon = rotation;
  this->transformation_epsilon_ = 0; // the last setter wins
  this->transformation_rotation_epsilon_ = 0;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setNumberOfThreads(unsigned int num_threads)
{
  options_.num_threads = num_threads;
  if (const auto tree = std::dynamic_pointer_cast<KdTree<PointTarget>>(this->tree_))
    tree->setNumberOfThreads(num_threads);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setObserver(IcpObserver observer)
{
  observer_ = std::move(observer);
}

/** PCL's setters are not virtual and write members of the base; they are read here. */
template <typename PointSource, typename PointTarget, typename Scalar>
IcpOptions
ICP6D<PointSource, PointTarget, Scalar>::effectiveOptions() const
{
  IcpOptions options = options_;
  options.max_iterations = this->max_iterations_;
  options.max_distance = this->corr_dist_threshold_;
  if (this->transformation_epsilon_ > 0)
    options.translation_epsilon = std::sqrt(this->transformation_epsilon_);
  if (this->transformation_rotation_epsilon_ > 0)
    options.rotation_epsilon =
        portableAcos(std::min(1.0, this->transformation_rotation_epsilon_));
  return options;
}

template <typename PointSource, typename PointTarget, typename Scalar>
RigidMinimiser
ICP6D<PointSource, PointTarget, Scalar>::minimiser() const
{
  using PointToPoint = SumsEstimation<PointSource, PointTarget, Scalar>;
  const auto estimation =
      std::dynamic_pointer_cast<const PointToPoint>(this->transformation_estimation_);
  if (!estimation)
    throw BadArgument("ICP6D: the transformation estimation must be one of pcl6d's "
                      "point to point, such as TransformationEstimationQuaternion");
  return [estimation](const PairSums& sums) { return estimation->step(sums); };
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::computeTransformation(PointCloudSource& output,
                                                               const Matrix4& guess)
{
  const auto tree = std::dynamic_pointer_cast<KdTree<PointTarget>>(this->tree_);
  if (!tree)
    throw BadArgument("ICP6D: the search method of the target must be a pcl6d::KdTree");
  if (!this->correspondence_rejectors_.empty())
    throw BadArgument("ICP6D: correspondence rejectors are not supported");
  if (this->correspondence_estimation_)
    throw BadArgument("ICP6D: a correspondence estimation is not supported");
  if (!tree->tree()) // given by setSearchMethodTarget() without a cloud
    tree->setInputCloud(this->target_);
  if (tree->getInputCloud() != this->target_)
    throw BadArgument("ICP6D: the search method of the target was built from another "
                      "cloud than the target");
  const auto searched = tree->getIndices();
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.matrix() = guess.template cast<double>();

  result_ =
      icp(*tree->tree(),
          searched ? toPoints(*this->target_, *searched) : toPoints(*this->target_),
          toPoints(*this->input_, *this->indices_),
          start,
          effectiveOptions(),
          minimiser(),
          observer_);
  this->converged_ = result_.status == Status::kOk;
  this->nr_iterations_ = result_.iterations;
  this->final_transformation_ =
      result_.T_target_source.matrix().template cast<Scalar>();
  this->transformation_ = this->final_transformation_;
  const PointCloudSource chosen = output;
  if constexpr (pcl::traits::has_normal<PointSource>::value)
    pcl::transformPointCloudWithNormals(chosen, output, this->final_transformation_);
  else
    pcl::transformPointCloud(chosen, output, this->final_transformation_);
}

} // namespace pcl6d
