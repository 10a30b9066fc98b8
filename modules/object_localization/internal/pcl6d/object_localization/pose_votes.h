// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/pair_features.h>
#include <pcl6d/search/point_tree.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A pose and the votes of the point pairs for it. */
struct VotedPose {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  double votes = 0;
};

/** \brief Knobs of voteForPoses(). */
struct PoseVoteOptions {
  int turn_steps = 30;      ///< steps of the angle about the normal in a turn; 8 to 90
  int reference_stride = 5; ///< every n-th point of the scene is a first point; >= 1
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief For every n-th point of a scene, the model pose with the most votes of point
 * pairs.
 * \param[in] scene reduced to the model's spacing \param[in] tree over the scene's
 * points
 * \return in the order of the points; points without a vote are left out
 * \throws BadArgument an option is invalid
 * \note Source: Drost et al. 2010, see PairFeatureTable. */
std::vector<VotedPose>
voteForPoses(const PairFeatureTable& table,
             const OrientedPoints& scene,
             const PointTree& tree,
             const PoseVoteOptions& options = {});

} // namespace pcl6d
