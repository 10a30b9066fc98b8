// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/registration/pcl/correspondence_estimation.h>

#include <pcl/common/point_tests.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {
namespace registration {

/** \return whether a search uses coordinates other than x, y, z */
template <typename PointT>
bool
isOfOtherCoordinates(const pcl::search::KdTree<PointT>& tree)
{
  const auto representation = tree.getPointRepresentation();
  return representation &&
         (!representation->isTrivial() || representation->getNumberOfDimensions() != 3);
}

/** \return the limit [m^2] for a core that includes the square of a distance [m] */
float
limitThatIncludes(double max_distance);

/** \brief Finds the closest point to each query, nearer than a limit; in parallel.
 * \param[in] points the points of the tree
 * \param[in,out] found per query; before: likely neighbours, or empty, for speed only */
void
findClosest(const PointTree& tree,
            const Points& points,
            const Points& queries,
            float limit_sq,
            unsigned int num_threads,
            std::vector<Neighbour>& found);

/** \return the tree, if it is a pcl6d::KdTree over x, y, z; else null */
template <typename PointT>
std::shared_ptr<KdTree<PointT>>
ourTree(const typename pcl::search::KdTree<PointT>::Ptr& tree)
{
  const auto ours = std::dynamic_pointer_cast<KdTree<PointT>>(tree);
  return ours && !isOfOtherCoordinates<PointT>(*tree) ? ours : nullptr;
}

/** \return the points in the local coordinates of a pcl6d tree
 * \param[in] indices null: every point */
template <typename PointT, typename Tree>
Points
localPoints(const pcl::PointCloud<PointT>& cloud,
            const pcl::Indices* indices,
            const Tree& tree)
{
  Points points = indices ? toPoints(cloud, *indices) : toPoints(cloud);
  for (auto& p : points)
    p -= tree.origin();
  return points;
}

/** \return the closest searched point to each query by a pcl6d::KdTree, with
 * indices of the cloud */
template <typename PointT>
std::vector<Neighbour>
closestByOurs(const KdTree<PointT>& tree,
              const Points& queries,
              float limit_sq,
              unsigned int num_threads)
{
  const auto cloud = tree.getInputCloud();
  const auto searched = tree.getIndices();
  std::vector<Neighbour> found;
  findClosest(*tree.tree(),
              localPoints(*cloud, searched.get(), tree),
              queries,
              limit_sq,
              num_threads,
              found);
  if (searched)
    for (auto& neighbour : found)
      if (neighbour.index >= 0)
        neighbour.index = (*searched)[neighbour.index];
  return found;
}

/** \return whether a search has a point to find: PCL's trees are not to be asked otherwise */
template <typename PointT>
bool
hasFinitePoint(const pcl::search::KdTree<PointT>& tree)
{
  const auto cloud = tree.getInputCloud();
  const auto indices = tree.getIndices();
  const auto is_finite = [](const PointT& point) { return pcl::isXYZFinite(point); };
  if (!cloud)
    return false;
  if (!indices)
    return std::any_of(cloud->begin(), cloud->end(), is_finite);
  return std::any_of(indices->begin(), indices->end(), [&](auto index) {
    return is_finite((*cloud)[index]);
  });
}

/** \return the closest point by any tree of PCL's interface; index -1: not found
 * \param[in] limit [m^2], included */
template <typename PointT>
Neighbour
closestByAny(const pcl::search::KdTree<PointT>& tree, const PointT& query, double limit)
{
  const auto representation = tree.getPointRepresentation();
  if (!pcl::isXYZFinite(query) || (representation && !representation->isValid(query)))
    return {};
  pcl::Indices index(1, -1);
  std::vector<float> distance_sq(1);
  if (tree.nearestKSearch(query, 1, index, distance_sq) < 1 ||
      static_cast<double>(distance_sq[0]) > limit)
    return {};
  return {index[0], distance_sq[0]};
}

} // namespace registration

