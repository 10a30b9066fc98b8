// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/motion_relaxation.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl6d::semi_rigid {

/** How the height of something over a plane changes with the knots before and after it, each
 * by translation and rotation about the scanner. */
using KnotRow = Eigen::Matrix<double, 12, 1>;

/** The points of a scan between two knots that lie on one plane: their mean. */
struct SurfacePiece {
  std::size_t plane = 0; ///< number
  std::size_t knot = 0;  ///< the one before, counted through all scans
  double height = 0;     ///< [m] over the plane
  double variance = 0;   ///< [m^2] of the height
  KnotRow row = KnotRow::Zero();
};

/** Two pieces of one plane, that are to be at one height. */
struct PieceLink {
  std::size_t from = 0,
              to = 0; ///< places of the pieces; the knot of from is not larger
  double share = 1;   ///< of its weight, as its pieces have other links, too
};

/** \return the pieces of all scans, sorted by plane, then knot \param[in] first number of the
 * first knot of each scan */
std::vector<SurfacePiece>
piecesOf(const std::vector<MotionScan>& scans,
         const std::vector<std::size_t>& first,
         const MotionRelaxationOptions& options);

/** \return links between pieces of different knots, sorted by their knots */
std::vector<PieceLink>
linksOf(const std::vector<SurfacePiece>& pieces);

} // namespace pcl6d::semi_rigid
