// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/placeable_scan.h>

#include <cstddef>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Scans that are worked with together. */
using ScanList = std::vector<const PlaceableScan*>;

/** \brief Two scans, the first with the smaller place. */
using ScanPlaces = std::pair<std::size_t, std::size_t>;

/** \brief A pair by a quick look at how well it might meet. */
struct RankedPair {
  ScanPlaces scans;
  double score = 0; ///< in [0, 1]
};

/** \brief Looks at pairs as placeScan() begins to, with cells twice as wide.
 * \return the same order; the same bits for any number of threads */
std::vector<RankedPair>
rankPairs(const ScanList& scans,
          const std::vector<ScanPlaces>& pairs,
          unsigned int num_threads,
          const ProgressCallback& progress);

/** \return the pairs that are among the best of either scan, the best first
 * \param[in] per_scan so many of each
 * \param[in] is_known of a scan with a known place and one without, only the latter is asked */
std::vector<RankedPair>
bestOfEach(std::vector<RankedPair> ranked,
           std::size_t num_scans,
           std::size_t per_scan,
           const std::function<bool(std::size_t)>& is_known);

/** \return of each scan outside a group the best pairs with scans inside that were not placed
 * yet, in all no more than are left of per_scan pairs a scan */
std::vector<RankedPair>
furtherPairs(const std::vector<RankedPair>& ranked,
             const std::set<ScanPlaces>& placed,
             std::size_t num_scans,
             std::size_t per_scan,
             const std::function<bool(std::size_t)>& is_inside);

} // namespace pcl6d::global_registration
