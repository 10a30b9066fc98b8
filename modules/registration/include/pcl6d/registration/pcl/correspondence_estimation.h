// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/registration/correspondence_estimation.h>

#include <limits>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Closest pairs of two clouds by pcl6d::KdTree: drop-in for
 * pcl::registration::CorrespondenceEstimation, usable in pcl::IterativeClosestPoint and ICP6D.
 *
 * Exact and in parallel, with equal pairs for any number of threads: of equally near target points,
 * the first of the searched points. Pairs come in the order of the source's indices; `distance` is
 * the square [m^2], and a pair at exactly the maximum distance counts, both like in PCL.
 * Differences: points that are not finite have no pair (PCL's search ends the program in debug
 * builds); every change of a cloud, index or representation is noticed (PCL keeps the tree of the
 * source when its indices change, and overlooks a representation set after the target).
 *
 * A tree given by setSearchMethodTarget() or setSearchMethodSource() is used, whatever its class;
 * trees other than KdTree and CachedKdTree are searched point by point. A tree with
 * force_no_recompute is only built if it has no cloud. With a point representation FLANN searches
 * for neighbours. Through PCL's base class a null cloud can only be given to the target's setter,
 * and PCL crashes on it. Both point types must be equal, like in PCL 1.13.
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

  /** \brief PCL's setters; an empty cloud is allowed, too.
   * \throws BadArgument the cloud is null */
  void
  setInputSource(const typename Base::PointCloudSourceConstPtr& cloud);
  void
  setInputTarget(const typename Base::PointCloudTargetConstPtr& cloud);

  /** \param[in] num_threads 0: a thread per core; never changes the pairs */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    num_threads_ = num_threads;
  }

  /** \brief The closest target point of each source point, within a distance.
   * \param[out] correspondences replaced
   * \param[in] max_distance [m] >= 0; a pair at exactly this distance counts
   * \throws BadArgument a cloud is missing, an index is out of range, the distance is negative or
   * NaN, or a tree with force_no_recompute belongs to another cloud; the correspondences then
   * stay unchanged */
  void
  determineCorrespondences(
      pcl::Correspondences& correspondences,
      double max_distance = std::numeric_limits<double>::max()) override;

  /** \brief determineCorrespondences() restricted to mutually closest pairs. \throws BadArgument
   * see determineCorrespondences() */
  void
  determineReciprocalCorrespondences(
      pcl::Correspondences& correspondences,
      double max_distance = std::numeric_limits<double>::max()) override;

  /** \brief A copy. Trees of pcl6d are copied, hence copies may be used concurrently (PCL: copies
   * share the tree). Other trees are shared, and rebuilt where needed. */
  typename Base::Ptr
  clone() const override;

private:
  /** Checks the settings and builds the target's tree, if needed. */
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
  pcl::Indices searched_source_; ///< indices of the points in the source's tree
  pcl::Indices searched_target_;
};

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/correspondence_estimation.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(CorrespondenceEstimation)
} // namespace pcl6d
