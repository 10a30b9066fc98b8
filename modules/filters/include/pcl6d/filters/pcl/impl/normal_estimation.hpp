// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/filters/pcl/normal_estimation.h>

#include <pcl/features/impl/feature.hpp>
#include <pcl/features/impl/normal_3d.hpp>

#include <limits>
#include <typeinfo>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointInT, typename PointOutT>
NormalEstimation<PointInT, PointOutT>::NormalEstimation(unsigned int num_threads)
: num_threads_(num_threads)
{
  this->feature_name_ = "NormalEstimation";
}

template <typename PointInT, typename PointOutT>
void
NormalEstimation<PointInT, PointOutT>::setInputCloud(const PointCloudConstPtr& cloud)
{
  if (!cloud)
    throw BadArgument("NormalEstimation: the input cloud is null");
  Base::setInputCloud(cloud);
}

template <typename PointInT, typename PointOutT>
bool
NormalEstimation<PointInT, PointOutT>::initCompute()
{
  if (!this->input_)
    throw BadArgument("NormalEstimation: there is no input cloud");
  require(this->k_ >= 0, "k", this->k_, ">= 0");
  PatchSize{static_cast<std::size_t>(this->k_), this->search_radius_}.validate();
  if (!this->fake_indices_ && this->indices_)
    requireIndices(*this->indices_, this->input_->size());
  if (!this->tree_) {
    const auto tree = pcl::make_shared<KdTree<PointInT>>();
    tree->setNumberOfThreads(num_threads_);
    this->tree_ = tree;
  }
  return Base::initCompute();
}

/** \return whether a search is over x, y, z of the whole surface, and exact */
template <typename PointT>
bool
isPlainTree(const pcl::search::KdTree<PointT>& tree)
{
  const auto how = tree.getPointRepresentation();
  return !tree.getIndices() && tree.getEpsilon() == 0 &&
         (!how || (how->isTrivial() && how->getNumberOfDimensions() == 3));
}

template <typename PointInT, typename PointOutT>
std::vector<SurfacePatch>
NormalEstimation<PointInT, PointOutT>::patches()
{
  const auto& search = *this->tree_;
  const bool is_ours = typeid(search) == typeid(KdTree<PointInT>);
  const bool is_of_pcl = typeid(search) == typeid(pcl::search::KdTree<PointInT>);
  if ((is_ours || is_of_pcl) &&
      isPlainTree(static_cast<const pcl::search::KdTree<PointInT>&>(search))) {
    if (is_ours)
      return patchesByTree(static_cast<const KdTree<PointInT>&>(search));
    KdTree<PointInT> tree;
    tree.setNumberOfThreads(num_threads_);
    tree.setInputCloud(this->surface_);
    return patchesByTree(tree);
  }
  if (this->surface_->empty())
    return std::vector<SurfacePatch>(this->indices_->size());
  return patchesBySearch();
}

template <typename PointInT, typename PointOutT>
std::vector<SurfacePatch>
NormalEstimation<PointInT, PointOutT>::patchesByTree(const KdTree<PointInT>& tree) const
{
  Points places = toPoints(*this->input_, *this->indices_);
  Points points = toPoints(*this->surface_);
  for (auto& p : places)
    p -= tree.origin();
  for (auto& p : points)
    p -= tree.origin();
  const PatchSize size{static_cast<std::size_t>(this->k_), this->search_radius_};
  return fitPatches(places, points, *tree.tree(), size, num_threads_);
}

template <typename PointInT, typename PointOutT>
std::vector<SurfacePatch>
NormalEstimation<PointInT, PointOutT>::patchesBySearch() const
{
  constexpr std::size_t kBlock = 256;
  std::vector<SurfacePatch> found(this->indices_->size());
  const auto fit = [&](const Block& block) {
    pcl::Indices neighbours(this->k_);
    std::vector<float> distances(this->k_);
    Points offsets;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const pcl::index_t index = (*this->indices_)[i];
      const Eigen::Vector3f place = (*this->input_)[index].getVector3fMap();
      if (!place.allFinite() ||
          this->searchForNeighbors(
              index, this->search_parameter_, neighbours, distances) <= 0)
        continue;
      offsets.clear();
      for (const auto n : neighbours)
        offsets.push_back((*this->surface_)[n].getVector3fMap() - place);
      found[i] = fitPatch(offsets);
    }
  };
  parallelBlocks(found.size(), kBlock, num_threads_ == 0 ? 1 : num_threads_, fit);
  return found;
}

template <typename PointInT, typename PointOutT>
void
NormalEstimation<PointInT, PointOutT>::growAcrossLines(
    std::vector<SurfacePatch>& patches) const
{
  const Eigen::Vector3f viewpoint(this->vpx_, this->vpy_, this->vpz_);
  growLines(
      toPoints(*this->input_, *this->indices_),
      LineSurface(toPoints(*this->surface_), viewpoint, line_growth_, num_threads_),
      patches,
      num_threads_);
}

template <typename PointInT, typename PointOutT>
void
NormalEstimation<PointInT, PointOutT>::computeFeature(PointCloudOut& output)
{
  std::vector<SurfacePatch> all = patches();
  growAcrossLines(all);
  const Eigen::Vector3d viewpoint(this->vpx_, this->vpy_, this->vpz_);
  output.is_dense = true;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::Vector3d place =
        (*this->input_)[(*this->indices_)[i]].getVector3fMap().template cast<double>();
    Eigen::Vector3f normal = all[i].normal;
    float curvature = all[i].curvature;
    if (normal.isZero(0)) {
      curvature = std::numeric_limits<float>::quiet_NaN();
      normal.setConstant(curvature);
      output.is_dense = false;
    }
    else if ((viewpoint - place).dot(normal.template cast<double>()) < 0)
      normal = -normal;
    output[i].getNormalVector3fMap() = normal;
    output[i].curvature = curvature;
  }
}

template <typename PointInT, typename PointOutT>
bool
NormalEstimation<PointInT, PointOutT>::computePointNormal(
    const pcl::PointCloud<PointInT>& cloud,
    const pcl::Indices& indices,
    Eigen::Vector4f& plane,
    float& curvature)
{
  requireIndices(indices, cloud.size());
  Points offsets;
  Eigen::Vector3f place = Eigen::Vector3f::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto i : indices) {
    const Eigen::Vector3f p = cloud[i].getVector3fMap();
    if (!p.allFinite())
      continue;
    if (offsets.empty())
      place = p;
    offsets.push_back(p - place);
    sum += p.template cast<double>();
  }
  const SurfacePatch patch = fitPatch(offsets);
  if (patch.normal.isZero(0)) {
    curvature = std::numeric_limits<float>::quiet_NaN();
    plane.setConstant(curvature);
    return false;
  }
  const Eigen::Vector3d mean = sum / static_cast<double>(offsets.size());
  curvature = patch.curvature;
  plane << patch.normal,
      static_cast<float>(-patch.normal.template cast<double>().dot(mean));
  return true;
}

template <typename PointInT, typename PointOutT>
bool
NormalEstimation<PointInT, PointOutT>::computePointNormal(
    const pcl::PointCloud<PointInT>& cloud,
    const pcl::Indices& indices,
    float& nx,
    float& ny,
    float& nz,
    float& curvature)
{
  Eigen::Vector4f plane;
  const bool is_plane = computePointNormal(cloud, indices, plane, curvature);
  nx = plane[0];
  ny = plane[1];
  nz = plane[2];
  return is_plane;
}

} // namespace pcl6d
