// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/search/leaf_memory.h>
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The cached k-d tree (book 4.1.4): exact, and quick for queries that recur slightly moved,
 * like the iterations of ICP.
 *
 * The leaf of a query's last neighbour is kept; the next search starts there and climbs only as far
 * as necessary. A caller who numbers the queries has a slot for each. Without a number, as in
 * pcl::Registration, a search for the one nearest point is recognised by the memory address of the
 * query point (LeafMemory). PCL moves its source in place: pcl::IterativeClosestPoint and
 * pcl6d::ICP6D both start at the leaves of their last iteration. ICP6D keeps leaves of its own,
 * anew in each align(), hence several ICP6D objects may share a tree.
 * \code
 * pcl6d::CachedKdTree<pcl::PointXYZ> tree;
 * tree.setInputCloud(target);
 * tree.setNumSlots(source->size());
 * for (each iteration) // with the source moved a little further
 *   for (std::size_t i = 0; i < source->size(); ++i)
 *     found = tree.nearestCached(i, (*source)[i], 0.5);
 * \endcode
 * Searches may run in parallel unless two of them use one slot at once; searches without a
 * slot always may.
 * \note Source: A. Nüchter, K. Lingemann, J. Hertzberg, "Cached k-d tree search for ICP
 * algorithms", 3DIM 2007. \ingroup search */
template <typename PointT>
class CachedKdTree : public KdTree<PointT> {
public:
  using KdTree<PointT>::nearestKSearch;
  using Ptr = pcl::shared_ptr<CachedKdTree<PointT>>;

  /** \brief PCL's constructor. \param[in] sorted has no effect: results always are */
  explicit CachedKdTree(bool sorted = true)
  : KdTree<PointT>("pcl6d::CachedKdTree", sorted, PointTree::Cells::kKeep)
  {}
  /** A number is no bool: threads are set by setNumberOfThreads(). */
  template <typename Number, typename = OnlyNumbers<Number>>
  explicit CachedKdTree(Number) = delete;

  /** \brief Sets the number of slots (initially 0) and empties every slot. A new input cloud
   * empties the slots, too. */
  void
  setNumSlots(std::size_t count)
  {
    leaf_of_slot_.assign(count, -1);
  }

  /** \brief nearest() by the cached search.
   * \throws BadArgument the slot does not exist */
  Neighbour
  nearestCached(std::size_t slot, const PointT& point, double max_distance) const
  {
    if (slot >= leaf_of_slot_.size())
      throw BadArgument("CachedKdTree: slot " + std::to_string(slot) + " of " +
                        std::to_string(leaf_of_slot_.size()));
    return this->inCloud(this->core_->nearestFrom(
        leaf_of_slot_[slot], this->local(point), squaredLimit(max_distance)));
  }

  /** \brief PCL's search: with k = 1 from the leaf where the last search for the point at this
   * address ended. */
  int
  nearestKSearch(const PointT& point,
                 int k,
                 pcl::Indices& k_indices,
                 std::vector<float>& k_sqr_distances) const override
  {
    if (k != 1 || this->by_flann_)
      return KdTree<PointT>::nearestKSearch(point, k, k_indices, k_sqr_distances);
    int leaf = leaf_of_point_->leafOf(&point, sizeof(PointT));
    const Neighbour found = this->core_->nearestFrom(
        leaf, this->local(point), std::numeric_limits<float>::infinity());
    leaf_of_point_->remember(&point, sizeof(PointT), leaf);
    return this->toPcl(found, k_indices, k_sqr_distances);
  }

  /** \return the number of query points without a slot for which a leaf is known */
  std::size_t
  numRemembered() const
  {
    return leaf_of_point_->count();
  }

  /** \brief PCL's search for the neighbours of cloud[index]: with k = 1 the index is the
   * slot, if it exists. */
  int
  nearestKSearch(const pcl::PointCloud<PointT>& cloud,
                 pcl::index_t index,
                 int k,
                 pcl::Indices& k_indices,
                 std::vector<float>& k_sqr_distances) const override
  {
    if (k != 1 || this->by_flann_ ||
        static_cast<std::size_t>(index) >= leaf_of_slot_.size())
      return KdTree<PointT>::nearestKSearch(
          cloud, index, k, k_indices, k_sqr_distances);
    const Neighbour found =
        this->core_->nearestFrom(leaf_of_slot_[index],
                                 this->local(cloud[index]),
                                 std::numeric_limits<float>::infinity());
    return this->toPcl(found, k_indices, k_sqr_distances);
  }

protected:
  std::shared_ptr<const PointTree>
  build(const Points& points) override
  {
    auto tree = KdTree<PointT>::build(points);
    setNumSlots(leaf_of_slot_.size());
    leaf_of_point_ = std::make_shared<LeafMemory>(points.size());
    return tree;
  }

private:
  mutable std::vector<int> leaf_of_slot_; ///< -1: empty
  std::shared_ptr<LeafMemory> leaf_of_point_ =
      std::make_shared<LeafMemory>(); ///< of the tree, hence shared with copies
};

PCL6D_DECLARE_INSTANCES(CachedKdTree)
} // namespace pcl6d
