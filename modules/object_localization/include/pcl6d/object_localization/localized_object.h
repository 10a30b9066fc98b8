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
  /** kOk, or kRankDeficient: the surfaces leave a rotation or shift undetermined, for
   * example on a round model */
  Status status = Status::kOk;
  Eigen::Isometry3d T_scene_object = Eigen::Isometry3d::Identity();
  std::optional<PoseCovariance> covariance; ///< x y z roll pitch yaw [m, rad]
  double score = 0;            ///< visible fraction times (1 - free-space violation)
  double visible_fraction = 0; ///< of the surface that faces the scanner
  double rms = 0;              ///< [m]
  double evidence = 0; ///< points times a trust in [0, 1], lower for each contradiction
  std::vector<std::uint32_t> points; ///< points of the scene on the object, ascending
};

/** \brief Keeps, of objects that share points of one scan (of several models, for
 * example), the objects with the most evidence.
 * \param[in] max_shared share of the smaller object's points; in [0, 1]
 * \return most evidence first \throws BadArgument max_shared is invalid
 * \ingroup object_localization */
std::vector<LocalizedObject>
strongestObjects(std::vector<LocalizedObject> objects, double max_shared = 0.3);

} // namespace pcl6d
