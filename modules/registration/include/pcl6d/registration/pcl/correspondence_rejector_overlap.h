// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/registration/pcl/correspondence_rejector.h>
#include <pcl6d/search/point_tree.h>

#include <pcl/point_cloud.h>

#include <memory>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Leaves the pairs within the overlap of two scans: rejects pairs with a target point on
 * the boundary of the target.
 *
 * Source points beyond the overlap have their closest points on the rim of the target, and pull the
 * source towards the rim; a limit of the distance only bounds this pull. A point is on the boundary
 * if its neighbours, in their common plane, leave a gap of more than the boundary angle around the
 * point, or if the point has fewer than 3 neighbours. Edges between two faces are no boundary;
 * holes and the shadows behind objects are. Where the points along a scan line are much closer than
 * the lines, set a radius that reaches the next line.
 *
 * Works inside PCL's pipelines and ICP6D. Each point is tested once, when a pair first
 * needs the result.
 * \note Sources: G. Turk, M. Levoy, "Zippered polygon meshes from range images", SIGGRAPH
 * 1994 (the rule); G. H. Bendels, R. Schnabel, R. Klein, "Detecting holes in point set
 * surfaces", WSCG 2006 (the angle). \ingroup registration */
class CorrespondenceRejectorOverlap : public SelectingRejector {
public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorOverlap>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorOverlap>;

  CorrespondenceRejectorOverlap() : SelectingRejector("CorrespondenceRejectorOverlap")
  {}

  /** \brief The gap between neighbours [rad] above which a point is on the boundary; a right angle
   * unless set, like in pcl::BoundaryEstimation. \throws BadArgument unless in (0, 2 pi) */
  void
  setBoundaryAngle(double angle);
  double
  getBoundaryAngle() const
  {
    return angle_;
  }

  /** \brief The number of nearest points used. 30 unless set: of 30 points at random around a
   * point, 1 % leave a gap of a right angle by chance. \throws BadArgument unless > 2 */
  void
  setKSearch(int neighbours);
  int
  getKSearch() const
  {
    return neighbours_;
  }

  /** \brief Uses the points within this radius [m] instead; 0, off, unless set.
   * \throws BadArgument unless >= 0 */
  void
  setRadiusSearch(double radius);
  double
  getRadiusSearch() const
  {
    return radius_;
  }

  /** \param[in] num_threads 0: a thread per core; never changes the pairs */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    num_threads_ = num_threads;
  }

  /** \brief The whole target. \throws BadArgument null */
  template <typename PointT>
  void
  setInputTarget(const typename pcl::PointCloud<PointT>::ConstPtr& cloud)
  {
    requireGiven(cloud, "the input target");
    setTarget(toPoints(*cloud));
  }

  bool
  requiresTargetPoints() const override
  {
    return true;
  }
  /** \throws BadArgument null, or without coordinates */
  void
  setTargetPoints(pcl::PCLPointCloud2::ConstPtr cloud) override;

  /** \return whether a target point is on the boundary; true for a point that is not finite
   * \throws BadArgument no target is set, or the index is out of range */
  bool
  isBoundary(int index);

protected:
  /** \throws BadArgument no target is set, or the index of a pair is out of range */
  pcl::Correspondences
  select(const pcl::Correspondences& original) override;

private:
  enum class Place : char { kUnknown, kInside, kBoundary };

  void
  setTarget(Points points);
  void
  forget();
  void
  evaluate(std::vector<int> indices);
  Place
  placeOf(const Eigen::Vector3f& point) const;

  double angle_ = 1.5707963267948966; ///< [rad]
  int neighbours_ = 30;
  double radius_ = 0; ///< [m]
  unsigned int num_threads_ = 0;
  Points target_; ///< relative to a nearby place
  std::shared_ptr<const PointTree> tree_;
  std::vector<Place> places_;
};

} // namespace pcl6d
