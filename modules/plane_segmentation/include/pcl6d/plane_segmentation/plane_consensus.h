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

/** \brief What makes one plane better than another. */
enum class ConsensusCriterion {
  kMostPoints, ///< more points within the distance (RANSAC)
  /** A smaller sum of min(d^2, max_distance^2) over all points (MSAC, Torr and
   * Zisserman 2000): of planes with as many points, the one that they are closer to. */
  kTruncatedSquares,
  kLeastMedian ///< a smaller median of the distances (LMedS, Rousseeuw 1984)
};

/** \brief Which normals are allowed: those that make an angle in [least, most] with an
 * axis, whichever way they point. */
struct DirectionLimit {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(); ///< finite, not zero; of any length
  double least = 0;                                ///< [rad] >= 0
  double most = 0.1;                               ///< [rad] >= least; <= pi/2
};

/** \brief Knobs of findPlaneConsensus(). */
struct PlaneConsensusOptions {
  /** [m] A point is on a plane if it is nearer, d < max_distance; > 0. Points with
   * normals count d = (1 - w) * distance [m] + w * angle [rad] between their normal and
   * the plane's, w their weight. */
  double max_distance = 0.02;
  ConsensusCriterion criterion = ConsensusCriterion::kMostPoints;
  double probability = 0.99; ///< that the best plane is found; in [0, 1]
  /** Effort, in times that all points may be looked at; >= 1. Draws are judged by a
   * sample of the points: of a large cloud there are far more draws than iterations. */
  std::size_t max_iterations = 50;
  std::optional<DirectionLimit> direction; ///< of the normal; none: any
  bool refine = true;       ///< the plane is that of least squares of points on it
  std::uint64_t seed = 1;   ///< of the draws
  unsigned num_threads = 1; ///< 0: one per core; never changes the result
  /** Which points may be drawn with a point, as places; not called from several
   * threads. None: any. As each draw costs such a search, there are at most
   * max_iterations. */
  std::function<void(std::uint32_t place, std::vector<std::uint32_t>& near)> neighbours;
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief The plane normal . p = offset that findPlaneConsensus() found. */
struct PlaneConsensus {
  /** kOk; kTooFewPairs: fewer than 3 points; kRankDeficient: no draw makes a plane, as
   * all points are on a line, or no plane has three points on it. */
  Status status = Status::kTooFewPairs;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< unit, of either sign
  double offset = 0;                                ///< [m]
  Eigen::Vector3d centre =
      Eigen::Vector3d::Zero();           ///< [m] a place on it, amid its points
  std::vector<std::uint32_t> inliers;    ///< places of the points on it, ascending
  std::array<std::uint32_t, 3> sample{}; ///< places of the draw that led to it
  std::size_t draws = 0;                 ///< that were made

  double
  distance(const Eigen::Vector3d& p) const
  {
    return normal.dot(p) - offset;
  }
};

/** \brief The plane on which most of the points are (book 7.1.1).
 *
 * Draws of three points, scored on a sample of some hundred points and given up as soon
 * as they cannot win any more; the best of each round are fitted to the points on them,
 * again and again, until that helps no more; those that may be the best of all are
 * fitted and counted on all points. Rounds go on until a better plane would have been
 * drawn with the given probability.
 *
 * A plane that leans more than `direction` allows is turned about its points to the
 * limit, so that a narrow limit does not waste draws.
 *
 * The same bits for any number of threads. Cost: O(draws * sample + points).
 * \throws BadArgument an option breaks its rule
 * \note Sources: M. A. Fischler, R. C. Bolles, "Random sample consensus", CACM 24(6),
 * 1981; O. Chum, J. Matas, J. Kittler, "Locally optimized RANSAC", DAGM 2003; D. P.
 * Capel, "An effective bail-out test for RANSAC consensus scoring", BMVC 2005; P. H. S.
 * Torr, A. Zisserman, "MLESAC", CVIU 78, 2000; P. J. Rousseeuw, "Least median of
 * squares regression", JASA 79, 1984. \ingroup plane_segmentation */
PlaneConsensus
findPlaneConsensus(ConsensusPoints points, const PlaneConsensusOptions& options = {});

} // namespace pcl6d
