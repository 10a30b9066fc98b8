// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/object_localizer.h>
#include <pcl6d/object_localization/pose_check.h>

/** \file From a rough pose of an object to a precise one. Internal to the module. */
namespace pcl6d {

/** \brief The surface of a scan with what finds places on it. */
struct SceneSurface {
  explicit SceneSurface(OrientedPoints surface)
  : oriented(std::move(surface)), tree(oriented.points)
  {}
  OrientedPoints oriented;
  PointTree tree;
};

/** \brief A pose that may be that of an object. */
struct ObjectCandidate {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  PoseCheck check;
};

/** \brief ICP of the model's facing part to the surface, twice, as the pose says which part
 * faces the scanner; then the check. \param[in] voxel [m] of both surfaces */
ObjectCandidate
refineOnSurface(const LocalizationScene& scene,
                const SceneSurface& surface,
                const OrientedPoints& model,
                const Eigen::Isometry3d& guess,
                double voxel);

/** \brief ICP of the whole model to all points around it. \return pose, covariance, rms,
 * status and points of the object; where ICP fails, those of the candidate */
LocalizedObject
refineOnPoints(const LocalizationScene& scene,
               const OrientedPoints& model,
               const ObjectCandidate& candidate,
               double voxel);

} // namespace pcl6d
