// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/registration/icp6d.h>
#include <pcl6d/registration/impl/icp6d_plugs.hpp>
#include <pcl6d/registration/transformation_estimation_quaternion.h>

#include <pcl/common/transforms.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d {

/** The two clouds as the core takes them. The target's coordinates are relative to origin;
 * so are poses. */
template <typename PointSource, typename PointTarget, typename Scalar>
struct ICP6D<PointSource, PointTarget, Scalar>::Sides {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< [m]
  Points source, target;
  Normals source_normals, target_normals;
  std::shared_ptr<const PointTree> tree;
  std::function<Neighbour(const Eigen::Vector3f&, float)> search;
};

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
  using ToPoints = SumsEstimation<PointSource, PointTarget, Scalar>;
  if (const auto estimation =
          std::dynamic_pointer_cast<const ToPoints>(this->transformation_estimation_))
    options.minimiser = [estimation](const PairSums& s) { return estimation->step(s); };
  if constexpr (pcl::traits::has_normal<PointTarget>::value) {
    using ToPlanes = PlaneEstimation<PointSource, PointTarget, Scalar>;
    const auto estimation =
        std::dynamic_pointer_cast<const ToPlanes>(this->transformation_estimation_);
    if (estimation) {
      options.plane_minimiser = [estimation](const PlaneSums& s) {
        return estimation->step(s);
      };
      if (options.metric == Metric::kPoint)
        options.metric = Metric::kPlane;
    }
  }
  return options;
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename ICP6D<PointSource, PointTarget, Scalar>::Sides
ICP6D<PointSource, PointTarget, Scalar>::sides(const IcpOptions& options)
{
  if (!this->tree_->getInputCloud()) // given by setSearchMethodTarget() without a cloud
    this->tree_->setInputCloud(this->target_);
  if (this->tree_->getInputCloud() != this->target_)
    throw BadArgument("ICP6D: the search method of the target was built from another "
                      "cloud than the target");
  Sides sides;
  const auto ours = std::dynamic_pointer_cast<KdTree<PointTarget>>(this->tree_);
  const pcl::IndicesConstPtr searched = this->tree_->getIndices();
  if (ours)
    sides.origin = ours->origin().template cast<double>();
  const pcl::Indices all = searched ? *searched : plugs::allOf(*this->target_);
  sides.target = toPoints(*this->target_, all);
  for (auto& p : sides.target)
    p -= sides.origin.template cast<float>();
  if (ours) {
    sides.tree = ours->tree();
  }
  else { // a tree of ours all the same, which judges how well the surfaces fix the pose
    sides.search = plugs::searchOf<PointTarget>(this->tree_);
    sides.tree = std::make_shared<PointTree>(sides.target, options.num_threads);
  }
  sides.source = toPoints(*this->input_, *this->indices_);
  if (options.metric != Metric::kPoint)
    sides.target_normals = plugs::normalsOf(*this->target_,
                                            all,
                                            sides.target,
                                            sides.tree.get(),
                                            normal_neighbours_,
                                            options);
  if (options.metric == Metric::kGicp)
    sides.source_normals = plugs::normalsOf(*this->input_,
                                            *this->indices_,
                                            sides.source,
                                            nullptr,
                                            normal_neighbours_,
                                            options);
  return sides;
}

template <typename PointSource, typename PointTarget, typename Scalar>
IcpHooks
ICP6D<PointSource, PointTarget, Scalar>::hooks(const Sides& sides)
{
  using Plugs = plugs::PclPlugs<PointSource, PointTarget, Scalar>;
  IcpHooks hooks;
  if (observer_)
    hooks.observer = [this, &sides](const IcpIteration& centred) {
      IcpIteration seen = centred;
      seen.T_target_source.pretranslate(sides.origin);
      return observer_(seen);
    };
  const auto plugged = std::make_shared<Plugs>(
      this->input_, this->indices_, this->target_, this->tree_, sides.origin);
  if (this->correspondence_estimation_)
    hooks.find = plugged->finder(this->correspondence_estimation_, reciprocal_);
  std::vector<plugs::Rejector> rejectors;
  if (reciprocal_ && !this->correspondence_estimation_)
    rejectors.push_back(plugs::reciprocal(sides.source, sides.target));
  for (const auto& rejector : this->correspondence_rejectors_)
    rejectors.push_back(plugged->rejector(rejector));
  if (!rejectors.empty())
    hooks.reject = plugs::inTurn(std::move(rejectors));
  if (!plugs::isOurs<PointSource, PointTarget, Scalar>(
          *this->transformation_estimation_))
    hooks.minimise = plugged->minimiser(this->transformation_estimation_);
  return hooks;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::computeTransformation(PointCloudSource& output,
                                                               const Matrix4& guess)
{
  const IcpOptions options = effectiveOptions();
  const Sides sides = this->sides(options);
  IcpTargetPart part;
  part.tree = sides.tree.get();
  part.points = &sides.target;
  part.normals = options.metric == Metric::kPoint ? nullptr : &sides.target_normals;
  part.search = sides.search;
  IcpSource source{&sides.source, nullptr};
  if (options.metric == Metric::kGicp)
    source.normals = &sides.source_normals;
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.matrix() = guess.template cast<double>();
  start.pretranslate(-sides.origin);
  store(icp({part}, source, start, options, hooks(sides)), sides.origin, output);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::store(const IcpResult& found,
                                               const Eigen::Vector3d& origin,
                                               PointCloudSource& output)
{
  result_ = found;
  result_.T_target_source.pretranslate(origin);
  if (result_.localizability)
    result_.localizability->centroid += origin;
  this->converged_ = result_.status == Status::kOk;
  this->nr_iterations_ = result_.iterations;
  this->final_transformation_ =
      result_.T_target_source.matrix().template cast<Scalar>();
  this->transformation_ = this->final_transformation_;
  const PointCloudSource chosen = output;
  const Eigen::Matrix4d T = result_.T_target_source.matrix(); // double, whatever Scalar
  if constexpr (pcl::traits::has_normal<PointSource>::value)
    pcl::transformPointCloudWithNormals(chosen, output, T);
  else
    pcl::transformPointCloud(chosen, output, T);
}

} // namespace pcl6d
