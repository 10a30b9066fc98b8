// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/global_registration/compatible_pairs.h>
#include <pcl6d/registration/pcl/correspondence_rejector.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Leaves the largest set of pairs found of which any two have the same distance in
 * source and target: compatiblePairs(). One motion brings them together; no motion is
 * drawn or guessed, as pcl::registration::CorrespondenceRejectorSampleConsensus and
 * CorrespondenceRejectorPoly do.
 *
 * Meant for pairs of features, of which 95 of 100 may be wrong. Works inside PCL's pipelines
 * and ICP6D, too: there it keeps moved things from pulling at the rest. The source may lie
 * anywhere: distances within it count, not where it is.
 * \code
 * pcl6d::CorrespondenceRejectorCompatibility rejector;
 * rejector.setInputSource<pcl::PointXYZ>(source);
 * rejector.setInputTarget<pcl::PointXYZ>(target);
 * rejector.setInputCorrespondences(matches);
 * pcl::Correspondences right;
 * rejector.getCorrespondences(right);
 * \endcode
 * \note Source: see compatiblePairs(). \ingroup global_registration */
class CorrespondenceRejectorCompatibility : public SelectingRejector {
public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorCompatibility>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorCompatibility>;

  CorrespondenceRejectorCompatibility()
  : SelectingRejector("CorrespondenceRejectorCompatibility")
  {}

  /** \brief How far apart [m] the points of a right pair may lie after the right motion.
   * None, unless set: 1.25 median spacings of the sparser cloud, as points of two scans of a
   * surface lie so far apart at most. \throws BadArgument unless finite and > 0 */
  void
  setNoise(const std::optional<double>& noise);
  const std::optional<double>&
  getNoise() const
  {
    return noise_;
  }

  /** \brief Of more pairs, so many are looked at, each against each; 3000 unless set.
   * \throws BadArgument unless in [3, 30000] */
  void
  setMaximumPairs(std::size_t pairs);
  std::size_t
  getMaximumPairs() const
  {
    return options_.max_pairs;
  }

  /** \param[in] num_threads 0: one per core; never changes the pairs */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    options_.num_threads = num_threads;
  }

  /** \throws BadArgument null */
  template <typename PointT>
  void
  setInputSource(const typename pcl::PointCloud<PointT>::ConstPtr& cloud)
  {
    requireGiven(cloud, "the input source");
    set(source_, toPoints(*cloud));
  }

  /** \throws BadArgument null */
  template <typename PointT>
  void
  setInputTarget(const typename pcl::PointCloud<PointT>::ConstPtr& cloud)
  {
    requireGiven(cloud, "the input target");
    set(target_, toPoints(*cloud));
  }

  bool
  requiresSourcePoints() const override
  {
    return true;
  }
  bool
  requiresTargetPoints() const override
  {
    return true;
  }
  /** \throws BadArgument null, or without coordinates */
  void
  setSourcePoints(pcl::PCLPointCloud2::ConstPtr cloud) override;
  void
  setTargetPoints(pcl::PCLPointCloud2::ConstPtr cloud) override;

protected:
  /** \throws BadArgument source or target is not set, or a pair has an index that they do
   * not have */
  pcl::Correspondences
  select(const pcl::Correspondences& original) override;

private:
  struct Side {
    bool is_set = false;
    Points points;
    std::optional<double> spacing; ///< [m] once it was asked for
  };

  static void
  set(Side& side, Points points);
  static double
  spacingOf(Side& side);

  std::optional<double> noise_;
  CompatibilityOptions options_;
  Side source_, target_;
};

} // namespace pcl6d
