// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/search/pcl/core_search.h>
#include <pcl6d/search/point_tree.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The approximate k-d tree (book 4.1.4): the i-th point found is at most
 * (1 + epsilon) times as far as the true i-th; radiusSearch() stays exact.
 *
 * A limited search finds a point if and only if one lies within the limit. Not a
 * pcl6d::KdTree: classes that need exact results do not accept it.
 * \note Source: S. Arya, D. M. Mount, "Approximate nearest neighbor queries in fixed
 * dimensions", SODA 1993. \ingroup search */
template <typename PointT>
class ApproximateKdTree
: public CoreSearch<PointT, PointTree, pcl::search::KdTree<PointT>> {
public:
  using Ptr = pcl::shared_ptr<ApproximateKdTree<PointT>>;

  /** \param[in] epsilon relative, see setEpsilon()
   * \param[in] num_threads for building; 0: a thread per core */
  explicit ApproximateKdTree(float epsilon = 1, unsigned int num_threads = 0)
  : CoreSearch<PointT, PointTree, pcl::search::KdTree<PointT>>(
        "pcl6d::ApproximateKdTree")
  , num_threads_(num_threads)
  {
    setEpsilon(epsilon);
  }

  /** \brief PCL's setter, with its rule checked; a search checks it again.
   * \param[in] epsilon >= 0; 0: exact; infinite: the best of the first leaf */
  void
  setEpsilon(float epsilon)
  {
    if (!(epsilon >= 0))
      throw BadArgument("epsilon = " + std::to_string(epsilon) + ", but must be >= 0");
    pcl::search::KdTree<PointT>::setEpsilon(epsilon);
  }

protected:
  std::shared_ptr<const PointTree>
  build(const Points& points) override
  {
    return std::make_shared<PointTree>(points, num_threads_);
  }
  Neighbour
  findNearest(const Eigen::Vector3f& query, float max_distance_sq) const override
  {
    return this->core_->nearestApproximate(query, max_distance_sq, this->getEpsilon());
  }
  std::vector<Neighbour>
  findK(const Eigen::Vector3f& query, std::size_t k) const override
  {
    return this->core_->nearestK(query, k, this->getEpsilon());
  }

private:
  unsigned int num_threads_;
};

PCL6D_DECLARE_INSTANCES(ApproximateKdTree)
} // namespace pcl6d
