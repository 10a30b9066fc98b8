// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/depth_median.h>

#include <pcl/filters/filter.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief pcl::MedianFilter: z of each point of an organized cloud becomes the median in a
 * window around it; see medianDepths().
 *
 * The same depths as PCL's class gives, in parallel. What differs: with no movement allowed
 * points stay (PCL makes NaN of those that are the median already), chosen indices
 * are the points that move, and a cloud that is not organized is refused, where PCL
 * prints a message and leaves the output as it was. setSymmetric() mends what the window
 * of PCL does at borders and gaps. For clouds of scan lines there is
 * ScanLineMedian, which moves points along their rays. \code
 * pcl6d::MedianFilter<pcl::PointXYZ> median;
 * median.setWindowSize(5);
 * median.setMaxAllowedMovement(0.05f); // [m]
 * median.setInputCloud(cloud);
 * median.filter(filtered);
 * \endcode \ingroup filters */
template <typename PointT>
class MedianFilter : public pcl::Filter<PointT> {
public:
  using typename pcl::Filter<PointT>::PointCloud;
  using Ptr = pcl::shared_ptr<MedianFilter<PointT>>;
  using ConstPtr = pcl::shared_ptr<const MedianFilter<PointT>>;

  MedianFilter();

  /** \brief Points a side of the window; 5 unless set. */
  void
  setWindowSize(int size)
  {
    options_.window = size;
  }
  int
  getWindowSize() const
  {
    return options_.window;
  }

  /** \brief How far z may change at most [m]; not limited unless set. */
  void
  setMaxAllowedMovement(float distance)
  {
    options_.max_movement = distance;
  }
  float
  getMaxAllowedMovement() const
  {
    return options_.max_movement;
  }

  /** \brief Whether inclined planes keep their shape at borders and gaps, see
   * DepthMedianOptions; false, as in PCL, unless set. */
  void
  setSymmetric(bool symmetric)
  {
    options_.symmetric = symmetric;
  }
  bool
  getSymmetric() const
  {
    return options_.symmetric;
  }

  /** \param[in] num_threads 0: one per core, as unless set; never changes results */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    options_.num_threads = num_threads;
  }

protected:
  /** \throws BadArgument the cloud is not organized, an option breaks its rule, or an index
   * is not that of a point */
  void
  applyFilter(PointCloud& output) override;

private:
  DepthMedianOptions options_;
};

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/median_filter.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(MedianFilter)
} // namespace pcl6d
