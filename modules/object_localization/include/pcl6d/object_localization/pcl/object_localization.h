// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/object_localization/object_localizer.h>

#include <pcl/pcl_base.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Finds an object of known shape in a cloud and its pose in six degrees of
 * freedom, with the calls that users know from PCL's recognition, but without key points,
 * descriptors and correspondences to make first: pcl::Hough3DGrouping,
 * pcl::GeometricConsistencyGrouping.
 *
 * The sensor stood at the cloud's sensor_origin_ and looked along its
 * sensor_orientation_; results are in the cloud's frame. Normals of model and cloud are
 * estimated. With setIndices() only the chosen points are looked at. \code
 * pcl6d::ObjectLocalization<pcl::PointXYZ> recognition;
 * recognition.setModelCloud(carton);
 * recognition.setInputCloud(scene);
 * pcl6d::ObjectTransformations found; // T_scene_model
 * recognition.recognize(found);
 * \endcode \ingroup object_localization */
template <typename PointT>
class ObjectLocalization : public pcl::PCLBase<PointT> {
public:
  using Ptr = pcl::shared_ptr<ObjectLocalization<PointT>>;
  using ConstPtr = pcl::shared_ptr<const ObjectLocalization<PointT>>;
  using PointCloudConstPtr = typename pcl::PCLBase<PointT>::PointCloudConstPtr;
  using Transformations =
      std::vector<Eigen::Matrix4f, Eigen::aligned_allocator<Eigen::Matrix4f>>;

  /** \brief What to look for, as a cloud [m].
   * \throws BadArgument as ObjectModel::fromCloud() */
  void
  setModelCloud(const PointCloudConstPtr& model,
                const std::string& object_class = "object");

  /** \brief The same, as a mesh or from the model store. */
  void
  setModel(const ObjectModel& model);

  /** \brief When a pose is believed; counts from the next model on. */
  LocalizerOptions&
  options()
  {
    return options_;
  }

  /** \brief Where the objects are, best first.
   * \param[out] transformations from the model's frame to the cloud's
   * \return whether there is any
   * \throws BadArgument no model or no input cloud, an index is not that of a point, fewer
   * than 10 finite points, or an option breaks its rule */
  bool
  recognize(Transformations& transformations);

  /** \return what recognize() found, with covariances, scores and the points on each
   * object as places in the input cloud; T_scene_object in double */
  const std::vector<LocalizedObject>&
  objects() const
  {
    return objects_;
  }

private:
  LocalizerOptions options_;
  std::optional<ObjectLocalizer> localizer_;
  std::vector<LocalizedObject> objects_;
};

/** \brief Poses as PCL's recognition gives them. */
using ObjectTransformations = ObjectLocalization<pcl::PointXYZ>::Transformations;

} // namespace pcl6d
#include <pcl6d/object_localization/pcl/impl/object_localization.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(ObjectLocalization)
} // namespace pcl6d
