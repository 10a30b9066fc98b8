// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/search/pcl/core_search.h>
#include <pcl6d/search/point_tree.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Our k-d tree (book 4.1.4) as a pcl::search::KdTree, hence accepted by
 * pcl::Registration. Exact: the epsilon of the base class is not used.
 * \code
 * pcl6d::KdTree<pcl::PointXYZ> tree;
 * tree.setInputCloud(cloud);
 * tree.nearestKSearch(query, 5, indices, squared_distances);
 * \endcode \ingroup search */
template <typename PointT>
class KdTree : public CoreSearch<PointT, PointTree, pcl::search::KdTree<PointT>> {
public:
  using Ptr = pcl::shared_ptr<KdTree<PointT>>;

  /** \param[in] num_threads for building; 0: one per core */
  explicit KdTree(unsigned int num_threads = 0)
  : KdTree("pcl6d::KdTree", num_threads, PointTree::Cells::kNone)
  {}

  /** \param[in] num_threads for the next setInputCloud(); 0: one per core */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    num_threads_ = num_threads;
  }

  /** \return the tree of the core; null before setInputCloud(). Its indices are those
   * of the searched points, in their order */
  std::shared_ptr<const PointTree>
  tree() const
  {
    return this->input_ ? this->core_ : nullptr;
  }

protected:
  KdTree(const std::string& name, unsigned int num_threads, PointTree::Cells cells)
  : CoreSearch<PointT, PointTree, pcl::search::KdTree<PointT>>(name)
  , num_threads_(num_threads)
  , cells_(cells)
  {}

  std::shared_ptr<const PointTree>
  build(const Points& points) override
  {
    return std::make_shared<PointTree>(points, num_threads_, cells_);
  }

private:
  unsigned int num_threads_;
  PointTree::Cells cells_;
};

PCL6D_DECLARE_INSTANCES(KdTree)
} // namespace pcl6d
