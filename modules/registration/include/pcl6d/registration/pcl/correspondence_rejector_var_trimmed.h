// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/registration/pcl/correspondence_rejector.h>

#include <pcl/search/kdtree.h>

#include <functional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Leaves the closest pairs, and finds their share itself, as a drop-in for
 * pcl::registration::CorrespondenceRejectorVarTrimmed: that share f, within the bounds, which
 * minimises the fractional RMSD, rms(f) / f^0.95, of two scans that overlap in part.
 *
 * The pairs that are left are the closest ones, ties by index (PCL compares each pair with the
 * distance at another place of its half-sorted list, and leaves as many, but others). Distances
 * are those of the pairs; of the points, if both clouds are given.
 * \note Source: J. M. Phillips, R. Liu, C. Tomasi, "Outlier robust ICP for minimizing
 * fractional RMSD", 3DIM 2007: equation 2, exponent for three dimensions. \ingroup
 * registration */
class CorrespondenceRejectorVarTrimmed : public SelectingRejector {
public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorVarTrimmed>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorVarTrimmed>;

  CorrespondenceRejectorVarTrimmed()
  : SelectingRejector("CorrespondenceRejectorVarTrimmed")
  {}

  /** \return the square of the largest distance that was left [m^2], as in PCL */
  double
  getTrimmedDistance() const
  {
    return trimmed_distance_;
  }
  /** \return the share that was left */
  double
  getTrimFactor() const
  {
    return factor_;
  }

  /** \brief The bounds of the share; 0.05 and 0.95 unless set. \throws BadArgument it is
   * outside [0, 1]; by the selection, if the least is above the largest */
  void
  setMinRatio(double ratio);
  double
  getMinRatio() const
  {
    return min_ratio_;
  }
  void
  setMaxRatio(double ratio);
  double
  getMaxRatio() const
  {
    return max_ratio_;
  }

  /** \brief Clouds whose distances count instead of those of the pairs. They are read at each
   * selection. \throws BadArgument null */
  template <typename PointT>
  void
  setInputSource(const typename pcl::PointCloud<PointT>::ConstPtr& cloud)
  {
    requireGiven(cloud, "the input source");
    source_ = [cloud] { return toPoints(*cloud); };
  }
  template <typename PointT>
  void
  setInputTarget(const typename pcl::PointCloud<PointT>::ConstPtr& cloud)
  {
    requireGiven(cloud, "the input target");
    target_ = [cloud] { return toPoints(*cloud); };
  }

  /** \brief No search is needed, nor does PCL's class use it. \throws BadArgument null */
  template <typename PointT>
  void
  setSearchMethodTarget(const typename pcl::search::KdTree<PointT>::Ptr& tree,
                        bool /*force_no_recompute*/ = false)
  {
    requireGiven(tree, "the search method");
  }

  /** \brief Clouds as PCL's pipelines hand them over; not asked for, as their pairs have
   * their distances. \throws BadArgument null, or without coordinates */
  void
  setSourcePoints(pcl::PCLPointCloud2::ConstPtr cloud) override;
  void
  setTargetPoints(pcl::PCLPointCloud2::ConstPtr cloud) override;

protected:
  pcl::Correspondences
  select(const pcl::Correspondences& original) override;

private:
  double trimmed_distance_ = 0;
  double factor_ = 0;
  double min_ratio_ = 0.05;
  double max_ratio_ = 0.95;
  std::function<Points()> source_, target_;
};

} // namespace pcl6d
