// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>

#include <pcl/filters/filter_indices.h>

#include <limits>

namespace PCL6D_EXPORTS pcl6d {

/** \brief pcl::FilterIndices that keeps the points at a distance from the scanner (the
 * origin of the scan's frame) in [min_range, max_range]. Points that are not finite
 * never pass. \ingroup filters */
template <typename PointT>
class RangeGate : public pcl::FilterIndices<PointT> {
public:
  using Ptr = pcl::shared_ptr<RangeGate<PointT>>;

  /** \param[in] extract_removed_indices fill getRemovedIndices() */
  explicit RangeGate(bool extract_removed_indices = false);

  /** \param[in] min_range, max_range [m], 0 <= min_range <= max_range
   * \throws BadArgument naming the invalid value */
  void
  setLimits(double min_range, double max_range);

protected:
  /** \throws BadArgument an index is out of range */
  void
  applyFilter(pcl::Indices& indices) override;

private:
  double min_range_ = 0;
  double max_range_ = std::numeric_limits<double>::infinity();
};

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/range_gate.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(RangeGate)
} // namespace pcl6d
