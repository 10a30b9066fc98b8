// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/global_registration/vertical.h>

#include <pcl/pcl_base.h>
#include <pcl/point_types.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Estimates the up direction of a cloud from its surfaces: estimateVertical() with the
 * calls of PCL's classes. PCL has no class for the vertical.
 *
 * The surfaces were seen from the sensor_origin_ of the cloud. Indices are honoured.
 * \code
 * pcl6d::VerticalEstimation<pcl::PointXYZ> vertical;
 * vertical.setInputCloud(cloud);
 * vertical.setExpectedUp(-Eigen::Vector3d::UnitY()); // a camera that looks along z
 * const pcl6d::VerticalEstimate found = vertical.compute();
 * if (found.is_sure)
 *   const Eigen::Matrix3d R_level_cloud = pcl6d::uprightRotation(found.up);
 * \endcode
 * \ingroup global_registration */
template <typename PointT, typename PointNT = pcl::Normal>
class VerticalEstimation : public pcl::PCLBase<PointT> {
public:
  using Ptr = pcl::shared_ptr<VerticalEstimation<PointT, PointNT>>;
  using ConstPtr = pcl::shared_ptr<const VerticalEstimation<PointT, PointNT>>;
  using NormalCloud = pcl::PointCloud<PointNT>;

  /** \brief The normals of the cloud, one per point, of any length; zero and NaN normals are
   * skipped. Null, unless set: normals are estimated from the reduced points. */
  void
  setInputNormals(const typename NormalCloud::ConstPtr& normals)
  {
    normals_ = normals;
  }
  const typename NormalCloud::ConstPtr&
  getInputNormals() const
  {
    return normals_;
  }

  /** \brief The sensor's own up: tells up from down, and decides where the surfaces do not;
   * z unless set. \throws BadArgument no unit vector */
  void
  setExpectedUp(const Eigen::Vector3d& up)
  {
    uprightRotation(up); // checks the length
    expected_ = up;
  }
  const Eigen::Vector3d&
  getExpectedUp() const
  {
    return expected_;
  }

  /** \param[in] num_threads 0: a thread per core; never changes the result */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    num_threads_ = num_threads;
  }

  /** \return as estimateVertical(), in the frame of the cloud
   * \throws BadArgument no cloud is set, an index is out of range, or the number of normals
   * differs from the number of points */
  VerticalEstimate
  compute();

private:
  typename NormalCloud::ConstPtr normals_;
  Eigen::Vector3d expected_ = Eigen::Vector3d::UnitZ();
  unsigned int num_threads_ = 0;
};

} // namespace pcl6d
#include <pcl6d/global_registration/pcl/impl/vertical_estimation.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(VerticalEstimation)
} // namespace pcl6d
