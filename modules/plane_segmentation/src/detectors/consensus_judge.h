// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "detectors/consensus_kernels.h"

#include <pcl6d/plane_segmentation/plane_consensus.h>

#include <optional>
#include <utility>

namespace pcl6d::plane_segmentation {

/** \brief A plane that may be the best, relative to ConsensusPoints::origin(). */
struct ConsensusCandidate {
  PlaneFit fit;
  LocalPlane plane; ///< the same, in float
  double reach = 0; ///< [m] rms distance of its points to their centre
  double score = 0; ///< the higher, the better
  std::array<std::uint32_t, 3> sample{}; ///< places of the draw
};

/** \brief How ConsensusJudge::climbed() goes. */
struct Climb {
  double step = 0.5; ///< [max_distance] the first, which is halved
  int halvings = 3;  ///< of the step; finer ones are within the noise of a count
  std::size_t max_looks = 1 << 20; ///< planes that are looked at
};

/** \brief Turns normals that a DirectionLimit forbids to its border. */
class DirectionRule {
public:
  explicit DirectionRule(const std::optional<DirectionLimit>& limit);

  /** \brief Turns a plane about its centre, if it must. */
  void
  apply(PlaneFit& plane) const;

private:
  bool active_ = false;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();
  double least_ = 0, most_ = 0; // [rad]
  double cosine_of_least_ = 1, cosine_of_most_ = 0;
};

/** \brief Says how good a plane is, and makes it better, by some points. */
class ConsensusJudge {
public:
  /** \param[in] points, options, rule kept by reference
   * \param[in] num_threads 0: one per core; never changes a result */
  ConsensusJudge(const ConsensusPoints& points,
                 const PlaneConsensusOptions& options,
                 const DirectionRule& rule,
                 unsigned int num_threads);

  /** \return the score of a plane, the higher, the better: points on it, those less a
   * share for their squared distances, or the negative median of the distances */
  double
  score(const LocalPlane& plane) const;

  /** \return the same, or a negative number as soon as it is unlikely to be more than a
   * floor; points must be in random order. From one thread, and of few points. */
  double
  scoreAbove(const LocalPlane& plane, double floor) const;

  /** \return whether no score is better */
  bool
  isPerfect(double score) const;

  /** \return points on a plane */
  std::size_t
  countOn(const ConsensusCandidate& candidate) const;

  /** \brief Fits a plane to the points on it until that helps no more.
   * \param[in] only_fits the result must be a fit, if there is one
   * \return the best on the way, scored */
  ConsensusCandidate
  improved(ConsensusCandidate start, bool only_fits) const;

  /** \brief Shifts and tilts a plane in smaller and smaller steps as long as its score
   * rises: a fit is best by squares, not by points.
   * \param[in] only_fits what counts is the fit to the points on a plane
   * \return the best on the way, scored; a fit if only_fits, if there is one */
  ConsensusCandidate
  climbed(const ConsensusCandidate& start, const Climb& climb, bool only_fits) const;

  /** \return the places of the points on a plane, in their order */
  std::vector<std::uint32_t>
  placesOn(const ConsensusCandidate& candidate) const;

private:
  /** \return a plane scored, or the fit to its points if only_fits */
  ConsensusCandidate
  judged(const ConsensusCandidate& from, const PlaneFit& plane, bool only_fits) const;

  /** \return the fit to the points on a plane, not scored; none: they are on a line */
  std::optional<ConsensusCandidate>
  fitted(const ConsensusCandidate& to) const;

  /** Points that count as on a plane for a fit are nearer [m]. */
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
