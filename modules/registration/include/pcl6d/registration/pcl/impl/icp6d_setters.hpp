// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/registration/pcl/icp6d.h>
#include <pcl6d/registration/pcl/impl/icp6d_adapters.hpp>

#include <pcl/types.h>

#include <memory>
#include <utility>

/** \file
 * The setters of ICP6D that check their arguments. */
namespace PCL6D_EXPORTS pcl6d {

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setInputSource(
    const typename Base::PointCloudSourceConstPtr& cloud)
{
  registration::requireGiven(cloud, "the input source");
  // align() of the base class reads the points of the indices without looking.
  if (this->use_indices_ && this->indices_ &&
      !areIndices(*this->indices_, cloud->size())) {
    this->indices_ = pcl::make_shared<pcl::Indices>();
    has_stale_indices_ = true;
  }
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
  has_stale_indices_ = false;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
ICP6D<PointSource, PointTarget, Scalar>::setIndices(const pcl::IndicesConstPtr& indices)
{
  registration::requireGiven(indices, "the indices");
  if (this->input_)
    requireIndices(*indices, this->input_->size());
  Base::setIndices(indices);
  has_stale_indices_ = false;
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
  has_stale_indices_ = false;
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
typename pcl::registration::DefaultConvergenceCriteria<Scalar>::Ptr
ICP6D<PointSource, PointTarget, Scalar>::getConvergeCriteria()
{
  takeCriteria();
  if (this->transformation_estimation_) // null through PCL's base class:
                                        // align() reports it
    criteria_->show(effectiveOptions());
  return criteria_;
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

} // namespace pcl6d
