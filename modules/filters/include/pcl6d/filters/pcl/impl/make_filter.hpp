// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/filters/pcl/octree_reduction.h>
#include <pcl6d/filters/pcl/scan_line_median.h>
#include <pcl6d/filters/pcl/scan_line_reduction.h>

namespace pcl6d {
namespace filters {

/** Filters of makeFilter(). */
enum class FilterKind { kReduction, kMedian, kLineReduction };

/** \throws BadArgument unknown word */
PCL6D_EXPORTS FilterKind
filterKindFromName(const std::string& name);

} // namespace filters

template <typename PointT>
typename pcl::Filter<PointT>::Ptr
makeFilter(const std::string& name, const ReductionOptions& reduction)
{
  using Ptr = typename pcl::Filter<PointT>::Ptr;
  switch (filters::filterKindFromName(name)) {
  case filters::FilterKind::kMedian:
    return Ptr(new ScanLineMedian<PointT>);
  case filters::FilterKind::kLineReduction:
    return Ptr(new ScanLineReduction<PointT>);
  case filters::FilterKind::kReduction:
    break;
  }
  reduction.validate();
  const auto made = pcl::make_shared<OctreeReduction<PointT>>();
  made->options() = reduction;
  made->options().method = reductionMethodFromName(name);
  return made;
}

#define PCL6D_MAKE_FILTER_(start, PointT)                                              \
  start template pcl::Filter<PointT>::Ptr makeFilter<PointT>(const std::string&,       \
                                                             const ReductionOptions&);

PCL6D_FOR_POINT_TYPES(PCL6D_MAKE_FILTER_, extern)

} // namespace pcl6d
