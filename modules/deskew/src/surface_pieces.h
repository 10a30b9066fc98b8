// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/deskew/motion_relaxation.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl6d::semi_rigid {

/** Derivative of a height over a plane by the knots before and after, each by translation and
 * rotation about the scanner. */
using KnotRow = Eigen::Matrix<double, 12, 1>;

/** The mean of the points of a scan between two knots on one plane. */
struct SurfacePiece {
  std::size_t plane = 0; ///< number
  std::size_t knot = 0;  ///< index of the knot before, counted over every scan
  double height = 0;     ///< [m] over the plane
  double variance = 0;   ///< [m^2] of the height
  KnotRow row = KnotRow::Zero();
};

/** Two pieces of one plane, constrained to one height. */
struct PieceLink {
  std::size_t from = 0,
              to = 0; ///< indices of the pieces; the knot of from is not larger
  double share = 1;   ///< reduced weight, as the pieces have further links
};

/** \return the pieces of every scan, sorted by plane, then knot
 * \param[in] first index of the first knot of each scan */
std::vector<SurfacePiece>
piecesOf(const std::vector<MotionScan>& scans,
         const std::vector<std::size_t>& first,
         const MotionRelaxationOptions& options);

/** \return links between pieces of different knots, sorted by their knots */
std::vector<PieceLink>
linksOf(const std::vector<SurfacePiece>& pieces);

} // namespace pcl6d::semi_rigid
