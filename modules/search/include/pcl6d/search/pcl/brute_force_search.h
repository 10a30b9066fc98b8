// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/search/pcl/core_search.h>
#include <pcl6d/search/point_list.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Brute-force search over every point: the oracle of the faster searches.
 * \ingroup search */
template <typename PointT>
class BruteForceSearch
: public CoreSearch<PointT, PointList, pcl::search::Search<PointT>> {
public:
  using Ptr = pcl::shared_ptr<BruteForceSearch<PointT>>;

  /** \brief PCL's constructor. \param[in] sorted has no effect: results always are */
  explicit BruteForceSearch(bool sorted = true)
  : CoreSearch<PointT, PointList, pcl::search::Search<PointT>>(
        "pcl6d::BruteForceSearch")
  {
    static_cast<void>(sorted);
  }

protected:
  std::shared_ptr<const PointList>
  build(const Points& points) override
  {
    return std::make_shared<PointList>(points);
  }
};

PCL6D_DECLARE_INSTANCES(BruteForceSearch)
} // namespace pcl6d
