// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/registration/pcl/correspondence_rejector.h>

#include <pcl/search/kdtree.h>

#include <functional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Leaves the closest pairs, and finds their share automatically: drop-in for
 * pcl::registration::CorrespondenceRejectorVarTrimmed. The share f, within the bounds, minimises
 * the fractional RMSD, rms(f) / f^0.95, of two partly overlapping scans.
 *
 * The closest pairs remain, ties by index (PCL compares each pair with the distance at another
 * place of its half-sorted list, and leaves other pairs, of equal number). Distances are taken from
 * the pairs, or from the points if both clouds are given.
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

  /** \return the square of the largest remaining distance [m^2], like in PCL */
  double
  getTrimmedDistance() const
  {
    return trimmed_distance_;
  }
  /** \return the remaining share */
  double
  getTrimFactor() const
  {
    return factor_;
  }

  /** \brief The bounds of the share; 0.05 and 0.95 unless set. \throws BadArgument outside [0, 1];
   * thrown by the selection, if the least is above the largest */
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

  /** \brief Clouds to compute distances from, instead of the pairs' distances; read at each
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

  /** \brief Clouds from PCL's pipelines; not required, since pairs come with distances.
   * \throws BadArgument null, or without coordinates */
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
