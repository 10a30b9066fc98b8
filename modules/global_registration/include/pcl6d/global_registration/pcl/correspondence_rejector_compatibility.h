// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/global_registration/compatible_pairs.h>
#include <pcl6d/registration/pcl/correspondence_rejector.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Correspondence rejector that keeps the largest mutually compatible set found: any two
 * pairs have equal distances in source and target (compatiblePairs()). One motion brings the
 * pairs together. No motion is drawn at random, unlike
 * pcl::registration::CorrespondenceRejectorSampleConsensus and CorrespondenceRejectorPoly.
 *
 * Meant for feature matches, of which 95 of 100 may be wrong. Works inside PCL's pipelines and
 * ICP6D, too, where dynamic objects no longer bias the fit. Only distances within the source
 * count, not its pose.
 * \code
 * pcl6d::CorrespondenceRejectorCompatibility rejector;
 * rejector.setInputSource<pcl::PointXYZ>(source);
 * rejector.setInputTarget<pcl::PointXYZ>(target);
 * rejector.setInputCorrespondences(matches);
 * pcl::Correspondences right;
 * rejector.getCorrespondences(right);
 * \endcode
 * \note Source: see compatiblePairs().
 * \ingroup global_registration */
class CorrespondenceRejectorCompatibility : public SelectingRejector {
public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorCompatibility>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorCompatibility>;

  CorrespondenceRejectorCompatibility()
  : SelectingRejector("CorrespondenceRejectorCompatibility")
  {}

  /** \brief The largest distance [m] between the points of a right pair after the right motion.
   * Default: 1.25 median spacings of the sparser cloud, the largest distance of points from
   * two scans of a surface.
   * \throws BadArgument unless finite and > 0 */
  void
  setNoise(const std::optional<double>& noise);
  const std::optional<double>&
  getNoise() const
  {
    return noise_;
  }

  /** \brief The largest number of pairs compared pair by pair; 3000 unless set.
   * \throws BadArgument unless in [3, 30000] */
  void
  setMaximumPairs(std::size_t pairs);
  std::size_t
  getMaximumPairs() const
  {
    return options_.max_pairs;
  }

  /** \param[in] num_threads 0: a thread per core; never changes the pairs */
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
  /** \throws BadArgument source or target is not set, or a pair has an index out of range */
  pcl::Correspondences
  select(const pcl::Correspondences& original) override;

private:
  struct Side {
    bool is_set = false;
    Points points;
    std::optional<double> spacing; ///< [m] set on first use
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
