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
  /// direction that is up exactly; none: estimated together with all normals
  std::optional<Eigen::Vector3d> up;
  double max_turn = 0.17453292519943295; ///< [rad] of any plane: 10 deg; in (0, pi/4)
  double max_move = 0.1;                 ///< [m] of any point of a plane; > 0
  double significance = 3; ///< standard deviations that a plane may turn at most; > 0
  /// [m] standard deviation of what the poses of the scans do to each square metre of a
  /// plane, beside the noise of the points; >= 0
  double map_position_error = 0.005;
  /// [rad] and to a whole plane, however large: 0.2 deg; >= 0
  double map_angle_error = 0.003490658503988659;
  bool project = true; ///< put the points onto their plane; false: keep their noise
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What a plane was made to be. */
enum class RefinedKind {
  kUnchanged,  ///< no label, or refused
  kHorizontal, ///< exactly
  kVertical    ///< exactly, and along the axes of its frame
};

const char*
toString(RefinedKind kind);

/** \brief How a plane was changed. */
struct PlaneChange {
  RefinedKind kind = RefinedKind::kUnchanged;
  std::size_t frame = 0;   ///< of a vertical plane: place in RefinedModel::headings
  double turn = 0;         ///< [rad] of its normal
  double uncertainty = 0;  ///< [rad] standard deviation of its normal along that turn
  double shift = 0;        ///< [m] along its normal, of the centroid
  double largest_move = 0; ///< [m] of a corner of its hull
  std::string refusal;     ///< what was not done to it, and why; empty: nothing refused
};

/** \brief A refined model. */
struct RefinedModel {
  Status status = Status::kOk;      ///< kRankDeficient: no plane has a label
  std::vector<PlaneSegment> planes; ///< those given, with exact normals and new hulls
  Points points;                    ///< those given, the inliers moved with their plane
  std::vector<PlaneChange> changes; ///< per plane
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  /// directions, orthogonal to up, of which the walls of a frame are parallel or
  /// orthogonal to one; the frame with the largest area first
  std::vector<Eigen::Vector3d> headings;
};

/** \brief Makes the labelled planes of a model exactly parallel, orthogonal, horizontal
 * and vertical, and moves their points with them (book 7.1.3).
 *
 * Labelled planes that are level within max_turn share the vertical as normal. Upright
 * ones are gathered into frames of parallel and orthogonal walls, as far as the
 * uncertainty of their normals allows; one frame is a Manhattan world, a wall that fits
 * none has one of its own and is vertical only. All normals together, the vertical and
 * one heading per frame, minimise the sum of n^T W n by Gauss and Newton's method, W
 * the inverse covariance of a plane's fit: the noise of its points, and
 * map_position_error. Without the latter W is the scatter of the points over their
 * variance, and the sum that of their squared distances to planes through their
 * centroids, as in the book.
 *
 * A plane that would have to turn further than its uncertainty explains (significance),
 * or than max_turn or max_move, is taken out: of its frame first, then of the vertical
 * ones. So a wall that leans for certain keeps leaning. Points of planes without a
 * label stay.
 * \param[in] segments planes with labels and places of points
 * \param[in] points [m] the cloud that was segmented
 * \throws BadArgument an option breaks its rule, or a place is not that of a point
 * \note Source: A. Nüchter, H. Surmann, J. Hertzberg, "Automatic model refinement for
 * 3D reconstruction with mobile robots", 3DIM 2003; exact constraints in place of a
 * cost.
 * \ingroup scene_interpretation */
RefinedModel
refineModel(const std::vector<PlaneSegment>& segments,
            const Points& points,
            const RefinementOptions& options = {});

/** \brief Writes what became of the planes as JSON, atomically; the id of a plane is
 * its place plus one, angles are in radians. \throws IoFailed the file cannot be
 * written */
void
writeRefinement(const std::filesystem::path& path, const RefinedModel& model);

} // namespace pcl6d
