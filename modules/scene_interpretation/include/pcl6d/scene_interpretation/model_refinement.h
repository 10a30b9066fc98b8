// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/status.h>
#include <pcl6d/plane_segmentation/plane_segment.h>

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of refineModel(). */
struct RefinementOptions {
  /// exact direction up; default: estimated together with the normals
  std::optional<Eigen::Vector3d> up;
  double max_turn = 0.17453292519943295; ///< [rad] of any plane: 10 deg; in (0, pi/4)
  double max_move = 0.1;                 ///< [m] of any point of a plane; > 0
  double significance = 3; ///< standard deviations that a plane may turn at most; > 0
  /// [m] standard deviation of each square metre of a plane due to errors of the scans'
  /// poses, besides the noise of the points; >= 0
  double map_position_error = 0.005;
  /// [rad] standard deviation of a whole plane, of any size, due to the poses: 0.2 deg;
  /// >= 0
  double map_angle_error = 0.003490658503988659;
  bool project = true; ///< project points onto their plane; false: keep their noise
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief The kind of plane after refinement. */
enum class RefinedKind {
  kUnchanged,  ///< no label, or refused
  kHorizontal, ///< exactly
  kVertical    ///< exactly, and along the axes of its frame
};

const char*
toString(RefinedKind kind);

/** \brief Change of a plane. */
struct PlaneChange {
  RefinedKind kind = RefinedKind::kUnchanged;
  std::size_t frame = 0;   ///< of a vertical plane: index into RefinedModel::headings
  double turn = 0;         ///< [rad] of its normal
  double uncertainty = 0;  ///< [rad] standard deviation of its normal in the direction
                           ///< of turn
  double shift = 0;        ///< [m] along its normal, of the centroid
  double largest_move = 0; ///< [m] of a corner of its hull
  std::string refusal;     ///< rejected change and reason; empty: no change rejected
};

/** \brief A refined model. */
struct RefinedModel {
  Status status = Status::kOk;      ///< kRankDeficient: no plane has a label
  std::vector<PlaneSegment> planes; ///< the input planes, with exact normals and new
                                    ///< hulls
  Points points; ///< the input points, inliers moved with their plane
  std::vector<PlaneChange> changes; ///< per plane
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  /// heading of each frame, orthogonal to up; the frame's walls are parallel or
  /// orthogonal to it; the frame with the largest area first
  std::vector<Eigen::Vector3d> headings;
};

/** \brief Makes the labelled planes of a model exactly parallel, orthogonal, horizontal
 * and vertical, and moves their points with them (book 7.1.3).
 *
 * Labelled planes that are level within max_turn get the vertical as normal. Upright
 * planes are grouped into frames of parallel and orthogonal walls, as far as the
 * uncertainty of their normals allows. One frame is a Manhattan world; a wall that fits
 * no frame gets a frame of its own and becomes vertical only. The vertical and one
 * heading per frame jointly minimise the sum of n^T W n over the normals by the
 * Gauss-Newton method. W is the inverse covariance of a plane's fit: the noise of its
 * points, and map_position_error. Without map_position_error, W is the scatter of the
 * points over their variance, and the sum is their squared distances to planes through
 * their centroids, as in the book.
 *
 * A plane is taken out if its turn exceeds its uncertainty (significance) or max_turn,
 * or if it moves by more than max_move: first out of its frame, then out of the
 * vertical planes. So a wall that clearly leans keeps leaning. Points of unlabelled
 * planes stay.
 * \param[in] segments planes with labels and point indices
 * \param[in] points [m] the segmented cloud
 * \throws BadArgument an option is invalid, or a point index is out of range
 * \note Source: A. Nüchter, H. Surmann, J. Hertzberg, "Automatic model refinement for
 * 3D reconstruction with mobile robots", 3DIM 2003; exact constraints in place of a
 * cost.
 * \ingroup scene_interpretation */
RefinedModel
refineModel(const std::vector<PlaneSegment>& segments,
            const Points& points,
            const RefinementOptions& options = {});

/** \brief Writes the changes of the planes as JSON, atomically; the id of a plane is
 * its index plus one, angles are in radians. \throws IoFailed the file cannot be
 * written */
void
writeRefinement(const std::filesystem::path& path, const RefinedModel& model);

} // namespace pcl6d
