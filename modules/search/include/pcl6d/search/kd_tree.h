// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/instantiate.h>
#include <pcl6d/search/point_tree.h>

#include <pcl/search/kdtree.h>

#include <memory>

namespace pcl6d {

/** \brief Our k-d tree (book 4.1.4) as a pcl::search::Search.
 *
 * Derives from pcl::search::KdTree, the only type that pcl::Registration accepts; its
 * FLANN part stays empty. Distances of the coordinates x, y, z [m]; point
 * representations and epsilon of the base class are not used: the search is exact.
 * Results are always sorted, ties by index. Indices refer to the input cloud, also when
 * only some of its points are searched.
 * \code
 * pcl6d::KdTree<pcl::PointXYZ> tree;
 * tree.setInputCloud(cloud);
 * tree.nearestKSearch(query, 5, indices, squared_distances);
 * \endcode \ingroup search */
template <typename PointT>
class KdTree : public pcl::search::KdTree<PointT> {
public:
  using Base = pcl::search::KdTree<PointT>;
  using Base::nearestKSearch;
  using Base::radiusSearch;
  using typename Base::PointCloudConstPtr;
  using Ptr = pcl::shared_ptr<KdTree<PointT>>;

  /** \param[in] num_threads for building; 0: one per core */
  explicit KdTree(unsigned int num_threads = 0);

  /** \brief Builds the tree. \param[in] indices the points to search; null: all
   * \throws BadArgument the cloud is null */
  void
  setInputCloud(const PointCloudConstPtr& cloud,
                const pcl::IndicesConstPtr& indices = nullptr) override;

  /** \return the number of neighbours found: k, or all points if there are fewer. If it is
   * 0, the vectors hold one entry all the same, index -1 and an infinite distance, as PCL's
   * own callers read it without looking */
  int
  nearestKSearch(const PointT& point,
                 int k,
                 pcl::Indices& k_indices,
                 std::vector<float>& k_sqr_distances) const override;

  /** \return the number of points nearer than radius [m]
   * \param[in] max_nn keep only so many of the nearest; 0: all */
  int
  radiusSearch(const PointT& point,
               double radius,
               pcl::Indices& k_indices,
               std::vector<float>& k_sqr_distances,
               unsigned int max_nn = 0) const override;

  /** \return the tree of the core; null before setInputCloud(). Its indices are those
   * of the searched points, in their order */
  std::shared_ptr<const PointTree>
  tree() const
  {
    return point_tree_;
  }

private:
  int
  toPcl(const std::vector<Neighbour>& found,
        pcl::Indices& indices,
        std::vector<float>& sqr_distances) const;

  unsigned int num_threads_;
  std::shared_ptr<const PointTree> point_tree_;
};

} // namespace pcl6d
#include <pcl6d/search/impl/kd_tree.hpp>
namespace pcl6d {
PCL6D_DECLARE_INSTANCES(KdTree)
} // namespace pcl6d
