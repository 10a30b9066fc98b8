// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/registration/pcl/icp6d.h>
#include <pcl6d/registration/pcl/impl/icp6d_adapters.hpp>
#include <pcl6d/registration/pcl/transformation_estimation_quaternion.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>

#include <pcl/common/transforms.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace PCL6D_EXPORTS pcl6d {

/** The target as the core takes it; its coordinates are relative to origin, and so are
 * poses. Made once for many sources. */
template <typename PointSource, typename PointTarget, typename Scalar>
struct ICP6D<PointSource, PointTarget, Scalar>::Target {
  typename Base::KdTreePtr made_from;
  pcl::IndicesConstPtr searched;                    ///< of the tree; null: all
  pcl::Indices indices;                             ///< the same, spelt out
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< [m]
  Points points;
  std::shared_ptr<const PointTree> tree;
  SearchMemory memory = SearchMemory::kNeighbours;
  std::function<Neighbour(const Eigen::Vector3f&, float)> search;
  std::function<std::vector<Neighbour>(const Eigen::Vector3f&, std::size_t)> search_k;
  Normals normals; ///< if a metric needed them
  std::size_t normal_neighbours = 0;
};

/** What one run takes of both clouds. */
template <typename PointSource, typename PointTarget, typename Scalar>
struct ICP6D<PointSource, PointTarget, Scalar>::Sides {
  std::shared_ptr<const Target> target;
  Points source;
  Normals source_normals;
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

/** PCL's setters are not virtual and write members of the base; they are read here. */
template <typename PointSource, typename PointTarget, typename Scalar>
IcpOptions
ICP6D<PointSource, PointTarget, Scalar>::effectiveOptions() const
{
  IcpOptions options = options_;
  options.max_iterations = std::max(1, this->max_iterations_); // PCL tries at least one
  options.max_distance =
      std::max(this->corr_dist_threshold_, std::numeric_limits<double>::min());
  const double epsilon = this->transformation_epsilon_;
  if (epsilon > 0) {
    options.translation_epsilon = epsilon_is_squared_ ? std::sqrt(epsilon) : epsilon;
    if (epsilon_is_squared_)
      options.rotation_epsilon = portableAcos(std::max(-1.0, 1 - epsilon));
  }
  if (this->transformation_rotation_epsilon_ > 0)
    options.rotation_epsilon =
        portableAcos(std::min(1.0, this->transformation_rotation_epsilon_));
  if (this->euclidean_fitness_epsilon_ > 0)
    options.error_epsilon = std::min(this->euclidean_fitness_epsilon_, 0.999);
  if (registration::hasScale<PointSource, PointTarget, Scalar>(
          *this->transformation_estimation_))
    options.estimate_scale = true;
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

/** Makes the target for the core, unless it is made. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::makeTarget()
{
  if (registration::isOfOtherCoordinates<PointTarget>(*this->tree_)) // set by align()
    this->tree_->setInputCloud(this->tree_->getInputCloud(), this->tree_->getIndices());
  if (!this->tree_->getInputCloud()) // given by setSearchMethodTarget() without a cloud
    this->tree_->setInputCloud(this->target_);
  if (this->tree_->getInputCloud() != this->target_)
    throw BadArgument("ICP6D: the search method of the target was built from another "
                      "cloud than the target");
  const auto ours = std::dynamic_pointer_cast<KdTree<PointTarget>>(this->tree_);
  const pcl::IndicesConstPtr searched = this->tree_->getIndices();
  if (made_ && made_->made_from == this->tree_ && made_->searched == searched &&
      (!ours || made_->tree == ours->tree()))
    return;
  made_ = std::make_shared<Target>();
  made_->made_from = this->tree_;
  made_->searched = searched;
  made_->indices = searched ? *searched : registration::allOf(*this->target_);
  if (ours)
    made_->origin = ours->origin().template cast<double>();
  made_->points = toPoints(*this->target_, made_->indices);
  for (auto& p : made_->points)
    p -= made_->origin.template cast<float>();
  if (ours) {
    made_->tree = ours->tree();
    if (std::dynamic_pointer_cast<CachedKdTree<PointTarget>>(this->tree_))
      made_->memory = SearchMemory::kLeaves;
  }
  else {
    made_->search = registration::searchOf<PointTarget>(this->tree_);
    made_->search_k = registration::searchOfSeveral<PointTarget>(this->tree_);
  }
}

/** Adds the normals of the target, unless they are there. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::makeNormals(const IcpOptions& options)
{
  if (made_->normal_neighbours == normal_neighbours_)
    return;
  made_->normals = registration::normalsOf(*this->target_,
                                           made_->indices,
                                           made_->points,
                                           made_->tree.get(),
                                           normal_neighbours_,
                                           options);
  made_->normal_neighbours = normal_neighbours_;
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename ICP6D<PointSource, PointTarget, Scalar>::Sides
ICP6D<PointSource, PointTarget, Scalar>::sides(const IcpOptions& options)
{
  makeTarget();
  if (options.metric != Metric::kPoint)
    makeNormals(options);
  Sides sides;
  sides.target = made_;
  sides.source = toPoints(*this->input_, *this->indices_);
  if (options.metric == Metric::kGicp || options.symmetric)
    sides.source_normals = registration::normalsOf(*this->input_,
                                                   *this->indices_,
                                                   sides.source,
                                                   nullptr,
                                                   normal_neighbours_,
                                                   options);
  return sides;
}

/** Observers of each iteration: what PCL keeps of it, and the caller's. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::addObservers(IcpHooks& hooks,
                                                      const Eigen::Vector3d& origin)
{
  const auto in_target = [origin](const IcpIteration& centred) {
    IcpIteration seen = centred;
    seen.T_target_source.pretranslate(origin);
    return seen;
  };
  hooks.observer = [this, in_target](const IcpIteration& centred) {
    const IcpIteration seen = in_target(centred);
    Eigen::Affine3d now = seen.T_target_source;
    now.linear() *= seen.scale;
    last_step_ = now * last_pose_.inverse();
    last_pose_ = now;
    return !observer_ || observer_(seen);
  };
  if (this->update_visualizer_)
    hooks.pairs_observer = [this, in_target](const IcpIteration& centred,
                                             const std::vector<IcpPair>& pairs) {
      showPairs(in_target(centred), pairs);
    };
}

/** Calls PCL's visualisation callback as pcl::IterativeClosestPoint does: all chosen points
 * after the step, and the indices of both sides of the pairs. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::showPairs(const IcpIteration& seen,
                                                   const std::vector<IcpPair>& pairs)
{
  Eigen::Affine3d pose = seen.T_target_source;
  pose.linear() *= seen.scale;
  PointCloudSource moved;
  pcl::transformPointCloud(*this->input_, *this->indices_, moved, pose.matrix());
  pcl::Indices of_source, of_target;
  for (const auto& pair : pairs) {
    of_source.push_back(pair.source);
    of_target.push_back(made_->indices[pair.target]);
  }
  this->update_visualizer_(moved, of_source, *this->target_, of_target);
}

template <typename PointSource, typename PointTarget, typename Scalar>
IcpHooks
ICP6D<PointSource, PointTarget, Scalar>::hooks(const Sides& sides,
                                               const IcpOptions& options)
{
  using Adapter = registration::PclAdapter<PointSource, PointTarget, Scalar>;
  IcpHooks hooks;
  addObservers(hooks, sides.target->origin);
  const auto adapter = std::make_shared<Adapter>(
      this->input_, this->indices_, this->target_, this->tree_, sides.target->origin);
  if (this->correspondence_estimation_)
    hooks.find = adapter->finder(this->correspondence_estimation_, reciprocal_);
  else if (registration::isOfOtherCoordinates<PointTarget>(*this->tree_))
    hooks.find = adapter->finder(
        pcl::make_shared<pcl::registration::CorrespondenceEstimation<PointSource,
                                                                     PointTarget,
                                                                     Scalar>>(),
        reciprocal_);
  std::vector<registration::Rejector> rejectors;
  if (reciprocal_ && !hooks.find)
    rejectors.push_back(registration::reciprocal(
        sides.source, sides.target->points, options.num_threads));
  for (const auto& rejector : this->correspondence_rejectors_)
    rejectors.push_back(adapter->rejector(rejector));
  if (!rejectors.empty())
    hooks.reject = registration::inTurn(std::move(rejectors));
  if (!options.estimate_scale &&
      !registration::isOurs<PointSource, PointTarget, Scalar>(
          *this->transformation_estimation_))
    hooks.minimise = adapter->minimiser(this->transformation_estimation_);
  return hooks;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::computeTransformation(PointCloudSource& output,
                                                               const Matrix4& guess)
{
  result_ = IcpResult();
  if (has_stale_indices_ && this->indices_->empty())
    throw BadArgument(
        "ICP6D: the indices are those of an earlier source; the one that is "
        "set has fewer points");
  registration::requireGiven(this->transformation_estimation_,
                             "the transformation estimation");
  for (const auto& rejector : this->correspondence_rejectors_)
    registration::requireGiven(rejector, "a correspondence rejector");
  const IcpOptions options = effectiveOptions();
  options.validate();
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.matrix() = guess.template cast<double>();
  last_pose_ = start;
  last_step_ = Eigen::Affine3d::Identity();
  if (this->input_->empty() || this->target_->empty()) {
    IcpResult nothing;
    nothing.T_target_source = start;
    return store(nothing, Eigen::Vector3d::Zero(), output);
  }
  const Sides sides = this->sides(options);
  const Target& target = *sides.target;
  IcpTargetPart part;
  part.tree = target.tree.get();
  part.points = &target.points;
  part.normals = options.metric == Metric::kPoint ? nullptr : &target.normals;
  part.search = target.search;
  part.search_k = target.search_k;
  part.memory = target.memory;
  IcpSource source{&sides.source, nullptr};
  if (options.metric == Metric::kGicp || options.symmetric)
    source.normals = &sides.source_normals;
  start.pretranslate(-target.origin);
  store(icp({part}, source, start, options, hooks(sides, options)),
        target.origin,
        output);
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
  this->converged_ =
      result_.status == Status::kOk ||
      (iteration_limit_converges_ && result_.stop == IcpStop::kIterationLimit);
  this->nr_iterations_ = result_.iterations;
  Eigen::Affine3d scaled = result_.T_target_source;
  scaled.linear() *= result_.scale;
  this->final_transformation_ = scaled.matrix().template cast<Scalar>();
  this->transformation_ = last_step_.matrix().template cast<Scalar>();
  moveOutput(output);
}

/** Moves the chosen points; their normals are turned alone. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::moveOutput(PointCloudSource& output) const
{
  if (result_.scale != 1)
    for (auto& point : output)
      point.getVector3fMap() =
          (result_.scale * point.getVector3fMap().template cast<double>())
              .template cast<float>();
  const PointCloudSource chosen = output;
  const Eigen::Matrix4d T = result_.T_target_source.matrix(); // double, whatever Scalar
  if constexpr (pcl::traits::has_normal<PointSource>::value)
    pcl::transformPointCloudWithNormals(chosen, output, T);
  else
    pcl::transformPointCloud(chosen, output, T);
}

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/icp6d_setters.hpp>
