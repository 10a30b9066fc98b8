// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/plane_segmentation/pcl/plane_consensus_method.h>

#include <pcl/segmentation/sac_segmentation.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What PlaneSACSegmentation and PlaneSACSegmentationFromNormals share: PCL's
 * settings, honoured by findPlaneConsensus().
 *
 * What the settings mean:
 * - distance threshold [m]: points nearer than this are on a plane. > 0
 * - method type: SAC_RANSAC, SAC_RRANSAC and SAC_PROSAC: the plane with the most points
 *   on it. They differ in how PCL saves time, and all of it is done here anyway;
 *   PROSAC's order of the points is not needed. SAC_MSAC, SAC_RMSAC and SAC_MLESAC:
 *   the plane with the least sum of min(d^2, threshold^2), which is MLESAC's cost for
 *   outliers that are spread evenly (PCL's MSAC sums distances, and its MLESAC takes a
 *   sigma from the extent of the cloud). SAC_LMEDS: the plane with the least median of
 *   distances; right only if most points are on it
 * - maximum of iterations: the effort, in times that all points may be looked at. Draws
 *   are scored on a sample of the points, so that a large cloud gets hundreds of draws
 *   for one of PCL's. -1: 1000, as there; 0: 1
 * - probability that the best plane is found; in [0, 1]
 * - optimise coefficients: the plane is that of least squares of points on it, and the
 *   inliers are the points on that plane
 * - samples' maximum distance: only points so near each other are drawn together. The
 *   search must hold the input cloud
 * - axis and eps angle, of the models that have them: eps > 0 [rad] switches the limit
 *   on; the axis may have any length. A plane that leans more is turned to the limit
 * - number of threads: negative: one, 0: one per core; never changes the result
 * - indices: points in the order of the indices. Points that are not finite are on no
 *   plane
 * - radius limits: no plane has a radius. They come back from their getter, as there
 * - the constructor's `random`: draws depend on the time; else the same every time
 *
 * getMethod() and getModel() are there after segment(), as in PCL: a
 * PlaneConsensusMethod, and PCL's model with its limits. \ingroup plane_segmentation */
template <typename Base, typename PointT>
class PlaneSAC : public Base {
public:
  /** \param[in] random whether draws depend on the time */
  PlaneSAC(bool random = false) : Base(random), draws_by_time_(random) {}

  /** \brief The plane a x + b y + c z + d = 0 with a unit normal towards the sensor
   * (sensor_origin_ of the cloud), and the points on it, as indices in the input cloud,
   * in the order of setIndices(). Both are empty, with an error on the console, if
   * fewer than three points are finite, or all are on a line.
   * \throws BadArgument no input cloud, an index is not that of a point, a model or
   * method type that is not there, or a setting breaks its rule */
  void
  segment(pcl::PointIndices& inliers, pcl::ModelCoefficients& coefficients) override;

  /** \return the plane in double, which single floats cannot hold far from the origin,
   * and how the search ended; of the last segment() */
  const PlaneConsensus&
  result() const
  {
    return result_;
  }

protected:
  /** \brief Checks what the base class holds. \throws BadArgument see segment() */
  virtual void
  checkSettings() const;

  /** \return the settings as options */
  PlaneConsensusOptions
  consensusOptions() const;

  /** \return how the points are taken from the cloud; keeps what it needs alive */
  virtual std::function<ConsensusPoints()>
  packer() const;

  /** \return whether a model type is there */
  virtual bool
  hasModel(int model_type) const;

  /** \return the names of the model types that are there */
  virtual std::string
  modelNames() const;

private:
  std::optional<DirectionLimit>
  directionLimit() const;
  std::function<void(std::uint32_t, std::vector<std::uint32_t>&)>
  neighbours() const;
  void
  keepDistances(const pcl::Indices& inliers);

  bool draws_by_time_; // random_, which PCL's class for normals makes private
  PlaneConsensus result_;
};

