// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>
#include <pcl6d/registration/pose_information.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief An object found in a scan. */
struct LocalizedObject {
  std::string object_class;
  /** kOk, or kRankDeficient: the surfaces leave a turn or shift open, as on a model that
   * looks the same from all around */
  Status status = Status::kOk;
  Eigen::Isometry3d T_scene_object = Eigen::Isometry3d::Identity();
  std::optional<PoseCovariance> covariance; ///< x y z roll pitch yaw [m, rad]
  double score = 0;            ///< visible fraction less free-space violation
  double visible_fraction = 0; ///< of the surface that faces the scanner
  double rms = 0;              ///< [m]
  double evidence = 0; ///< points that it explains, less for what contradicts it
  std::vector<std::uint32_t> points; ///< of the scene that lie on it, ascending
};

/** \brief Of objects that share points of one scan, such as those of several models, those
 * with the most evidence.
 * \param[in] max_shared of the points of the smaller one; in [0, 1]
 * \return most evidence first \throws BadArgument max_shared breaks its rule
 * \ingroup object_localization */
std::vector<LocalizedObject>
strongestObjects(std::vector<LocalizedObject> objects, double max_shared = 0.3);

} // namespace pcl6d
