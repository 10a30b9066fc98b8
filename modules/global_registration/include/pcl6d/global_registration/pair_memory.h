// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What joinScans() found for pairs of scans. Further calls with some of the same scans take
 * it from here, with the same result and in less time. Scans are told apart by their address: they
 * must outlive the memory, unchanged. Not to be shared between concurrent calls.
 * \ingroup global_registration */
class PairMemory {
public:
  /** Two scans; the order matters. */
  struct Pair {
    const VerifiedScan* first = nullptr;
    const VerifiedScan* second = nullptr;
  };

  /** A candidate for the relative pose of a pair. */
  struct Candidate {
    Eigen::Isometry3d T_first_second = Eigen::Isometry3d::Identity();
    double score = 0;       ///< in [0, 1]
    bool is_unique = false; ///< the only good pose of the pair
  };

  /** \param[in] cell [m] of the plans \return the score of the quick comparison; none: not yet
   * compared */
  std::optional<double>
  score(const Pair& pair, double cell) const;
  void
  keepScore(const Pair& pair, double cell, double score);

  /** \param[in] max_ambiguity of a unique pose \return null: not yet placed */
  const std::vector<Candidate>*
  candidates(const Pair& pair, double max_ambiguity) const;
  void
  keepCandidates(const Pair& pair, double max_ambiguity, std::vector<Candidate> found);

private:
  using Key = std::tuple<const VerifiedScan*, const VerifiedScan*, double>;

  std::map<Key, double> scores_;
  std::map<Key, std::vector<Candidate>> candidates_;
};

} // namespace pcl6d
