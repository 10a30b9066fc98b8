// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/moving_objects/moving_scans.h>

#include <pcl/filters/filter_indices.h>

#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Takes what moved out of registered scans, as a pcl::FilterIndices: keeps points that
 * are static, or that no other scan can judge; with setNegative(true) those that moved. Points
 * that are not finite never pass.
 *
 * All scans of a sequence are added first; then any of them is filtered. Clouds must be scans:
 * unreduced, in one piece, seen from one place. That place is the cloud's sensor_origin_ in its
 * own coordinates; what a VIEWPOINT of a PCD file is by PCL6D (the pose of the scan in the world)
 * is no such place: call setOrigin() with 0 before adding such clouds. sensor_orientation_ is not
 * looked at. With setIndices() only the chosen points pass, but all are looked at: a thing is
 * told by all of its points. \code
 * pcl6d::MovingPointFilter<pcl::PointXYZI> filter;
 * for (std::size_t i = 0; i < clouds.size(); ++i)
 *   filter.addScan(clouds[i], T_world_scan[i]);
 * filter.setInputScan(3);
 * filter.filter(*standing);
 * \endcode \ingroup moving_objects */
template <typename PointT>
class MovingPointFilter : public pcl::FilterIndices<PointT> {
public:
  using Ptr = pcl::shared_ptr<MovingPointFilter<PointT>>;
  using ConstPtr = pcl::shared_ptr<const MovingPointFilter<PointT>>;
  using PointCloudConstPtr = typename pcl::Filter<PointT>::PointCloudConstPtr;

  /** \param[in] extract_removed_indices fill getRemovedIndices() */
  explicit MovingPointFilter(bool extract_removed_indices = false);

  /** \brief The edge of the voxels that reduce surfaces [m], for scans that are added from now
   * on; none: derived from each of them. \throws BadArgument it is not finite and > 0 */
  void
  setVoxel(const std::optional<double>& voxel)
  {
    scans_.setVoxel(voxel);
  }

  /** \brief Where the scanner stood in the clouds that are added from now on [m]; none: their
   * sensor_origin_. */
  void
  setOrigin(const std::optional<Eigen::Vector3f>& origin)
  {
    origin_ = origin;
  }

  /** \brief How many threads may run; never changes the result. \param[in] num_threads 0: one
   * per core */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    scans_.setNumberOfThreads(num_threads);
  }

  /** \brief Takes in a scan, in the order of time. The cloud is kept by its pointer.
   * \param[in] T_world_scan \param[in] sigma of the pose, relative to those of its neighbours
   * \return its number, from 0 \throws BadArgument the cloud is null, or as MovingScans::add() */
  std::size_t
  addScan(const PointCloudConstPtr& cloud,
          const Eigen::Isometry3d& T_world_scan,
          const PoseSigma& sigma = {});

  /** \return the number of scans added */
  std::size_t
  size() const
  {
    return clouds_.size();
  }

  /** \brief Filters an added scan next; setInputCloud() with its cloud does the same.
   * \throws BadArgument there is no such scan */
  void
  setInputScan(std::size_t scan);

  /** \brief Filters other points of an added scan next, in its frame: a part of it, or reduced
   * ones. \throws BadArgument there is no such scan, or the cloud is null */
  void
  setInputScan(std::size_t scan, const PointCloudConstPtr& cloud);

  /** \return one per point of an added cloud \throws BadArgument there is no such scan */
  std::vector<PointMotion>
  motion(std::size_t scan);

  /** \return whether rays contradict scans too much to tell what moved: all is unknown then, so
   * that all points are kept */
  bool
  isBlind()
  {
    return scans_.isBlind();
  }

protected:
  /** \throws BadArgument the input cloud is not that of an added scan, or an index is not that
   * of a point */
  void
  applyFilter(pcl::Indices& indices) override;

private:
  void
  requireScan(std::size_t scan) const;
  std::size_t
  scanOfInput() const;

  MovingScans scans_;
  std::vector<PointCloudConstPtr> clouds_;
  std::optional<Eigen::Vector3f> origin_;
  std::size_t chosen_ = 0;          ///< by setInputScan()
  PointCloudConstPtr chosen_cloud_; ///< that goes with it
};

} // namespace pcl6d
#include <pcl6d/moving_objects/pcl/impl/moving_point_filter.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(MovingPointFilter)
} // namespace pcl6d
