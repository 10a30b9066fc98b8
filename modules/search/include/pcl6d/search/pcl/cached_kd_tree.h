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

/** \brief The cached k-d tree (book 4.1.4): exact, and quick when the same queries come
 * again slightly moved, as in the iterations of ICP.
 *
 * Each query remembers the leaf of its last neighbour; the next search starts there and
 * climbs only as far as it must. A caller who numbers its queries has a slot for each. A
 * search for the one nearest point of a PointT alone, as PCL's registration makes it, is
 * known by where that point lies in memory (LeafMemory): PCL moves its source in place, so
 * that pcl::IterativeClosestPoint and pcl6d::ICP6D both start at the leaves of their last
 * iteration. ICP6D keeps its leaves by itself, anew in each align(), so that several may
 * share a tree.
 * \code
 * pcl6d::CachedKdTree<pcl::PointXYZ> tree;
 * tree.setInputCloud(target);
 * tree.setNumSlots(source->size());
 * for (each iteration) // with the source moved a little further
 *   for (std::size_t i = 0; i < source->size(); ++i)
 *     found = tree.nearestCached(i, (*source)[i], 0.5);
 * \endcode
 * Searches may run in parallel as long as no two of them use the same slot at once; by
 * points alone they always may.
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

  /** \brief Makes so many slots, all of them empty; at first there are none. A new
   * input cloud empties them too. */
  void
  setNumSlots(std::size_t count)
  {
    leaf_of_slot_.assign(count, -1);
  }

  /** \brief As nearest(), by the cached search.
   * \throws BadArgument there is no such slot */
  Neighbour
  nearestCached(std::size_t slot, const PointT& point, double max_distance) const
  {
    if (slot >= leaf_of_slot_.size())
      throw BadArgument("CachedKdTree: slot " + std::to_string(slot) + " of " +
                        std::to_string(leaf_of_slot_.size()));
    return this->inCloud(this->core_->nearestFrom(
        leaf_of_slot_[slot], this->local(point), squaredLimit(max_distance)));
  }

  /** \brief PCL's search: with k = 1 from the leaf where the last one for the point at
   * this address ended. */
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

  /** \return the number of points, searched for without a slot, whose leaf is known */
  std::size_t
  numRemembered() const
  {
    return leaf_of_point_->count();
  }

  /** \brief PCL's search for the neighbours of cloud[index]: with k = 1 the index is the
   * slot, if there is one. */
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
