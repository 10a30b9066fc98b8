// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/search/pcl/core_search.h>
#include <pcl6d/search/point_octree.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Octree search (book 4.1.4) as a pcl::search::Search; exact. \ingroup search */
template <typename PointT>
class OctreeSearch
: public CoreSearch<PointT, PointOctree, pcl::search::Search<PointT>> {
public:
  using Ptr = pcl::shared_ptr<OctreeSearch<PointT>>;

  /** \brief PCL's constructor. \param[in] resolution [m] has no effect: the size of a leaf follows
   * from its number of points */
  explicit OctreeSearch(double resolution = 0)
  : CoreSearch<PointT, PointOctree, pcl::search::Search<PointT>>("pcl6d::OctreeSearch")
  {
    static_cast<void>(resolution);
  }

  /** \param[in] num_threads for the next setInputCloud(); 0: a thread per core */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    num_threads_ = num_threads;
  }

protected:
  std::shared_ptr<const PointOctree>
  build(const Points& points) override
  {
    return std::make_shared<PointOctree>(points, num_threads_);
  }

private:
  unsigned int num_threads_ = 0;
};

PCL6D_DECLARE_INSTANCES(OctreeSearch)
} // namespace pcl6d
