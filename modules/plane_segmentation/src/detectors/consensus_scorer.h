// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "detectors/consensus_kernels.h"

#include <pcl6d/plane_segmentation/plane_consensus.h>

#include <optional>
#include <utility>

namespace pcl6d::plane_segmentation {

/** \brief A candidate for the best plane, relative to ConsensusPoints::origin(). */
struct ConsensusCandidate {
  PlaneFit fit;
  LocalPlane plane; ///< `fit` in float
  double reach = 0; ///< [m] rms distance of its points to their centre
  double score = 0; ///< the higher, the better
  std::array<std::uint32_t, 3> sample{}; ///< indices of the draw
};

/** \brief How ConsensusScorer::climbed() goes. */
struct Climb {
  double step = 0.5; ///< [max_distance] first step, then halved
  int halvings = 3;  ///< of the step; finer steps are within the noise of a count
  std::size_t max_looks = 1 << 20; ///< largest number of planes tested
};

/** \brief Turns normals outside a DirectionLimit to its border. */
class DirectionRule {
public:
  explicit DirectionRule(const std::optional<DirectionLimit>& limit);

  /** \brief Turns a plane about its centre, if necessary. */
  void
  apply(PlaneFit& plane) const;

private:
  bool active_ = false;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();
  double least_ = 0, most_ = 0; // [rad]
  double cosine_of_least_ = 1, cosine_of_most_ = 0;
};

/** \brief Scores a plane on a set of points, and improves it. */
class ConsensusScorer {
public:
  /** \param[in] points, options, rule kept by reference
   * \param[in] num_threads 0: one per core; never changes a result */
  ConsensusScorer(const ConsensusPoints& points,
                  const PlaneConsensusOptions& options,
                  const DirectionRule& rule,
                  unsigned int num_threads);

  /** \return the score of a plane, higher is better: the number of points on the plane,
   * the number less a share for their squared distances, or the negative median of the
   * distances */
  double
  score(const LocalPlane& plane) const;

  /** \return score(), or a negative number once it is unlikely to exceed a floor;
   * points must be in random order. Runs in one thread, for few points. */
  double
  scoreAbove(const LocalPlane& plane, double floor) const;

  /** \return whether no score is better */
  bool
  isPerfect(double score) const;

  /** \return points on a plane */
  std::size_t
  countOn(const ConsensusCandidate& candidate) const;

  /** \brief Fits a plane to its points until the score stops rising.
   * \param[in] only_fits the result must be a fit if possible
   * \return the best plane on the way, scored */
  ConsensusCandidate
  improved(ConsensusCandidate start, bool only_fits) const;

  /** \brief Shifts and tilts a plane in smaller and smaller steps while its score
   * rises: a fit is optimal in squares, not in points.
   * \param[in] only_fits score the fit to the points on a plane instead of the plane
   * \return the best plane on the way, scored; a fit if only_fits, if possible */
  ConsensusCandidate
  climbed(const ConsensusCandidate& start, const Climb& climb, bool only_fits) const;

  /** \return the indices of the points on a plane, in their order */
  std::vector<std::uint32_t>
  placesOn(const ConsensusCandidate& candidate) const;

private:
  /** \return a plane scored, or the fit to its points if only_fits */
  ConsensusCandidate
  evaluated(const ConsensusCandidate& from,
            const PlaneFit& plane,
            bool only_fits) const;

  /** \return the fit to the points on a plane, not scored; nullopt for collinear
   * points */
  std::optional<ConsensusCandidate>
  fitted(const ConsensusCandidate& to) const;

  /** [m] Nearer points count as on a plane for a fit. */
  double
  fitLimit(double score) const;

  PlaneMoments
  momentsOf(const LocalPlane& plane, double limit) const;
  double
  medianTo(const LocalPlane& plane) const;
  template <typename Value, typename Of>
  std::vector<Value>
  overBlocks(const LocalPlane& plane, Of&& of) const;

  const ConsensusPoints& points_;
  const PlaneConsensusOptions& options_;
  const DirectionRule& rule_;
  unsigned int num_threads_;
};

} // namespace pcl6d::plane_segmentation
