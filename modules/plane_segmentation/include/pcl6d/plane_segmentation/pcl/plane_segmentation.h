// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <pcl/ModelCoefficients.h>
#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Finds planes in a cloud, with the calls of PCL's classes: every plane like
 * pcl::OrganizedMultiPlaneSegmentation, or the largest like pcl::SACSegmentation. The
 * derived class detects candidates; finishing them is common (PlaneOptions).
 *
 * The sensor stood at the cloud's sensor_origin_. In an organized cloud, neighbours are
 * defined by the grid. With setIndices() only the chosen points are used. \code
 * pcl6d::RegionGrowingPlaneSegmentation<pcl::PointXYZ> segmentation;
 * segmentation.setInputCloud(cloud);
 * pcl6d::PlaneSegments found;
 * segmentation.segment(found);
 * \endcode
 * \ingroup plane_segmentation */
template <typename PointT>
class PlaneSegmentation : public pcl::PCLBase<PointT> {
public:
  using Ptr = pcl::shared_ptr<PlaneSegmentation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const PlaneSegmentation<PointT>>;

  ~PlaneSegmentation() override = default;

  /** \brief Criteria of a plane. */
  PlaneOptions&
  planeOptions()
  {
    return plane_options_;
  }

  /** \brief How many threads may run; never changes the result. \param[in] num_threads
   * 0: one per core */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    num_threads_ = num_threads;
  }

  /** \brief Finds planes, largest first, with hulls, and the unassigned points, as
   * indices into the input cloud. \throws BadArgument no input cloud, an index out of
   * range, or an option is invalid */
  void
  segment(PlaneSegments& segments);

  /** \brief Finds planes, largest first: a x + b y + c z + d = 0 with a unit normal
   * towards the sensor, in the types of PCL's classes. \throws BadArgument see above */
  void
  segment(std::vector<pcl::ModelCoefficients>& coefficients,
          std::vector<pcl::PointIndices>& inliers);

  /** \brief Finds the largest plane only; both results are empty without a plane.
   * \throws BadArgument see above */
  void
  segment(pcl::PointIndices& inliers, pcl::ModelCoefficients& coefficients);

protected:
  PlaneSegmentation() = default;

  /** \brief Detects candidates of planes. */
  virtual PlaneCandidates
  findCandidates(const PlaneCloud& cloud) const = 0;

private:
  PlaneOptions plane_options_;
  unsigned int num_threads_ = 0;
};

/** \brief Planes by region growing, see regionGrowingCandidates(): the fastest and the
 * default. \ingroup plane_segmentation */
template <typename PointT>
class RegionGrowingPlaneSegmentation : public PlaneSegmentation<PointT> {
public:
  using Ptr = pcl::shared_ptr<RegionGrowingPlaneSegmentation<PointT>>;

  /** \brief Limits for growing a region. */
  RegionGrowingOptions&
  options()
  {
    return options_;
  }

protected:
  PlaneCandidates
  findCandidates(const PlaneCloud& cloud) const override
  {
    return regionGrowingCandidates(cloud, options_);
  }

private:
  RegionGrowingOptions options_;
};

/** \brief Planes by random samples, see ransacCandidates(). \ingroup plane_segmentation */
template <typename PointT>
class RansacPlaneSegmentation : public PlaneSegmentation<PointT> {
public:
  using Ptr = pcl::shared_ptr<RansacPlaneSegmentation<PointT>>;

  /** \brief How samples are drawn. */
  RansacPlaneOptions&
  options()
  {
    return options_;
  }

protected:
  PlaneCandidates
  findCandidates(const PlaneCloud& cloud) const override
  {
    return ransacCandidates(cloud, options_);
  }

private:
  RansacPlaneOptions options_;
};

/** \brief Planes by votes, see houghCandidates(). \ingroup plane_segmentation */
template <typename PointT>
class HoughPlaneSegmentation : public PlaneSegmentation<PointT> {
public:
  using Ptr = pcl::shared_ptr<HoughPlaneSegmentation<PointT>>;

  /** \brief Variant of the votes, and size of the cells. */
  HoughPlaneOptions&
  options()
  {
    return options_;
  }

protected:
  PlaneCandidates
  findCandidates(const PlaneCloud& cloud) const override
  {
    return houghCandidates(cloud, options_);
  }

private:
  HoughPlaneOptions options_;
};

} // namespace pcl6d
#include <pcl6d/plane_segmentation/pcl/impl/plane_segmentation.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(PlaneSegmentation)
PCL6D_DECLARE_INSTANCES(RegionGrowingPlaneSegmentation)
PCL6D_DECLARE_INSTANCES(RansacPlaneSegmentation)
PCL6D_DECLARE_INSTANCES(HoughPlaneSegmentation)
} // namespace pcl6d
