// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/pcl/scan_line_filter.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Scan-line reduction filter (book 4.1.5) as a pcl::Filter: merges consecutive
 * points of a line close to the first point of their group; see groupAlongLines().
 *
 * Each group becomes the mean of its points, with the mean of their other fields by
 * pcl::CentroidPoint. With setIndices() only the chosen points are merged, each once,
 * in the order of the line; points that are not chosen still count in the line.
 * \code
 * pcl6d::ScanLineReduction<pcl::PointXYZI> reduction;
 * reduction.options().max_distance = 0.1; // [m]
 * reduction.options().line_step = 3;      // every third line only
 * reduction.setLineLength(360);           // not needed for organized clouds
 * reduction.setInputCloud(cloud);
 * reduction.filter(reduced);
 * \endcode \ingroup filters */
template <typename PointT>
class ScanLineReduction : public ScanLineFilter<PointT> {
public:
  using typename pcl::Filter<PointT>::PointCloud;
  using Ptr = pcl::shared_ptr<ScanLineReduction<PointT>>;

  ScanLineReduction();

  /** \brief Distance limit and step of lines, see ScanLineReductionOptions. */
  ScanLineReductionOptions&
  options()
  {
    return options_;
  }

  /** \param[in] step takes each step-th line; >= 1 \throws BadArgument step < 1 */
  void
  setLineStep(int step);

protected:
  /** \throws BadArgument an option is invalid, the lines are not known, or an index
   * is out of range */
  void
  applyFilter(PointCloud& output) override;

private:
  ScanLineReductionOptions options_;
};

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/scan_line_reduction.hpp>

#include <pcl/point_types.h>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(ScanLineReduction)
} // namespace pcl6d
