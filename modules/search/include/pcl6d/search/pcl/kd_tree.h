// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/search/pcl/core_search.h>
#include <pcl6d/search/point_tree.h>

#include <pcl/point_types.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The optimised k-d tree (PointTree, book 4.1.4) as a pcl::search::KdTree,
 * hence accepted by pcl::Registration. Exact: the epsilon of the base class is not
 * used. With a point representation other than x, y, z, FLANN does the search.
 * \code
 * pcl6d::KdTree<pcl::PointXYZ> tree;
 * tree.setInputCloud(cloud);
 * tree.nearestKSearch(query, 5, indices, squared_distances);
 * \endcode \ingroup search */
template <typename PointT>
class KdTree : public CoreSearch<PointT, PointTree, pcl::search::KdTree<PointT>> {
public:
  using Ptr = pcl::shared_ptr<KdTree<PointT>>;
  using Core = CoreSearch<PointT, PointTree, pcl::search::KdTree<PointT>>;
  using Flann = pcl::search::KdTree<PointT>;
  using Core::nearestKSearch;
  using Core::radiusSearch;
  using typename Core::PointCloudConstPtr;

  /** \brief PCL's constructor. \param[in] sorted has no effect: results always are */
  explicit KdTree(bool sorted = true)
  : KdTree("pcl6d::KdTree", sorted, PointTree::Cells::kNone)
  {}
  /** A number is no bool: threads are set by setNumberOfThreads(). */
  template <typename Number, typename = OnlyNumbers<Number>>
  explicit KdTree(Number) = delete;

  /** \brief PCL's setter: FLANN then finds the neighbours, over the coordinates of the
   * representation. Called through a pointer to the base class, the setting takes
   * effect at the next setInputCloud(). */
  void
  setPointRepresentation(const typename Flann::PointRepresentationConstPtr& how)
  {
    Flann::setPointRepresentation(how);
    if (this->input_)
      setInputCloud(this->input_, this->indices_);
  }

  SetInputCloudResult<Flann>
  setInputCloud(const PointCloudConstPtr& cloud,
                const pcl::IndicesConstPtr& indices = nullptr) override
  {
    const auto how = this->getPointRepresentation();
    by_flann_ = how && (!how->isTrivial() || how->getNumberOfDimensions() != 3);
    if (by_flann_ && cloud && !cloud->empty())
      Flann::setInputCloud(cloud, indices);
    return Core::setInputCloud(cloud, indices);
  }

  int
  nearestKSearch(const PointT& point,
                 int k,
                 pcl::Indices& k_indices,
                 std::vector<float>& k_sqr_distances) const override
  {
    return by_flann_ ? Flann::nearestKSearch(point, k, k_indices, k_sqr_distances)
                     : Core::nearestKSearch(point, k, k_indices, k_sqr_distances);
  }

  int
  radiusSearch(const PointT& point,
               double radius,
               pcl::Indices& k_indices,
               std::vector<float>& k_sqr_distances,
               unsigned int max_nn = 0) const override
  {
    return by_flann_
               ? Flann::radiusSearch(point, radius, k_indices, k_sqr_distances, max_nn)
               : Core::radiusSearch(point, radius, k_indices, k_sqr_distances, max_nn);
  }

  /** \param[in] num_threads for the next setInputCloud(); 0: a thread per core */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    num_threads_ = num_threads;
  }

  /** \return the tree of the core; null before setInputCloud(). Its indices count the
   * searched points in order */
  std::shared_ptr<const PointTree>
  tree() const
  {
    return this->input_ ? this->core_ : nullptr;
  }

protected:
  KdTree(const std::string& name, bool /*sorted*/, PointTree::Cells cells)
  : Core(name), cells_(cells)
  {}

  bool by_flann_ = false; ///< the coordinates differ from x, y, z

  std::shared_ptr<const PointTree>
  build(const Points& points) override
  {
    return std::make_shared<PointTree>(points, num_threads_, cells_);
  }

private:
  unsigned int num_threads_ = 0;
  PointTree::Cells cells_;
};

PCL6D_DECLARE_INSTANCES(KdTree)
} // namespace pcl6d
