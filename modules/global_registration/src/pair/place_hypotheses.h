// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pair/pair_ranking.h"

#include <pcl6d/common/map_verification.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace pcl6d::global_registration {

/** \brief A candidate for the relative pose of two scans. */
struct PlaceHypothesis {
  std::size_t first = 0, second = 0;
  Eigen::Isometry3d T_first_second = Eigen::Isometry3d::Identity();
  double score = 0;       ///< of the pair alone, in [0, 1]
  double strength = 0;    ///< score, raised by hypotheses that close triangles
  bool can_begin = false; ///< the only good pose of the pair: a group may begin here
};

/** \brief Every hypothesis, by scan. */
class PlaceHypotheses {
public:
  PlaceHypotheses(const ScanList& scans,
                  double max_ambiguity,
                  unsigned int num_threads,
                  const ProgressCallback& progress,
                  PairMemory* memory = nullptr);

  /** \brief Registers pairs; a closed triangle strengthens its hypotheses. Reports progress as
   * "placing". */
  void
  add(const std::vector<RankedPair>& pairs);

  const std::vector<PlaceHypothesis>&
  all() const
  {
    return all_;
  }
  /** \return indices in all() of the hypotheses of a scan */
  const std::vector<std::size_t>&
  of(std::size_t scan) const
  {
    return of_scan_[scan];
  }

  /** \return the strongest hypothesis with which a group may begin
   * \param[in] joined per scan whether a group has it
   * \param[in] tried pairs already tried */
  std::optional<PlaceHypothesis>
  strongestBeginning(const std::vector<bool>& joined,
                     const std::set<ScanPlaces>& tried) const;

private:
  std::vector<PairMemory::Candidate>
  candidatesOf(const ScanPlaces& pair) const;
  void
  strengthen();

  const ScanList& scans_;
  double max_ambiguity_;
  unsigned int num_threads_;
  ProgressCallback progress_;
  PairMemory* memory_;
  std::vector<PlaceHypothesis> all_;
  std::vector<std::vector<std::size_t>> of_scan_;
};

/** \return whether two poses are equal within the tolerance
 * \param[in] cell [m] of the scans */
bool
areSamePlace(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double cell);

} // namespace pcl6d::global_registration
