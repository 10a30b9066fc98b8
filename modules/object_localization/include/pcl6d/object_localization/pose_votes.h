// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/pair_features.h>
#include <pcl6d/search/point_tree.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A pose that pairs of points voted for. */
struct VotedPose {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  double votes = 0;
};

/** \brief Knobs of voteForPoses(). */
struct PoseVoteOptions {
  int turn_steps = 30;      ///< of the angle about the normal, in a turn; 8 to 90
  int reference_stride = 5; ///< every n-th point of the scene is a first point; >= 1
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief For each of some points of a scene the pose of the model that most pairs with
 * it agree on.
 * \param[in] scene reduced as the model is \param[in] tree over its points
 * \return in the order of the points; those without a vote are left out
 * \throws BadArgument an option breaks its rule
 * \note Source: Drost et al. 2010, as PairFeatureTable. */
std::vector<VotedPose>
voteForPoses(const PairFeatureTable& table,
             const OrientedPoints& scene,
             const PointTree& tree,
             const PoseVoteOptions& options = {});

} // namespace pcl6d
