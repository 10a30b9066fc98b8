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

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setInputSource(
    const typename Base::PointCloudSourceConstPtr& cloud)
{
  registration::requireGiven(cloud, "the input source");
  if (this->use_indices_ && this->indices_)
    requireIndices(*this->indices_, cloud->size());
  this->source_cloud_updated_ = true;
  pcl::PCLBase<PointSource>::setInputCloud(cloud);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setInputTarget(
    const typename Base::PointCloudTargetConstPtr& cloud)
{
  registration::requireGiven(cloud, "the input target");
  this->target_ = cloud;
  this->target_cloud_updated_ = true;
  made_.reset();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setIndices(const pcl::IndicesPtr& indices)
{
  registration::requireGiven(indices, "the indices");
  if (this->input_)
    requireIndices(*indices, this->input_->size());
  Base::setIndices(indices);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setIndices(const pcl::IndicesConstPtr& indices)
{
  registration::requireGiven(indices, "the indices");
  if (this->input_)
    requireIndices(*indices, this->input_->size());
  Base::setIndices(indices);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setIndices(
    const typename Base::PointIndicesConstPtr& indices)
{
  registration::requireGiven(indices, "the indices");
  if (this->input_)
    requireIndices(indices->indices, this->input_->size());
  Base::setIndices(indices);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setSearchMethodTarget(
    const typename Base::KdTreePtr& tree,
    bool force_no_recompute)
{
  registration::requireGiven(tree, "the search method");
  Base::setSearchMethodTarget(tree, force_no_recompute);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setTransformationEstimation(
    const typename Base::TransformationEstimationPtr& estimation)
{
  registration::requireGiven(estimation, "the transformation estimation");
  Base::setTransformationEstimation(estimation);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::addCorrespondenceRejector(
    const typename Base::CorrespondenceRejectorPtr& rejector)
{
  registration::requireGiven(rejector, "the correspondence rejector");
  Base::addCorrespondenceRejector(rejector);
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

/** Makes the target for the core, unless it is made. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::makeTarget(const IcpOptions& options)
{
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
  else { // a tree of ours all the same, which judges how well the surfaces fix the pose
    made_->search = registration::searchOf<PointTarget>(this->tree_);
    made_->tree = std::make_shared<PointTree>(made_->points, options.num_threads);
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
  makeTarget(options);
  if (options.metric != Metric::kPoint)
    makeNormals(options);
  Sides sides;
  sides.target = made_;
  sides.source = toPoints(*this->input_, *this->indices_);
  if (options.metric == Metric::kGicp)
    sides.source_normals = registration::normalsOf(*this->input_,
                                                   *this->indices_,
                                                   sides.source,
                                                   nullptr,
                                                   normal_neighbours_,
                                                   options);
  return sides;
}

template <typename PointSource, typename PointTarget, typename Scalar>
IcpHooks
ICP6D<PointSource, PointTarget, Scalar>::hooks(const Sides& sides,
                                               const IcpOptions& options)
{
  using Adapter = registration::PclAdapter<PointSource, PointTarget, Scalar>;
  IcpHooks hooks;
  if (observer_)
    hooks.observer = [this, &sides](const IcpIteration& centred) {
      IcpIteration seen = centred;
      seen.T_target_source.pretranslate(sides.target->origin);
      return observer_(seen);
    };
  const auto adapter = std::make_shared<Adapter>(
      this->input_, this->indices_, this->target_, this->tree_, sides.target->origin);
  if (this->correspondence_estimation_)
    hooks.find = adapter->finder(this->correspondence_estimation_, reciprocal_);
  std::vector<registration::Rejector> rejectors;
  if (reciprocal_ && !this->correspondence_estimation_)
    rejectors.push_back(registration::reciprocal(
        sides.source, sides.target->points, options.num_threads));
  for (const auto& rejector : this->correspondence_rejectors_)
    rejectors.push_back(adapter->rejector(rejector));
  if (!rejectors.empty())
    hooks.reject = registration::inTurn(std::move(rejectors));
  if (!registration::isOurs<PointSource, PointTarget, Scalar>(
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
  registration::requireGiven(this->transformation_estimation_,
                             "the transformation estimation");
  for (const auto& rejector : this->correspondence_rejectors_)
    registration::requireGiven(rejector, "a correspondence rejector");
  const IcpOptions options = effectiveOptions();
  options.validate();
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.matrix() = guess.template cast<double>();
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
  part.memory = target.memory;
  IcpSource source{&sides.source, nullptr};
  if (options.metric == Metric::kGicp)
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
  this->converged_ = result_.status == Status::kOk;
  this->nr_iterations_ = result_.iterations;
  Eigen::Affine3d scaled = result_.T_target_source;
  scaled.linear() *= result_.scale;
  this->final_transformation_ = scaled.matrix().template cast<Scalar>();
  this->transformation_ = this->final_transformation_;
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
