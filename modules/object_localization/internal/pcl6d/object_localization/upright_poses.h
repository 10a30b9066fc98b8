// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/object_symmetry.h>
#include <pcl6d/object_localization/pose_votes.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Distances to a surface, in cells of a grid around it. \ingroup
 * object_localization */
class DistanceField {
public:
  /** \param[in] points of the surface [m] \param[in] cell [m] > 0
   * \param[in] reach [m] largest distance stored; > cell
   * \throws BadArgument no points, or cell or reach is invalid */
  DistanceField(const Points& points, double cell, double reach);

  /** \return the distance [m] of the middle of a point's cell, at most reach() */
  double
  at(const Eigen::Vector3d& point) const;

  double
  reach() const
  {
    return reach_;
  }
  double
  cell() const
  {
    return cell_;
  }

private:
  double cell_;
  double reach_;
  Eigen::Vector3d origin_;
  Eigen::Vector3i size_;
  std::vector<float> distances_;
};

/** \brief Fits an upright object of known shape to points (book 7.2.2, step 2, with
 * every heading and shift instead of the centroid). Headings in steps of 5 deg and
 * shifts in steps of a cell are scored by the mean distance of the points to the model.
 * \param[in] model distances to its surface
 * \param[in] box of the model [m], which stands on the lower side
 * \param[in] points of a scan [m]
 * \param[in] T_scene_base z up, the plane z = 0 supports the object
 * \param[in] max_poses to return
 * \return the best distinct poses, best first; votes: from 0, no point is near the
 * model, to 1 \ingroup object_localization */
std::vector<VotedPose>
uprightPoses(const DistanceField& model,
             const Eigen::AlignedBox3d& box,
             const ObjectSymmetry& symmetry,
             const Points& points,
             const Eigen::Isometry3d& T_scene_base,
             std::size_t max_poses);

} // namespace pcl6d
