// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/surface_patch.h>
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief pcl::NormalEstimation and pcl::NormalEstimationOMP: normals and curvatures of points
 * from their k nearest neighbours, or all within a radius; see SurfacePatch.
 *
 * All setters and getters of PCL's class, of which it is one, and setNumberOfThreads(). What
 * differs: sums are in double about each point; without a search method our KdTree is taken, for
 * organized clouds too; a pcl::search::KdTree with default settings is given the surface
 * as there, but our tree finds the same neighbours in its place (of points equally far
 * those of the smallest index). Any other search method is asked. Points on a line have no
 * normal (NaN), where PCL gives one of many. Both a k and a radius, or none, and
 * indices of no point are BadArgument, where PCL prints a message or crashes. \code
 * pcl6d::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
 * estimation.setInputCloud(cloud);
 * estimation.setKSearch(20);
 * estimation.compute(normals);
 * \endcode
 * \note Source: H. Hoppe et al., "Surface reconstruction from unorganized points", 1992; M.
 * Pauly, M. Gross, L. Kobbelt, "Efficient simplification of point-sampled surfaces", 2002
 * (curvature). \ingroup filters */
template <typename PointInT, typename PointOutT>
class NormalEstimation : public pcl::NormalEstimation<PointInT, PointOutT> {
public:
  using Ptr = pcl::shared_ptr<NormalEstimation<PointInT, PointOutT>>;
  using ConstPtr = pcl::shared_ptr<const NormalEstimation<PointInT, PointOutT>>;
  using Base = pcl::NormalEstimation<PointInT, PointOutT>;
  using typename Base::PointCloudConstPtr;
  using typename Base::PointCloudOut;

  /** \param[in] num_threads as setNumberOfThreads() */
  explicit NormalEstimation(unsigned int num_threads = 0);

  /** \throws BadArgument the cloud is null */
  void
  setInputCloud(const PointCloudConstPtr& cloud) override;

  /** \param[in] num_threads 0: one per core, but a single one where a search method is not one
   * of the k-d trees, as it may not bear more; never changes results */
  void
  setNumberOfThreads(unsigned int num_threads = 0)
  {
    num_threads_ = num_threads;
  }

  /** \brief The plane through some points of a cloud.
   * \param[out] plane a, b, c, d of a x + b y + c z + d = 0; NaN if there is none
   * \param[out] curvature see SurfacePatch; NaN if there is none
   * \return whether there is one
   * \throws BadArgument an index is not that of a point */
  bool
  computePointNormal(const pcl::PointCloud<PointInT>& cloud,
                     const pcl::Indices& indices,
                     Eigen::Vector4f& plane,
                     float& curvature);
  bool
  computePointNormal(const pcl::PointCloud<PointInT>& cloud,
                     const pcl::Indices& indices,
                     float& nx,
                     float& ny,
                     float& nz,
                     float& curvature);

protected:
  /** \throws BadArgument no cloud was given, or not just one of k and radius, or an index is not
   * that of a point of the input */
  bool
  initCompute() override;

private:
  void
  computeFeature(PointCloudOut& output) override;
  std::vector<SurfacePatch>
  patches();
  std::vector<SurfacePatch>
  patchesByTree(const KdTree<PointInT>& tree) const;
  std::vector<SurfacePatch>
  patchesBySearch() const;

  unsigned int num_threads_;
};

/** \brief Another name for those who write pcl::NormalEstimationOMP. */
template <typename PointInT, typename PointOutT>
using NormalEstimationOMP = NormalEstimation<PointInT, PointOutT>;

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/normal_estimation.hpp>

#define PCL6D_DECLARE_NORMALS_(Class, PointT)                                          \
  extern template class Class<PointT, pcl::Normal>;                                    \
  extern template class Class<PointT, pcl::PointNormal>;
namespace PCL6D_EXPORTS pcl6d {
PCL6D_FOR_POINT_TYPES(PCL6D_DECLARE_NORMALS_, NormalEstimation)
} // namespace pcl6d
#undef PCL6D_DECLARE_NORMALS_
