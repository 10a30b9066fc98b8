// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/registration/pcl/correspondence_rejector.h>

#include <pcl/search/kdtree.h>

#include <functional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Leaves the pairs with like normals: drop-in for
 * pcl::registration::CorrespondenceRejectorSurfaceNormal.
 *
 * The cosine is between directions (PCL: the scalar product, whatever the lengths). Pairs with a
 * normal of zero length or not finite are left out. Clouds and normals may be set in any order
 * without initializeDataContainer(); clouds of points are ignored, like in PCL.
 * \ingroup registration */
class CorrespondenceRejectorSurfaceNormal : public SelectingRejector {
public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorSurfaceNormal>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorSurfaceNormal>;

  CorrespondenceRejectorSurfaceNormal()
  : SelectingRejector("CorrespondenceRejectorSurfaceNormal")
  {}

  /** \brief Cosine of the largest angle between normals; 1 unless set, like in PCL: rejects every
   * pair, with a warning. \throws BadArgument NaN */
  void
  setThreshold(double threshold);
  double
  getThreshold() const
  {
    return threshold_;
  }

  /** \brief Forgets the clouds and normals. */
  template <typename PointT, typename NormalT>
  void
  initializeDataContainer()
  {
    source_ = target_ = Side();
  }

  /** \throws BadArgument null */
  template <typename PointT>
  void
  setInputSource(const typename pcl::PointCloud<PointT>::ConstPtr& cloud)
  {
    requireGiven(cloud, "the input source");
    source_.cloud.set<PointT>(cloud);
  }
  template <typename PointT>
  void
  setInputTarget(const typename pcl::PointCloud<PointT>::ConstPtr& cloud)
  {
    requireGiven(cloud, "the input target");
    target_.cloud.set<PointT>(cloud);
  }
  /** \return null if no cloud was set \throws BadArgument the cloud has another point type */
  template <typename PointT>
  typename pcl::PointCloud<PointT>::ConstPtr
  getInputSource() const
  {
    return source_.cloud.get<PointT>();
  }
  template <typename PointT>
  typename pcl::PointCloud<PointT>::ConstPtr
  getInputTarget() const
  {
    return target_.cloud.get<PointT>();
  }

  /** \brief No search is needed, nor does PCL's class use it. \throws BadArgument null */
  template <typename PointT>
  void
  setSearchMethodTarget(const typename pcl::search::KdTree<PointT>::Ptr& tree,
                        bool /*force_no_recompute*/ = false)
  {
    requireGiven(tree, "the search method");
  }

  /** \brief One normal per point of the source; read at each selection.
   * \throws BadArgument null */
  template <typename PointT, typename NormalT>
  void
  setInputNormals(const typename pcl::PointCloud<NormalT>::ConstPtr& normals)
  {
    setNormals<NormalT>(normals, source_);
  }
  template <typename PointT, typename NormalT>
  void
  setTargetNormals(const typename pcl::PointCloud<NormalT>::ConstPtr& normals)
  {
    setNormals<NormalT>(normals, target_);
  }
  /** \return null if no normals were set \throws BadArgument the normals have another type */
  template <typename NormalT>
  typename pcl::PointCloud<NormalT>::ConstPtr
  getInputNormals() const
  {
    return source_.normals.get<NormalT>();
  }
  template <typename NormalT>
  typename pcl::PointCloud<NormalT>::ConstPtr
  getTargetNormals() const
  {
    return target_.normals.get<NormalT>();
  }

  // How PCL's pipelines hand over the normals. BadArgument: null, or without normals.
  bool
  requiresSourceNormals() const override
  {
    return true;
  }
  bool
  requiresTargetNormals() const override
  {
    return true;
  }
  void
  setSourceNormals(pcl::PCLPointCloud2::ConstPtr cloud) override;
  void
  setTargetNormals(pcl::PCLPointCloud2::ConstPtr cloud) override;
  void
  setSourcePoints(pcl::PCLPointCloud2::ConstPtr cloud) override;
  void
  setTargetPoints(pcl::PCLPointCloud2::ConstPtr cloud) override;

protected:
  /** \throws BadArgument normals are missing, or the index of a pair is out of range */
  pcl::Correspondences
  select(const pcl::Correspondences& original) override;

private:
  struct Side {
    registration::AnyCloud cloud, normals;
    std::function<Normals()> read; ///< the normals
  };

  template <typename NormalT>
  void
  setNormals(const typename pcl::PointCloud<NormalT>::ConstPtr& normals, Side& side)
  {
    requireGiven(normals, "the cloud of normals");
    side.normals.set<NormalT>(normals);
    side.read = [normals] {
      Normals read;
      read.reserve(normals->size());
      for (const auto& point : *normals)
        read.emplace_back(point.getNormalVector3fMap());
      return read;
    };
  }

  double threshold_ = 1;
  Side source_, target_;
};

} // namespace pcl6d