template <typename PointSource, typename PointTarget, typename Scalar>
CorrespondenceEstimation<PointSource, PointTarget, Scalar>::CorrespondenceEstimation()
{
  this->corr_name_ = "CorrespondenceEstimation";
  this->tree_ = pcl::make_shared<KdTree<PointTarget>>();
  this->tree_reciprocal_ = pcl::make_shared<KdTree<PointSource>>();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CorrespondenceEstimation<PointSource, PointTarget, Scalar>::setInputSource(
    const typename Base::PointCloudSourceConstPtr& cloud)
{
  if (!cloud)
    throw BadArgument("CorrespondenceEstimation: the input source is null");
  Base::setInputSource(cloud);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CorrespondenceEstimation<PointSource, PointTarget, Scalar>::setInputTarget(
    const typename Base::PointCloudTargetConstPtr& cloud)
{
  if (!cloud)
    throw BadArgument("CorrespondenceEstimation: the input target is null");
  this->target_ = cloud;
  this->target_cloud_updated_ = true;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CorrespondenceEstimation<PointSource, PointTarget, Scalar>::prepare(double max_distance)
{
  require(max_distance >= 0, "max_distance", max_distance, ">= 0");
  if (!this->input_ || !this->target_)
    throw BadArgument(std::string("CorrespondenceEstimation: no input ") +
                      (this->input_ ? "target" : "source") + " is set");
  if (!this->tree_)
    throw BadArgument("CorrespondenceEstimation: the search method is null");
  pcl::PCLBase<PointSource>::initCompute();
  requireIndices(*this->indices_, this->input_->size());
  prepareTarget();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CorrespondenceEstimation<PointSource, PointTarget, Scalar>::prepareTarget()
{
  auto& tree = *this->tree_;
  const bool is_other = tree.getInputCloud() != this->target_;
  if (this->force_no_recompute_ && tree.getInputCloud()) {
    if (is_other)
      throw BadArgument("CorrespondenceEstimation: the search method of the target, "
                        "which is not to be rebuilt, is that of another cloud");
    return;
  }
  const pcl::Indices searched =
      this->target_indices_ ? *this->target_indices_ : pcl::Indices();
  requireIndices(searched, this->target_->size());
  if (!this->target_cloud_updated_ && !is_other &&
      tree.getIndices() == this->target_indices_ && searched == searched_target_ &&
      used_representation_ == this->point_representation_)
    return;
  if (this->point_representation_)
    tree.setPointRepresentation(this->point_representation_);
  if (const auto ours = std::dynamic_pointer_cast<KdTree<PointTarget>>(this->tree_))
    ours->setNumberOfThreads(num_threads_);
  tree.setInputCloud(this->target_, this->target_indices_);
  this->target_cloud_updated_ = false;
  searched_target_ = searched;
  used_representation_ = this->point_representation_;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CorrespondenceEstimation<PointSource, PointTarget, Scalar>::prepareSource()
{
  if (!this->tree_reciprocal_)
    throw BadArgument(
        "CorrespondenceEstimation: the search method of the source is null");
  auto& tree = *this->tree_reciprocal_;
  if (this->force_no_recompute_reciprocal_ && tree.getInputCloud())
    return;
  if (!this->source_cloud_updated_ && tree.getInputCloud() == this->input_ &&
      tree.getIndices() == this->indices_ && searched_source_ == *this->indices_ &&
      used_source_representation_ == this->point_representation_)
    return;
  if (this->point_representation_)
    tree.setPointRepresentation(this->point_representation_);
  if (const auto ours =
          std::dynamic_pointer_cast<KdTree<PointSource>>(this->tree_reciprocal_))
    ours->setNumberOfThreads(num_threads_);
  tree.setInputCloud(this->input_, this->indices_);
  this->source_cloud_updated_ = false;
  searched_source_ = *this->indices_;
  used_source_representation_ = this->point_representation_;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CorrespondenceEstimation<PointSource, PointTarget, Scalar>::determineCorrespondences(
    pcl::Correspondences& correspondences,
    double max_distance)
{
  prepare(max_distance);
  const pcl::Indices& indices = *this->indices_;
  pcl::Correspondences pairs;
  pairs.reserve(indices.size());
  if (const auto ours = registration::ourTree<PointTarget>(this->tree_)) {
    const auto found = registration::closestByOurs(
        *ours,
        registration::localPoints(*this->input_, &indices, *ours),
        registration::limitThatIncludes(max_distance),
        num_threads_);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i].index >= 0)
        pairs.emplace_back(indices[i], found[i].index, found[i].distance_sq);
  }
  else if (registration::hasFinitePoint<PointTarget>(*this->tree_))
    for (const auto index : indices) {
      PointTarget query;
      pcl::copyPoint((*this->input_)[index], query);
      const Neighbour found = registration::closestByAny<PointTarget>(
          *this->tree_, query, max_distance * max_distance);
      if (found.index >= 0)
        pairs.emplace_back(index, found.index, found.distance_sq);
    }
  correspondences = std::move(pairs);
}

/** Leaves the mutually closest pairs. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
CorrespondenceEstimation<PointSource, PointTarget, Scalar>::chooseReciprocal(
    pcl::Correspondences& pairs)
{
  std::vector<int> closest(pairs.size(), -1);
  if (const auto ours = registration::ourTree<PointSource>(this->tree_reciprocal_)) {
    pcl::Indices partners;
    partners.reserve(pairs.size());
    for (const auto& pair : pairs)
      partners.push_back(pair.index_match);
    const auto found = registration::closestByOurs(
        *ours,
        registration::localPoints(*this->target_, &partners, *ours),
        std::numeric_limits<float>::infinity(),
        num_threads_);
    for (std::size_t i = 0; i < found.size(); ++i)
      closest[i] = found[i].index;
  }
  else
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      PointSource query;
      pcl::copyPoint((*this->target_)[pairs[i].index_match], query);
      closest[i] =
          registration::closestByAny<PointSource>(
              *this->tree_reciprocal_, query, std::numeric_limits<double>::infinity())
              .index;
    }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (closest[i] == pairs[i].index_query)
      pairs[kept++] = pairs[i];
  pairs.resize(kept);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
CorrespondenceEstimation<PointSource, PointTarget, Scalar>::
    determineReciprocalCorrespondences(pcl::Correspondences& correspondences,
                                       double max_distance)
{
  pcl::Correspondences pairs;
  determineCorrespondences(pairs, max_distance);
  prepareSource();
  chooseReciprocal(pairs);
  correspondences = std::move(pairs);
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename CorrespondenceEstimation<PointSource, PointTarget, Scalar>::Base::Ptr
CorrespondenceEstimation<PointSource, PointTarget, Scalar>::clone() const
{
  const auto copy = pcl::make_shared<CorrespondenceEstimation>(*this);
  if (!this->force_no_recompute_ && registration::ourTree<PointTarget>(this->tree_))
    copy->tree_ = pcl::make_shared<KdTree<PointTarget>>();
  if (!this->force_no_recompute_reciprocal_ &&
      registration::ourTree<PointSource>(this->tree_reciprocal_))
    copy->tree_reciprocal_ = pcl::make_shared<KdTree<PointSource>>();
  return copy;
}

} // namespace pcl6d
