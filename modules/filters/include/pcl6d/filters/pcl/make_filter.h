// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <pcl/filters/filter.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \return the words of makeFilter(): mean, centre, random (those of `--reduction`),
 * scanline-median, scanline-reduction (of `--filter`) */
std::vector<std::string>
filterNames();

/** \brief PCL's filters by the words of the command line: OctreeReduction, ScanLineMedian or
 * ScanLineReduction behind a pointer to PCL's base class.
 * \code
 * const auto filter = pcl6d::makeFilter<pcl::PointXYZI>("mean", {0.2}); // [m]
 * filter->setInputCloud(cloud);
 * filter->filter(reduced);
 * \endcode
 * Filters along scan lines take the rows of an organized cloud as lines; `scanline-both` of the
 * command line is the one and then the other.
 * \param[in] reduction voxel, number of points and seed of the reductions; its method is that
 * of the word
 * \throws BadArgument no such word; the message lists all \ingroup filters */
template <typename PointT>
typename pcl::Filter<PointT>::Ptr
makeFilter(const std::string& name, const ReductionOptions& reduction = {});

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/make_filter.hpp>
