// SPDX-License-Identifier: BSD-3-Clause
#include "recovery/recovery_budget.h"
#include "registered.h"

#include <algorithm>

namespace pcl6d::slam6d {

namespace {
/** A long search takes the time of this many matches (16 to 27 with lidars and cameras). */
constexpr std::size_t kMatchesOfSearch = 24;

/** Number of long searches without success that are always allowed: a few seconds. */
constexpr std::size_t kLeastSearches = 2;

/** Matching a pair of scans without prediction takes as long as this many matches (4 in a street, 5.5
 * in rooms, 6 in a car park). */
constexpr std::size_t kMatchesOfPlacement = 5;

/** A run without recovery prepares, relaxes and verifies for each match: at least as long again as the
 * match takes (1.1 to 2.5 times with simulated and recorded sets). The budget is this number of
 * matches for each registered scan, the time of such a run. */
constexpr std::size_t kMatchesPerScan = 2;

/** Least budget: both searches and a few pairs, a few seconds. */
constexpr std::size_t kLeastMatches = kLeastSearches * kMatchesOfSearch + 16;

std::size_t
countRegistered(const std::vector<ScanResult>& scans)
{
  return static_cast<std::size_t>(
      std::count_if(scans.begin(), scans.end(), isRegistered));
}

std::size_t
mostSearches(std::size_t matched)
{
  return std::max(kLeastSearches, matched / kMatchesOfSearch);
}

/** \return whether to search for the n-th scan lost in a row: 0, 1, 3, 7, ... */
bool
isDueInRow(std::size_t lost)
{
  return (lost & (lost + 1)) == 0;
}

/** Searches before a scan. */
struct Searches {
  Searches(std::size_t scan, const std::vector<ScanResult>& scans)
  {
    for (std::size_t i = 0; i < scan; ++i) {
      if (scans[i].state == ScanState::kPredicted)
        failed += isDueInRow(lost++) ? 1 : 0;
      else
        lost = 0;
      matched += isRegistered(scans[i]) ? 1 : 0;
    }
  }
  std::size_t lost = 0; ///< last, in a row
  std::size_t failed = 0, matched = 0;
};
} // namespace

bool
isSearchDue(std::size_t scan, const std::vector<ScanResult>& scans, bool is_bounded)
{
  const Searches before(scan, scans);
  return isDueInRow(before.lost) &&
         (!is_bounded || before.failed < mostSearches(before.matched));
}

std::size_t
searchesInVain(const std::vector<ScanResult>& scans)
{
  const Searches all(scans.size(), scans);
  return std::min(all.failed, mostSearches(all.matched));
}

void
RecoveryBudget::begin(const std::vector<ScanResult>& scans)
{
  const std::size_t in_vain = searchesInVain(scans);
  most_ = std::max(kLeastMatches, kMatchesPerScan * countRegistered(scans));
  spent_ = kMatchesOfSearch * in_vain;
  paid_.clear();
  left_out_ = {};
  left_out_.searches = countScans(scans, ScanState::kPredicted) - in_vain;
}

std::size_t
RecoveryBudget::pairsLeft() const
{
  return left() / kMatchesOfPlacement;
}

void
RecoveryBudget::spendPairs(
    const std::vector<std::pair<std::size_t, std::size_t>>& placed,
    std::size_t left_out)
{
  spent_ += kMatchesOfPlacement * placed.size();
  paid_.insert(placed.begin(), placed.end());
  left_out_.pairs += left_out;
}

bool
RecoveryBudget::spendSecondLook(std::size_t registered)
{
  if (left() < registered) {
    left_out_.is_second_look = true;
    return false;
  }
  spent_ += registered;
  return true;
}

} // namespace pcl6d::slam6d