/** \brief pcl::SACSegmentation for planes, that finds the right one: that with the most
 * points on it, where PCL takes the best of as many draws as 50 iterations allow.
 *
 * Models: SACMODEL_PLANE, SACMODEL_PERPENDICULAR_PLANE (the normal within eps of the
 * axis) and SACMODEL_PARALLEL_PLANE (the plane itself within eps of the axis); others
 * throw. All settings: see PlaneSAC. \code
 * pcl6d::PlaneSACSegmentation<pcl::PointXYZ> segmentation;
 * segmentation.setModelType(pcl::SACMODEL_PLANE);
 * segmentation.setMethodType(pcl::SAC_RANSAC);
 * segmentation.setDistanceThreshold(0.02); // [m]
 * segmentation.setInputCloud(cloud);
 * segmentation.segment(inliers, coefficients);
 * \endcode \ingroup plane_segmentation */
template <typename PointT>
class PlaneSACSegmentation : public PlaneSAC<pcl::SACSegmentation<PointT>, PointT> {
public:
  using Ptr = pcl::shared_ptr<PlaneSACSegmentation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const PlaneSACSegmentation<PointT>>;
  using PlaneSAC<pcl::SACSegmentation<PointT>, PointT>::PlaneSAC;

protected:
  std::string
  getClassName() const override
  {
    return "PlaneSACSegmentation";
  }
};

/** \brief pcl::SACSegmentationFromNormals for planes.
 *
 * Models: those of PlaneSACSegmentation, SACMODEL_NORMAL_PLANE and
 * SACMODEL_NORMAL_PARALLEL_PLANE (the plane's normal within eps of the axis); others
 * throw. With these two the distance of a point is (1 - w) d + w angle, d its distance
 * to the plane [m], angle between its normal and the plane's [rad], w the normal
 * distance weight times 1 - curvature: as in PCL. Points without a normal are on no
 * plane. The distance from the origin, for which PCL has no tolerance and so takes no
 * notice of it, must be 0 with SACMODEL_NORMAL_PARALLEL_PLANE; opening angles are
 * those of cones and come back from their getter. All other settings: see PlaneSAC.
 * \ingroup plane_segmentation */
template <typename PointT, typename PointNT>
class PlaneSACSegmentationFromNormals
: public PlaneSAC<pcl::SACSegmentationFromNormals<PointT, PointNT>, PointT> {
  using Shared = PlaneSAC<pcl::SACSegmentationFromNormals<PointT, PointNT>, PointT>;

public:
  using Ptr = pcl::shared_ptr<PlaneSACSegmentationFromNormals<PointT, PointNT>>;
  using ConstPtr =
      pcl::shared_ptr<const PlaneSACSegmentationFromNormals<PointT, PointNT>>;
  using Shared::Shared;

protected:
  void
  checkSettings() const override;
  std::function<ConsensusPoints()>
  packer() const override;
  bool
  hasModel(int model_type) const override;
  std::string
  modelNames() const override;
  std::string
  getClassName() const override
  {
    return "PlaneSACSegmentationFromNormals";
  }
};

} // namespace pcl6d
#include <pcl6d/plane_segmentation/pcl/impl/plane_sac_segmentation.hpp>

/** Calls MACRO(keyword, PointT, PointNT) for every precompiled pair. */
#define PCL6D_FOR_PLANE_SAC_(MACRO, keyword)                                           \
  MACRO(keyword, pcl::PointXYZ, pcl::Normal)                                           \
  MACRO(keyword, pcl::PointXYZI, pcl::Normal)                                          \
  MACRO(keyword, pcl::PointXYZRGB, pcl::Normal)                                        \
  MACRO(keyword, pcl::PointNormal, pcl::PointNormal)                                   \
  MACRO(keyword, pcl::PointXYZINormal, pcl::PointXYZINormal)
#define PCL6D_PLANE_SAC_(keyword, PointT, PointNT)                                     \
  keyword template class PlaneSAC<pcl::SACSegmentation<PointT>, PointT>;               \
  keyword template class PlaneSAC<pcl::SACSegmentationFromNormals<PointT, PointNT>,    \
                                  PointT>;                                             \
  keyword template class PlaneSACSegmentation<PointT>;                                 \
  keyword template class PlaneConsensusMethod<PointT>;                                 \
  keyword template class PlaneSACSegmentationFromNormals<PointT, PointNT>;
namespace PCL6D_EXPORTS pcl6d {
PCL6D_FOR_PLANE_SAC_(PCL6D_PLANE_SAC_, extern)
} // namespace pcl6d
