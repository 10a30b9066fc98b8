// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/pcl/scan_line_filter.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Scan-line median filter (book 4.1.5) as a pcl::Filter: moves mixed pixels,
 * which hang in the air between an edge and the background, along their ray to the
 * median range of their neighbours on the scan line; see medianAlongLines().
 *
 * The output has the size, width and height of the input; unmoved points and fields
 * other than x, y, z keep their bits. With setIndices() only the chosen points are
 * moved; every point counts in the median. No point is ever removed.
 * \code
 * pcl6d::ScanLineMedian<pcl::PointXYZI> median;
 * median.setLineLength(360); // not needed for organized clouds
 * median.setInputCloud(cloud);
 * median.filter(filtered);
 * \endcode \ingroup filters */
template <typename PointT>
class ScanLineMedian : public ScanLineFilter<PointT> {
public:
  using typename pcl::Filter<PointT>::PointCloud;
  using Ptr = pcl::shared_ptr<ScanLineMedian<PointT>>;

  ScanLineMedian();

  /** \brief Window and threshold, see ScanLineMedianOptions. */
  ScanLineMedianOptions&
  options()
  {
    return options_;
  }

protected:
  /** \throws BadArgument an option is invalid, the lines are not known, or an index
   * is out of range */
  void
  applyFilter(PointCloud& output) override;

private:
  ScanLineMedianOptions options_;
};

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/scan_line_median.hpp>

#include <pcl/point_types.h>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(ScanLineMedian)
} // namespace pcl6d
