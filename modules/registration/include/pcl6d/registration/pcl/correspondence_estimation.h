// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/registration/correspondence_estimation.h>

#include <limits>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Closest pairs of two clouds on our k-d tree, as a drop-in for
 * pcl::registration::CorrespondenceEstimation, and inside pcl::IterativeClosestPoint and
 * ICP6D.
 *
 * Exact, in parallel, the same pairs for any number of threads: of target points that are
 * equally near, the one with the smallest place among the searched ones. Pairs come in the
 * order of the source's indices; `distance` is the square [m^2], as in PCL. A pair at exactly
 * the maximum distance counts, as in PCL. Differences: points that are not finite have no pair
 * (PCL's search ends the program on them in debug builds); a changed cloud, index or
 * representation is noticed however it was set (PCL keeps the tree of the source when its
 * indices change, and does not see a representation that is set after the target).
 *
 * A tree that is given by setSearchMethodTarget() or setSearchMethodSource() is searched,
 * whatever it is; other trees than KdTree and CachedKdTree point by point. One that is
 * never to be rebuilt (force_no_recompute) is only built if it has no cloud. With a point
 * representation neighbours are searched by FLANN. A null cloud can be given through PCL's
 * base class only to the target's setter, which PCL does not survive. As in PCL 1.13, both point types
 * must be the same.
 * \code
 * pcl6d::CorrespondenceEstimation<pcl::PointXYZ, pcl::PointXYZ> estimation;
 * estimation.setInputSource(source);
 * estimation.setInputTarget(target);
 * pcl::Correspondences pairs;
 * estimation.determineCorrespondences(pairs, 0.5); // [m]
 * \endcode \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class CorrespondenceEstimation
: public pcl::registration::
      CorrespondenceEstimationBase<PointSource, PointTarget, Scalar> {
public:
  using Base =
      pcl::registration::CorrespondenceEstimationBase<PointSource, PointTarget, Scalar>;
  using Ptr = pcl::shared_ptr<CorrespondenceEstimation>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceEstimation>;

  CorrespondenceEstimation();

  /** \brief PCL's setters, which here take an empty cloud, too.
   * \throws BadArgument the cloud is null */
  void
  setInputSource(const typename Base::PointCloudSourceConstPtr& cloud);
  void
  setInputTarget(const typename Base::PointCloudTargetConstPtr& cloud);

  /** \param[in] num_threads 0: one per core; never changes the pairs */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    num_threads_ = num_threads;
  }

  /** \brief The closest target point of each source point, within a distance.
   * \param[out] correspondences are replaced
   * \param[in] max_distance [m] >= 0; a pair at exactly this distance counts
   * \throws BadArgument a cloud is missing, an index is not that of a point, the distance is
   * negative or NaN, or a tree that is not to be rebuilt is that of another cloud; the
   * correspondences then stay as they were */
  void
  determineCorrespondences(
      pcl::Correspondences& correspondences,
      double max_distance = std::numeric_limits<double>::max()) override;

  /** \brief The same, only pairs of which each is the other's closest. \throws BadArgument as
   * above */
  void
  determineReciprocalCorrespondences(
      pcl::Correspondences& correspondences,
      double max_distance = std::numeric_limits<double>::max()) override;

  /** \brief A copy; trees of ours are copied, so that copies may be used at the same time
   * (PCL: they share the tree). Others are shared, and rebuilt where needed. */
  typename Base::Ptr
  clone() const override;

private:
  /** Checks what was set and builds the target's tree, unless it is built. */
  void
  prepare(double max_distance);
  void
  prepareTarget();
  void
  prepareSource();
  void
  chooseReciprocal(pcl::Correspondences& pairs);

  unsigned int num_threads_ = 0;
  typename Base::PointRepresentationConstPtr used_representation_; ///< of the trees
  typename Base::PointRepresentationConstPtr used_source_representation_;
  pcl::Indices searched_source_; ///< what the source's tree was built from
  pcl::Indices searched_target_;
};

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/correspondence_estimation.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(CorrespondenceEstimation)
} // namespace pcl6d
