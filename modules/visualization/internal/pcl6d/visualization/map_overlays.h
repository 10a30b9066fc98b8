// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/object_pose.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/visualization/map_cloud.h>
#include <pcl6d/visualization/overlay.h>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief State of a link between two scans. */
enum class LinkState {
  kUsed,     ///< matched, counts
  kOdometry, ///< joined by the odometry alone
  kRefused   ///< looked at, does not count
};

/** \brief A link between two poses of a trajectory. */
struct ViewLink {
  std::size_t from = 0; ///< index of a pose
  std::size_t to = 0;
  LinkState state = LinkState::kUsed;
  double rms = 0; ///< [m] of the point pairs; NaN: not known
};

/** \brief A pose graph: used links from green (small residual) to red (large), odometry
 * links blue, rejected links grey and thin; poses as dots, doubtful poses red.
 * \param[in] doubtful per pose, or empty
 * \throws BadArgument a link to no pose, or not one entry per pose
 * \ingroup visualization */
Overlay
graphOverlay(const Trajectory& poses,
             const std::vector<ViewLink>& links,
             const std::vector<bool>& doubtful,
             Background background);

/** \brief Covariances of positions: the ellipsoid of three standard deviations as three
 * circles, enlarged by a common round factor, which the legend tells.
 * \param[in] covariances of x y z in the axes of the world [m^2], one per pose; without
 * value: not known, the pose is a dot
 * \throws BadArgument not one per pose \ingroup visualization */
Overlay
covarianceOverlay(const Trajectory& poses,
                  const std::vector<std::optional<Eigen::Matrix3d>>& covariances,
                  Background background);

/** \brief The boxes of objects with their classes, one colour per class.
 * \ingroup visualization */
Overlay
objectOverlay(const std::vector<ObjectPose>& objects, Background background);

/** \brief Bright colours for unordered items; consecutive numbers get distinct hues, in
 * steps of the golden ratio. */
Colour
distinctColour(std::size_t number);

} // namespace pcl6d
