// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/correspondence_estimation.h>
#include <pcl6d/registration/pcl/icp6d.h>
#include <pcl6d/registration/pcl/impl/icp6d_adapters.hpp>

#include <pcl/common/transforms.h>

#include <utility>

/** \file
 * Hooks of ICP6D into the iteration: observers, and plugged-in PCL classes. */
namespace PCL6D_EXPORTS pcl6d {

/** Observers of each iteration: the state kept by PCL, and the caller's observer. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::addObservers(IcpHooks& hooks,
                                                      const Eigen::Vector3d& origin,
                                                      const Shown& shown)
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
    const bool ends = criteria_->endsAt(seen);
    if (observer_ && !observer_(seen))
      return false;
    ended_by_criteria_ = ends;
    return !ends;
  };
  if (this->update_visualizer_)
    hooks.pairs_observer = [this, in_target, shown](const IcpIteration& centred,
                                                    const std::vector<IcpPair>& pairs) {
      showPairs(in_target(centred), pairs, shown);
    };
}

/** Calls PCL's visualisation callback with the arguments of pcl::IterativeClosestPoint: the chosen
 * points after the step, and the indices of both sides of the pairs. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::showPairs(const IcpIteration& seen,
                                                   const std::vector<IcpPair>& pairs,
                                                   const Shown& shown)
{
  Eigen::Affine3d pose = seen.T_target_source;
  pose.linear() *= seen.scale;
  PointCloudSource moved;
  pcl::transformPointCloud(*shown.source, *shown.chosen, moved, pose.matrix());
  pcl::Indices of_source, of_target;
  for (const auto& pair : pairs) {
    of_source.push_back(pair.source);
    of_target.push_back((*shown.searched)[pair.target]);
  }
  this->update_visualizer_(moved, of_source, *shown.target, of_target);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::plugIn(const std::shared_ptr<Adapter>& adapter,
                                                Rejectors rejectors,
                                                const IcpOptions& options,
                                                IcpHooks& hooks)
{
  for (const auto& rejector : this->correspondence_rejectors_)
    rejectors.push_back(adapter->rejector(rejector));
  if (!rejectors.empty())
    hooks.reject = registration::inTurn(std::move(rejectors));
  if (!options.estimate_scale &&
      !registration::isOurs<PointSource, PointTarget, Scalar>(
          *this->transformation_estimation_))
    hooks.minimise = adapter->minimiser(this->transformation_estimation_);
}

template <typename PointSource, typename PointTarget, typename Scalar>
IcpHooks
ICP6D<PointSource, PointTarget, Scalar>::hooks(const Sides& sides,
                                               const IcpOptions& options)
{
  IcpHooks hooks;
  addObservers(
      hooks,
      sides.target->origin,
      {&*this->input_, &*this->indices_, &*this->target_, &sides.target->indices});
  const auto adapter = std::make_shared<Adapter>(
      this->input_, this->indices_, this->target_, this->tree_, sides.target->origin);
  if (this->correspondence_estimation_)
    hooks.find = adapter->finder(this->correspondence_estimation_, reciprocal_);
  else if (registration::isOfOtherCoordinates<PointTarget>(*this->tree_))
    hooks.find = adapter->finder(
        pcl::make_shared<CorrespondenceEstimation<PointSource, PointTarget, Scalar>>(),
        reciprocal_);
  Rejectors rejectors;
  if (reciprocal_ && !hooks.find)
    rejectors.push_back(registration::reciprocal(
        sides.source, sides.target->points, options.num_threads));
  plugIn(adapter, std::move(rejectors), options, hooks);
  addStep(sides, options, hooks);
  return hooks;
}

} // namespace pcl6d
