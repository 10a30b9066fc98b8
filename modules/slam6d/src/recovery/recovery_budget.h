// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

/** \file What a bounded run may spend on scans that lost track. Time is counted in matches, not
 * measured: results are equal on every machine. */
namespace pcl6d::slam6d {

/** Long searches are made for the first scans lost in a row, then ever more rarely: if surroundings
 * lack features, most of the next scans lack features, too.
 * \param[in] is_bounded limits the time of failed searches to the time of matching; scans that were
 * not searched for count as failed
 * \return whether to search for a lost scan far from its prediction, too */
PCL6D_EXPORTS bool // exported for its test
isSearchDue(std::size_t scan, const std::vector<ScanResult>& scans, bool is_bounded);

/** \return the number of long searches that failed in a bounded run */
PCL6D_EXPORTS std::size_t // exported for its test
searchesInVain(const std::vector<ScanResult>& scans);

/** \brief One budget for all that follows the matching of scan after scan: first the failed searches
 * are taken off, then pairs of scans matched without prediction, then a second registration of what
 * the verdict contradicts. */
class PCL6D_EXPORTS RecoveryBudget { // exported for its test
public:
  /** \brief Begins anew, with about the time of the rest of the run.
   * \param[in] scans of the run, matched one by one; without those of an earlier run */
  void
  begin(const std::vector<ScanResult>& scans);

  /** \return [matches] still to be spent */
  std::size_t
  left() const
  {
    return spent_ < most_ ? most_ - spent_ : 0;
  }

  /** \return how many pairs of scans may still be matched without prediction */
  std::size_t
  pairsLeft() const;

  /** \return the pairs of scans matched without prediction since begin(): their candidates are known,
   * and cost nothing again. Pairs matched before cost as much as unknown ones: a resumed run must not
   * depend on them, nor a process that did not match them */
  const std::set<std::pair<std::size_t, std::size_t>>&
  paidPairs() const
  {
    return paid_;
  }

  /** \param[in] placed pairs matched without prediction
   * \param[in] left_out number of likely pairs that were not */
  void
  spendPairs(const std::vector<std::pair<std::size_t, std::size_t>>& placed,
             std::size_t left_out);

  /** \brief Notes lost scans compared with no other scan. */
  void
  leaveOut(std::size_t scans)
  {
    left_out_.scans += scans;
  }

  /** \brief Takes off a second registration, if enough is left.
   * \param[in] registered scans, to be relaxed and verified again
   * \return whether enough was left; if not, it is noted as left out */
  bool
  spendSecondLook(std::size_t registered);

  /** \return what was left out since begin() */
  const RecoveryLeftOut&
  leftOut() const
  {
    return left_out_;
  }

  /** \brief For transfer between processes. */
  template <typename Exchange>
  void
  exchange(const Exchange& of_first)
  {
    most_ = of_first(most_);
    spent_ = of_first(spent_);
    std::vector<std::size_t> scans;
    for (const auto& [from, to] : paid_) {
      scans.push_back(from);
      scans.push_back(to);
    }
    scans = of_first(scans);
    paid_.clear();
    for (std::size_t k = 0; k + 1 < scans.size(); k += 2)
      paid_.emplace(scans[k], scans[k + 1]);
  }

private:
  std::size_t most_ = 0, spent_ = 0; // [matches]
  std::set<std::pair<std::size_t, std::size_t>> paid_;
  RecoveryLeftOut left_out_;
};

} // namespace pcl6d::slam6d
