// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <pcl/filters/filter.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \return the words of makeFilter(): mean, centre, random (of `--reduction`), scanline-median,
 * scanline-reduction (of `--filter`) */
std::vector<std::string>
filterNames();

/** \brief Makes a PCL filter from a word of the command line: OctreeReduction, ScanLineMedian or
 * ScanLineReduction behind a pointer to PCL's base class.
 * \code
 * const auto filter = pcl6d::makeFilter<pcl::PointXYZI>("mean", {0.2}); // [m]
 * filter->setInputCloud(cloud);
 * filter->filter(reduced);
 * \endcode
 * Filters along scan lines take the rows of an organized cloud for lines; `scanline-both` of the
 * command line is both in turn.
 * \param[in] reduction voxel, number of points and seed of the reductions; the word sets the method
 * \throws BadArgument unknown word; the message lists the known words \ingroup filters */
template <typename PointT>
typename pcl::Filter<PointT>::Ptr
makeFilter(const std::string& name, const ReductionOptions& reduction = {});

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/make_filter.hpp>
