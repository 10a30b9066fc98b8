// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/registration/pcl/correspondence_estimation.h>
#include <pcl6d/registration/pcl/icp6d.h>
#include <pcl6d/registration/pcl/impl/icp6d_adapters.hpp>
#include <pcl6d/registration/pcl/transformation_estimation_quaternion.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>

#include <pcl/common/transforms.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace PCL6D_EXPORTS pcl6d {

/** The target in the form of the core; coordinates and poses are relative to origin.
 * Made once for many sources. */
template <typename PointSource, typename PointTarget, typename Scalar>
struct ICP6D<PointSource, PointTarget, Scalar>::Target {
  typename Base::KdTreePtr made_from;
  pcl::IndicesConstPtr searched;                    ///< of the tree; null: every point
  pcl::Indices indices;                             ///< `searched`, written out
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< [m]
  Points points;
  std::shared_ptr<const PointTree> tree;
  SearchMemory memory = SearchMemory::kNeighbours;
  std::function<Neighbour(const Eigen::Vector3f&, float)> search;
  std::function<std::vector<Neighbour>(const Eigen::Vector3f&, std::size_t)> search_k;
  Normals normals;                         ///< if needed by a metric
  std::optional<ScanNormals> normals_made; ///< settings of the normals;
                                           ///< empty: not yet made
};

/** Data of both clouds for one run. */
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
  criteria_ = pcl::make_shared<ConvergenceCriteria<Scalar>>(
      this->nr_iterations_, this->transformation_, *this->correspondences_);
}

/** Takes over the settings made through the convergence criteria. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::takeCriteria()
{
  if (criteria_->takeChanges(this->max_iterations_, this->euclidean_fitness_epsilon_))
    setMotionEpsilon(criteria_->translationEpsilon(), criteria_->rotationEpsilon());
}

template <typename PointSource, typename PointTarget, typename Scalar>
IcpOptions
ICP6D<PointSource, PointTarget, Scalar>::startRun()
{
  result_ = IcpResult();
  registration::requireGiven(this->transformation_estimation_,
                             "the transformation estimation");
  for (const auto& rejector : this->correspondence_rejectors_)
    registration::requireGiven(rejector, "a correspondence rejector");
  takeCriteria();
  IcpOptions options = effectiveOptions();
  criteria_->start(options);
  ended_by_criteria_ = false;
  options.validate();
  return options;
}

template <typename PointSource, typename PointTarget, typename Scalar>
Eigen::Isometry3d
ICP6D<PointSource, PointTarget, Scalar>::startPose(const Matrix4& guess)
{
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.matrix() = guess.template cast<double>();
  last_pose_ = start;
  last_step_ = Eigen::Affine3d::Identity();
  return start;
}

/** PCL's setters are not virtual and write members of the base, which are read here. */
template <typename PointSource, typename PointTarget, typename Scalar>
IcpOptions
ICP6D<PointSource, PointTarget, Scalar>::effectiveOptions() const
{
  IcpOptions options = options_;
  options.max_iterations = std::max(1, this->max_iterations_); // PCL does at least one
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

/** Makes the target for the core, if needed. */
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

/** Adds the normals of the target, if missing. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::makeNormals(const IcpOptions& options)
{
  if (made_->normals_made == normal_settings_)
    return;
  made_->normals =
      targetNormals(made_->indices, made_->points, made_->tree.get(), options);
  made_->normals_made = normal_settings_;
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
    sides.source_normals = sourceNormals(sides.source, options);
  return sides;
}

template <typename PointSource, typename PointTarget, typename Scalar>
Normals
ICP6D<PointSource, PointTarget, Scalar>::sourceNormals(const Points& points,
                                                       const IcpOptions& options) const
{
  return registration::normalsOf(
      *this->input_, *this->indices_, points, nullptr, normal_settings_, options);
}

template <typename PointSource, typename PointTarget, typename Scalar>
Normals
ICP6D<PointSource, PointTarget, Scalar>::targetNormals(const pcl::Indices& indices,
                                                       const Points& points,
                                                       const PointTree* tree,
                                                       const IcpOptions& options) const
{
  return registration::normalsOf(
      *this->target_, indices, points, tree, normal_settings_, options);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::forgetTargetNormals()
{
  if (made_)
    made_->normals_made.reset();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::computeTransformation(PointCloudSource& output,
                                                               const Matrix4& guess)
{
  if (has_stale_indices_ && this->indices_->empty())
    throw BadArgument(
        "ICP6D: the indices are those of an earlier source; the one that is "
        "set has fewer points");
  const IcpOptions options = startRun();
  Eigen::Isometry3d start = startPose(guess);
  if (this->input_->empty() || this->target_->empty()) {
    IcpResult nothing;
    nothing.T_target_source = start;
    keep(nothing, Eigen::Vector3d::Zero());
    return moveOutput(output);
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
  keep(icp({part}, source, start, options, hooks(sides, options)), target.origin);
  moveOutput(output);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::keep(const IcpResult& found,
                                              const Eigen::Vector3d& origin)
{
  result_ = found;
  criteria_->finish(result_, ended_by_criteria_);
  result_.T_target_source.pretranslate(origin);
  if (result_.localizability)
    result_.localizability->centroid += origin;
  this->converged_ = result_.status == Status::kOk ||
                     (!criteria_->getFailureAfterMaximumIterations() &&
                      result_.stop == IcpStop::kIterationLimit);
  this->nr_iterations_ = result_.iterations;
  Eigen::Affine3d scaled = result_.T_target_source;
  scaled.linear() *= result_.scale;
  this->final_transformation_ = scaled.matrix().template cast<Scalar>();
  this->transformation_ = last_step_.matrix().template cast<Scalar>();
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
#include <pcl6d/registration/pcl/impl/icp6d_hooks.hpp>
#include <pcl6d/registration/pcl/impl/icp6d_setters.hpp>
