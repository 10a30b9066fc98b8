// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/plane_segmentation/pcl/plane_consensus_method.h>

#include <pcl/segmentation/sac_segmentation.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Common base of PlaneSACSegmentation and PlaneSACSegmentationFromNormals:
 * PCL's settings, applied to findPlaneConsensus().
 *
 * The settings:
 * - distance threshold [m]: nearer points are on a plane. > 0
 * - method type: SAC_RANSAC, SAC_RRANSAC and SAC_PROSAC: the plane with the most
 *   points. In PCL these methods differ in how they save time; here they are equal, and
 *   PROSAC's order of the points is not needed. SAC_MSAC, SAC_RMSAC and SAC_MLESAC: the
 *   plane with the least sum of min(d^2, threshold^2), which is MLESAC's cost for
 *   evenly spread outliers (PCL's MSAC sums distances, and its MLESAC takes a sigma
 *   from the extent of the cloud). SAC_LMEDS: the plane with the least median of
 *   distances; right only if most points are on the plane
 * - maximum of iterations: the effort, as a number of passes over the cloud. Draws are
 *   scored on a sample of the points, so a large cloud gets hundreds of draws for one
 *   draw of PCL. -1: 1000, as in PCL; 0: 1
 * - probability to find the best plane; in [0, 1]
 * - optimise coefficients: the plane is the least-squares fit to its points, and the
 *   inliers are the points on the fitted plane
 * - samples' maximum distance: points of a draw are at most this far from the first.
 *   The search must hold the input cloud
 * - axis and eps angle, for models with an axis: eps > 0 [rad] switches the limit on;
 *   the axis may have any length. A plane that leans more is turned to the limit
 * - number of threads: negative: one, 0: one per core; never changes the result
 * - indices: points in the order of the indices. Non-finite points are on no plane
 * - radius limits: ignored, a plane has no radius; returned by their getter, as in PCL
 * - the constructor's `random`: draws depend on the time; otherwise on a fixed seed
 *
 * getMethod() and getModel() are valid after segment(), as in PCL: a
 * PlaneConsensusMethod, and PCL's model with its limits. \ingroup plane_segmentation */
template <typename Base, typename PointT>
class PlaneSAC : public Base {
public:
  /** \param[in] random whether draws depend on the time */
  PlaneSAC(bool random = false) : Base(random), draws_by_time_(random) {}

  /** \brief Finds the plane a x + b y + c z + d = 0 with a unit normal towards the
   * sensor (sensor_origin_ of the cloud). Its points are returned as indices into the
   * input cloud, in the order of setIndices(). Both results are empty, with an error on
   * the console, if fewer than three points are finite or if the points are collinear.
   * \throws BadArgument no input cloud, an index out of range, an unknown model or
   * method type, or a setting is invalid */
  void
  segment(pcl::PointIndices& inliers, pcl::ModelCoefficients& coefficients) override;

  /** \return plane of the last segment() in double, as single floats are too coarse far
   * from the origin, and status of the search */
  const PlaneConsensus&
  result() const
  {
    return result_;
  }

protected:
  /** \brief Checks the settings of the base class. \throws BadArgument see segment() */
  virtual void
  checkSettings() const;

  /** \return the settings as options */
  PlaneConsensusOptions
  consensusOptions() const;

  /** \return a function that packs the points of the cloud; keeps its inputs alive */
  virtual std::function<ConsensusPoints()>
  packer() const;

  /** \return whether a model type is supported */
  virtual bool
  hasModel(int model_type) const;

  /** \return the names of the supported model types */
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

/** \brief pcl::SACSegmentation for planes that finds the plane with the most points.
 * PCL takes the best of the draws within 50 iterations.
 *
 * Models: SACMODEL_PLANE, SACMODEL_PERPENDICULAR_PLANE (the normal within eps of the
 * axis) and SACMODEL_PARALLEL_PLANE (the plane itself within eps of the axis); others
 * throw. Settings: see PlaneSAC. \code
 * pcl6d::PlaneSACSegmentation<pcl::PointXYZ> segmentation;
 * segmentation.setModelType(pcl::SACMODEL_PLANE);
 * segmentation.setMethodType(pcl::SAC_RANSAC);
 * segmentation.setDistanceThreshold(0.02); // [m]
 * segmentation.setInputCloud(cloud);
 * segmentation.segment(inliers, coefficients);
 * \endcode
 * \ingroup plane_segmentation */
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
 * Models: the models of PlaneSACSegmentation, SACMODEL_NORMAL_PLANE and
 * SACMODEL_NORMAL_PARALLEL_PLANE (the plane's normal within eps of the axis); others
 * throw. For the last two, the distance of a point is (1 - w) d + w angle, as in PCL: d
 * its distance to the plane [m], angle between its normal and the plane's [rad], w the
 * normal distance weight times 1 - curvature. Points without a normal are on no plane.
 * The distance from the origin must be 0 with SACMODEL_NORMAL_PARALLEL_PLANE, as PCL
 * ignores it for lack of a tolerance. Opening angles apply to cones only and are
 * returned by their getter. Settings: see PlaneSAC.
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
