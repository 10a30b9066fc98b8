// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/pair_memory.h>
#include <pcl6d/global_registration/placeable_scan.h>

#include <cstddef>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Scans of one call. */
using ScanList = std::vector<const PlaceableScan*>;

/** \brief Two scans, the first with the smaller index. */
using ScanPlaces = std::pair<std::size_t, std::size_t>;

/** \brief A pair, scored by a quick test of the likely overlap. */
struct RankedPair {
  ScanPlaces scans;
  double score = 0; ///< in [0, 1]
};

/** \return a pair of the scans, for the memory of pairs */
inline PairMemory::Pair
pairOf(const ScanList& scans, const ScanPlaces& places)
{
  return {&scans[places.first]->scan(), &scans[places.second]->scan()};
}

/** \brief Scores pairs as placeScan() begins, with cells twice as wide.
 * \param[in,out] memory of the scores; may be null
 * \return the order of the input; bit-identical for any number of threads */
std::vector<RankedPair>
rankPairs(const ScanList& scans,
          const std::vector<ScanPlaces>& pairs,
          PairMemory* memory,
          unsigned int num_threads,
          const ProgressCallback& progress);

/** \return the pairs among the best of either scan, the best first
 * \param[in] per_scan number of pairs per scan
 * \param[in] is_known of a scan with a known pose and a scan without, only the latter counts */
std::vector<RankedPair>
bestOfEach(std::vector<RankedPair> ranked,
           std::size_t num_scans,
           std::size_t per_scan,
           const std::function<bool(std::size_t)>& is_known);

/** \return the best untested pairs of each scan outside a group with scans inside; in total at
 * most the remainder of per_scan pairs for each scan whose pose is not known */
std::vector<RankedPair>
furtherPairs(const std::vector<RankedPair>& ranked,
             const std::set<ScanPlaces>& placed,
             std::size_t num_scans,
             std::size_t per_scan,
             const std::function<bool(std::size_t)>& is_inside,
             const std::function<bool(std::size_t)>& is_known);

} // namespace pcl6d::global_registration
