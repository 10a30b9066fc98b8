// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>
#include <pcl6d/plane_segmentation/consensus_points.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Criterion for the best plane. */
enum class ConsensusCriterion {
  kMostPoints, ///< more points within the distance (RANSAC)
  /** A smaller sum of min(d^2, max_distance^2) over the points (MSAC, Torr and
   * Zisserman 2000): of planes with equal counts, the plane closer to its points. */
  kTruncatedSquares,
  kLeastMedian ///< a smaller median of the distances (LMedS, Rousseeuw 1984)
};

/** \brief Limits the normal to angles in [least, most] from an axis, regardless of
 * sign. */
struct DirectionLimit {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(); ///< finite, not zero; of any length
  double least = 0;                                ///< [rad] >= 0
  double most = 0.1;                               ///< [rad] >= least; <= pi/2
};

/** \brief Knobs of findPlaneConsensus(). */
struct PlaneConsensusOptions {
  /** [m] A point is on a plane if d < max_distance; > 0. For points with normals d = (1
   * - w) * distance [m] + w * angle [rad] between their normal and the plane's, w their
   * weight. */
  double max_distance = 0.02;
  ConsensusCriterion criterion = ConsensusCriterion::kMostPoints;
  double probability = 0.99; ///< to find the best plane; in [0, 1]
  /** Effort, as a number of passes over the points; >= 1. Draws are scored on a sample
   * of the points: a large cloud gets far more draws than iterations. */
  std::size_t max_iterations = 50;
  std::optional<DirectionLimit> direction; ///< of the normal; default: any
  bool refine = true;       ///< whether to fit the plane to its points by least squares
  std::uint64_t seed = 1;   ///< of the draws
  unsigned num_threads = 1; ///< 0: one per core; never changes the result
  /** Gives the candidates to draw with a point, as indices; called from one thread.
   * Default: every point. Each draw costs one search, so at most max_iterations are
   * made. */
  std::function<void(std::uint32_t place, std::vector<std::uint32_t>& near)> neighbours;
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief The plane normal . p = offset that findPlaneConsensus() found. */
struct PlaneConsensus {
  /** kOk; kTooFewPairs: fewer than 3 points; kRankDeficient: no draw defines a plane
   * (collinear points), or no plane has three points. */
  Status status = Status::kTooFewPairs;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< unit, of either sign
  double offset = 0;                                ///< [m]
  Eigen::Vector3d centre =
      Eigen::Vector3d::Zero();        ///< [m] on the plane, amid its points
  std::vector<std::uint32_t> inliers; ///< indices of the points on the plane, ascending
  std::array<std::uint32_t, 3> sample{}; ///< indices of the draw that led to the plane
  std::size_t draws = 0;                 ///< number of draws made

  double
  distance(const Eigen::Vector3d& p) const
  {
    return normal.dot(p) - offset;
  }
};

/** \brief Finds the plane with the most points (book 7.1.1).
 *
 * Draws of three points are scored on a sample of a few hundred points, and dropped
 * once they cannot win. The best of each round are fitted repeatedly to their points
 * while the score rises. The best of these are fitted and counted on every point.
 * Rounds go on until the probability of having drawn the best plane is reached.
 *
 * A plane that leans more than `direction` allows is turned about its points to the
 * limit, so a narrow limit does not waste draws.
 *
 * Bit for bit equal for any number of threads. Cost: O(draws * sample + points).
 * \throws BadArgument an option is invalid
 * \note Sources: M. A. Fischler, R. C. Bolles, "Random sample consensus", CACM 24(6),
 * 1981; O. Chum, J. Matas, J. Kittler, "Locally optimized RANSAC", DAGM 2003; D. P.
 * Capel, "An effective bail-out test for RANSAC consensus scoring", BMVC 2005; P. H. S.
 * Torr, A. Zisserman, "MLESAC", CVIU 78, 2000; P. J. Rousseeuw, "Least median of
 * squares regression", JASA 79, 1984. \ingroup plane_segmentation */
PlaneConsensus
findPlaneConsensus(ConsensusPoints points, const PlaneConsensusOptions& options = {});

} // namespace pcl6d
