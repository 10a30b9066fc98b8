// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/line_growth.h>
#include <pcl6d/filters/surface_patch.h>
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief pcl::NormalEstimation and pcl::NormalEstimationOMP: normals and curvatures of points from
 * their k nearest neighbours, or every neighbour within a radius; see SurfacePatch.
 *
 * A subclass of PCL's class, with its setters and getters and setNumberOfThreads(). Differences:
 * sums are in double about each point. Without a search method pcl6d::KdTree is used, for organized
 * clouds, too; a pcl::search::KdTree with default settings is given the surface like in PCL, but
 * pcl6d::KdTree finds its neighbours (equally far points by the smallest index). Any other search
 * method is used unchanged. Points on a line have no normal (NaN), where PCL gives an arbitrary
 * normal. In a scan of lines far apart, for example of a spinning lidar at the viewpoint, a patch
 * of points on one line grows across lines, see setLineGrowth(). Both k and radius, or neither, and
 * indices out of range are BadArgument, where PCL prints a message or crashes.
 * \code
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

  /** \param[in] num_threads see setNumberOfThreads() */
  explicit NormalEstimation(unsigned int num_threads = 0);

  /** \throws BadArgument the cloud is null */
  void
  setInputCloud(const PointCloudConstPtr& cloud) override;

  /** \param[in] num_threads 0: a thread per core, but a single thread for a search method other
   * than the k-d trees, which may not be thread-safe; never changes results */
  void
  setNumberOfThreads(unsigned int num_threads = 0)
  {
    num_threads_ = num_threads;
  }

  /** \brief Whether patches of points on one line (second standard deviation at most 0.3 of
   * the first) grow across lines, see LineSurface; patches that stay a line have no normal
   * (NaN). kAuto unless set: patches grow if the surface, seen from the viewpoint, consists
   * of lines or rings; otherwise results are bit-identical to kNever. computePointNormal()
   * never grows patches. */
  void
  setLineGrowth(LineGrowth growth)
  {
    line_growth_ = growth;
  }
  LineGrowth
  getLineGrowth() const
  {
    return line_growth_;
  }

  /** \brief The plane through chosen points of a cloud.
   * \param[out] plane a, b, c, d of a x + b y + c z + d = 0; NaN without a plane
   * \param[out] curvature see SurfacePatch; NaN without a plane
   * \return whether the points have a plane
   * \throws BadArgument an index is out of range */
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
  /** \throws BadArgument no cloud was given, or not exactly one of k and radius, or an index
   * is out of range */
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
  void
  growAcrossLines(std::vector<SurfacePatch>& patches) const;

  unsigned int num_threads_;
  LineGrowth line_growth_ = LineGrowth::kAuto;
};

/** \brief Alias for code with pcl::NormalEstimationOMP. */
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
