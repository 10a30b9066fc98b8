// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/depth_median.h>

#include <pcl/filters/filter.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief pcl::MedianFilter: z of each point of an organized cloud becomes the median in a window
 * around the point; see medianDepths().
 *
 * Depths are identical to PCL's class, computed in parallel. Differences: with no movement allowed
 * points stay (PCL sets points already at the median to NaN), only chosen indices move, and an
 * unorganized cloud is an error, where PCL prints a message and leaves the output unchanged.
 * setSymmetric() mends the effects of PCL's window at borders and gaps. For clouds of scan lines
 * see ScanLineMedian, which moves points along their rays.
 * \code
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

  /** \brief Whether inclined planes keep their shape at borders and gaps, see DepthMedianOptions;
   * false, like in PCL, unless set. */
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

  /** \param[in] num_threads 0 (default): a thread per core; never changes results */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    options_.num_threads = num_threads;
  }

protected:
  /** \throws BadArgument the cloud is not organized, an option is invalid, or an index
   * is out of range */
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
