// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/moving_objects/moving_scans.h>

#include <pcl/filters/filter_indices.h>

#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Removes dynamic points from registered scans, as a pcl::FilterIndices: keeps static
 * points and points without an observer; with setNegative(true) the dynamic points. Non-finite
 * points never pass.
 *
 * Add every scan of a sequence first; then any scan can be filtered. Clouds must be scans:
 * unreduced, in one piece, seen from one position: the cloud's sensor_origin_ in its own
 * coordinates. The VIEWPOINT of a PCD file by PCL6D (the pose of the scan in the world) is no
 * such position: call setOrigin() with 0 before adding such clouds. sensor_orientation_ is
 * ignored. With setIndices() only the chosen points pass, but every point is used: an object is
 * detected by its points together.
 * \code
 * pcl6d::MovingPointFilter<pcl::PointXYZI> filter;
 * for (std::size_t i = 0; i < clouds.size(); ++i)
 *   filter.addScan(clouds[i], T_world_scan[i]);
 * filter.setInputScan(3);
 * filter.filter(*standing);
 * \endcode
 * \ingroup moving_objects */
template <typename PointT>
class MovingPointFilter : public pcl::FilterIndices<PointT> {
public:
  using Ptr = pcl::shared_ptr<MovingPointFilter<PointT>>;
  using ConstPtr = pcl::shared_ptr<const MovingPointFilter<PointT>>;
  using PointCloudConstPtr = typename pcl::Filter<PointT>::PointCloudConstPtr;

  /** \param[in] extract_removed_indices fill getRemovedIndices() */
  explicit MovingPointFilter(bool extract_removed_indices = false);

  /** \brief Sets the voxel edge of surfaces [m], for scans added from now on; empty: derived
   * from each scan.
   * \throws BadArgument unless finite and > 0 */
  void
  setVoxel(const std::optional<double>& voxel)
  {
    scans_.setVoxel(voxel);
  }

  /** \brief Sets the scanner position in clouds added from now on [m]; empty: their
   * sensor_origin_. */
  void
  setOrigin(const std::optional<Eigen::Vector3f>& origin)
  {
    origin_ = origin;
  }

  /** \brief Sets the largest number of threads; never changes the result.
   * \param[in] num_threads 0: a thread per core */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    scans_.setNumberOfThreads(num_threads);
  }

  /** \brief Adds a scan, in the order of time. The cloud is kept by its pointer.
   * \param[in] T_world_scan
   * \param[in] sigma of the pose, relative to the poses of its neighbours
   * \return its index, from 0
   * \throws BadArgument the cloud is null, or as MovingScans::add() */
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

  /** \brief Filters an added scan next; like setInputCloud() with its cloud.
   * \throws BadArgument an index out of range */
  void
  setInputScan(std::size_t scan);

  /** \brief Filters given points of an added scan next, in its frame: a part of the scan, or
   * reduced points.
   * \throws BadArgument an index out of range, or the cloud is null */
  void
  setInputScan(std::size_t scan, const PointCloudConstPtr& cloud);

  /** \return one per point of an added cloud
   * \throws BadArgument an index out of range */
  std::vector<PointMotion>
  motion(std::size_t scan);

  /** \return whether rays contradict scans too much to classify points: every point is then
   * unknown, and kept */
  bool
  isBlind()
  {
    return scans_.isBlind();
  }

protected:
  /** \throws BadArgument the input cloud was not added, or an index is out of range */
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
  PointCloudConstPtr chosen_cloud_; ///< cloud for chosen_
};

} // namespace pcl6d
#include <pcl6d/moving_objects/pcl/impl/moving_point_filter.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(MovingPointFilter)
} // namespace pcl6d
