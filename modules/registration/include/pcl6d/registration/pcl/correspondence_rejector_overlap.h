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

/** \brief Leaves the pairs within the overlap of two scans: out go those whose target point is
 * on the boundary of the target.
 *
 * Source points beyond the overlap have their closest points on the rim of the target, and pull
 * the source towards it; a limit of the distance only bounds that. A point is on the boundary
 * if its neighbours, in the plane that they span, leave a gap of more than the boundary angle
 * around it, or if it has fewer than 3. Edges between two faces are no boundary; holes and
 * the shadows behind objects are, as they should be. Where the points of a line of a scanner
 * stand much closer than its lines, set a radius that reaches the next line.
 *
 * Works inside PCL's pipelines and ICP6D. Points are judged when a pair first needs it, once.
 * \note Sources: G. Turk, M. Levoy, "Zippered polygon meshes from range images", SIGGRAPH
 * 1994 (the rule); G. H. Bendels, R. Schnabel, R. Klein, "Detecting holes in point set
 * surfaces", WSCG 2006 (the angle). \ingroup registration */
class CorrespondenceRejectorOverlap : public SelectingRejector {
public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorOverlap>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorOverlap>;

  CorrespondenceRejectorOverlap() : SelectingRejector("CorrespondenceRejectorOverlap")
  {}

  /** \brief The gap between neighbours [rad] above which a point is on the boundary; a right
   * angle unless set, as in pcl::BoundaryEstimation. \throws BadArgument unless in (0, 2 pi) */
  void
  setBoundaryAngle(double angle);
  double
  getBoundaryAngle() const
  {
    return angle_;
  }

  /** \brief The number of nearest points that are looked at. 30 unless set: of so many that
   * stand anywhere around a point, 1 % leave a gap of a right angle by chance. \throws
   * BadArgument unless > 2 */
  void
  setKSearch(int neighbours);
  int
  getKSearch() const
  {
    return neighbours_;
  }

  /** \brief All points within this radius [m] are looked at instead; 0, off, unless set.
   * \throws BadArgument unless >= 0 */
  void
  setRadiusSearch(double radius);
  double
  getRadiusSearch() const
  {
    return radius_;
  }

  /** \param[in] num_threads 0: one per core; never changes the pairs */
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

  /** \return whether a target point is on the boundary; one that is not finite is
   * \throws BadArgument no target is set, or it has no such point */
  bool
  isBoundary(int index);

protected:
  /** \throws BadArgument no target is set, or a pair has an index that it does not */
  pcl::Correspondences
  select(const pcl::Correspondences& original) override;

private:
  enum class Place : char { kUnknown, kInside, kBoundary };

  void
  setTarget(Points points);
  void
  forget();
  void
  judge(std::vector<int> indices);
  Place
  placeOf(const Eigen::Vector3f& point) const;

  double angle_ = 1.5707963267948966; ///< [rad]
  int neighbours_ = 30;
  double radius_ = 0; ///< [m]
  unsigned int num_threads_ = 0;
  Points target_; ///< relative to a place near them
  std::shared_ptr<const PointTree> tree_;
  std::vector<Place> places_;
};

} // namespace pcl6d
