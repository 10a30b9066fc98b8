// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose_graph.h>

/** \file Residual of a link between two poses. A pose is changed from the right, T <- T [R(dr),
 * dt]: small motions (dt [m], dr [rad]) are in its own axes. */
namespace PCL6D_EXPORTS pcl6d {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** \brief The error of a link and its derivatives. \ingroup graph_relaxation */
struct LinkError {
  Vector6 error = Vector6::Zero();  ///< translation [m], twice the quaternion's vector
  Matrix6 J_from = Matrix6::Zero(); ///< by a small motion of the pose link.from
  Matrix6 J_to = Matrix6::Zero();   ///< by a small motion of the pose link.to
};

/** \return e = (t, 2 vec(q)), q.w >= 0, of the error pose T_from_to^-1 T_a^-1 T_b; for
 * small turns its last three entries are the rotation vector [rad]
 * \param[in] T_a, T_b the poses link.from and link.to */
Vector6
linkError(const PoseLink& link,
          const Eigen::Isometry3d& T_a,
          const Eigen::Isometry3d& T_b);

/** \return the error with its derivatives */
LinkError
linearizeLink(const PoseLink& link,
              const Eigen::Isometry3d& T_a,
              const Eigen::Isometry3d& T_b);

/** \return e^T information e, summed over the links
 * \throws BadArgument see checkPoseGraph() */
double
chi2Of(const PoseGraph& graph);

/** \return Ad of a pose: X exp(d) = exp(Ad d) X for small motions d (translation,
 * rotation) */
Matrix6
adjointOf(const Eigen::Isometry3d& X);

/** \throws BadArgument the numbers of ids and poses differ, if ids are given; a link to an
 * index out of range or from a pose to itself; a non-finite value; a pose that is not rigid;
 * information that is not symmetric or not positive semidefinite, see informationFault() */
void
checkPoseGraph(const PoseGraph& graph);

} // namespace pcl6d
