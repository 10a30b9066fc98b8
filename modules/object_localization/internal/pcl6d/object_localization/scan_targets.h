// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

enum class TargetKind {
  kSphere, ///< a ball of known diameter
  kBoard   ///< a flat square of two black and two white quarters
};

/** \return "sphere" or "board" */
const char*
toString(TargetKind kind);

/** \brief The targets that findTargets() searches for. */
struct TargetOptions {
  std::vector<double> sphere_diameters; ///< [m] each > 0
  std::vector<double> board_sizes;      ///< [m] edge of the square; each > 0
  unsigned int num_threads = 0;         ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A target in a scan. \ingroup object_localization */
struct FoundTarget {
  TargetKind kind = TargetKind::kSphere;
  double size = 0;                                  ///< [m] diameter or edge
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m] in the scan's frame
  double sigma = 0; ///< [m] standard deviation of a coordinate of the centre
  double quality =
      0; ///< sphere: share of the visible side with points; board: share of points with
         ///< the colour of their quarter
  std::size_t points = 0; ///< on the target
};

/** \brief Why a candidate of a target is rejected. */
enum class TargetFault {
  kOtherDiameter, ///< measured: diameter of the sphere [m]
  kMostlyHidden,  ///< measured: share of the sphere's visible side with points
  kGrazingAngle, ///< measured: angle [rad] between the rays and the normal of the board
  kSmallerBoard ///< measured: share of points near the border with the colour of their quarter
};

/** \brief A rejected candidate of a target, with the reason. */
struct RejectedTarget {
  TargetKind kind = TargetKind::kSphere;
  double size = 0;                                  ///< [m] nominal size
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m] approximate
  TargetFault fault = TargetFault::kOtherDiameter;
  double measured = 0; ///< by fault
};

/** \return the reason in words, such as "its diameter is 0.200 m" */
std::string
toWords(const RejectedTarget& rejected);

struct TargetSearch {
  std::vector<FoundTarget> found;
  std::vector<RejectedTarget> rejected;
};

/** \brief Finds targets in a scan with its scanner at the origin.
 *
 * Spheres: seeds are one point per voxel of the radius. The points about a seed give a
 * sphere of free radius. If its radius is near the nominal radius, the centre is fitted
 * by least squares with the nominal radius. A sphere is found if residuals are small,
 * no point lies inside, a free radius agrees, and points cover half of the side that
 * faces the scanner.
 *
 * Boards: where intensities on a plane differ, a square of four quarters is fitted by
 * least squares, with a soft edge half as wide as the point spacing. A board is found
 * if nine of ten points have the colour of their quarter, also near the border, at an
 * angle of incidence below 70 degrees.
 *
 * The standard deviation is computed from the residuals of the fit. Targets are ordered
 * by distance.
 * \param[in] points [m] in the scan's frame
 * \param[in] intensity one per point; empty: no boards are found
 * \throws BadArgument an option is invalid, or not one intensity per point
 * \ingroup object_localization */
TargetSearch
findTargets(const Points& points,
            const std::vector<float>& intensity,
            const TargetOptions& options);

} // namespace pcl6d
