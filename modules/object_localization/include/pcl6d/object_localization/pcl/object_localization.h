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
 * freedom. The calls follow PCL's recognition (pcl::Hough3DGrouping,
 * pcl::GeometricConsistencyGrouping), but need no key points, descriptors or
 * correspondences.
 *
 * The sensor stood at the cloud's sensor_origin_ and looked along its
 * sensor_orientation_; results are in the cloud's frame. Normals of model and cloud are
 * estimated. With setIndices() only the chosen points are used. \code
 * pcl6d::ObjectLocalization<pcl::PointXYZ> recognition;
 * recognition.setModelCloud(carton);
 * recognition.setInputCloud(scene);
 * pcl6d::ObjectTransformations found; // T_scene_model
 * recognition.recognize(found);
 * \endcode
 * \ingroup object_localization */
template <typename PointT>
class ObjectLocalization : public pcl::PCLBase<PointT> {
public:
  using Ptr = pcl::shared_ptr<ObjectLocalization<PointT>>;
  using ConstPtr = pcl::shared_ptr<const ObjectLocalization<PointT>>;
  using PointCloudConstPtr = typename pcl::PCLBase<PointT>::PointCloudConstPtr;
  using Transformations =
      std::vector<Eigen::Matrix4f, Eigen::aligned_allocator<Eigen::Matrix4f>>;

  /** \brief Sets the model to search for, as a cloud [m].
   * \throws BadArgument see ObjectModel::fromCloud() */
  void
  setModelCloud(const PointCloudConstPtr& model,
                const std::string& object_class = "object");

  /** \brief Sets the model to search for, made from a mesh or the model store. */
  void
  setModel(const ObjectModel& model);

  /** \brief Criteria for a pose; used from the next model on. */
  LocalizerOptions&
  options()
  {
    return options_;
  }

  /** \brief Finds the poses of the objects, best first.
   * \param[out] transformations from the model's frame to the cloud's
   * \return whether an object was found
   * \throws BadArgument no model or no input cloud, an index out of range, fewer than
   * 10 finite points, or an option is invalid */
  bool
  recognize(Transformations& transformations);

  /** \return the results of recognize(), with covariances, scores and the points on
   * each object as indices into the input cloud; T_scene_object in double */
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

/** \brief Poses in the type of PCL's recognition. */
using ObjectTransformations = ObjectLocalization<pcl::PointXYZ>::Transformations;

} // namespace pcl6d
#include <pcl6d/object_localization/pcl/impl/object_localization.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(ObjectLocalization)
} // namespace pcl6d
