// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "pair/pair_ranking.h"
#include "pair/place_starts.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <memory>

namespace pcl6d::global_registration {

namespace {
/** Ratio of the cell sizes of the quick and the thorough search, and of the numbers of cells
 * to each side, and of turns. */
constexpr int kCoarser = 2;

/** Number of scored placements per pair, from each n-th point. */
constexpr std::size_t kQuickPlacements = 10, kEvery = 4;

/** Pairs between two progress reports. */
constexpr std::size_t kComparedAtATime = 64;

double
medianCell(const ScanList& scans)
{
  std::vector<double> cells;
  for (const auto* scan : scans)
    cells.push_back(scan->cell());
  const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
  std::nth_element(cells.begin(), middle, cells.end());
  return *middle;
}

void
sortBest(std::vector<RankedPair>& ranked)
{
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
    return a.score > b.score;
  });
}
} // namespace

std::vector<RankedPair>
rankPairs(const ScanList& scans,
          const std::vector<ScanPlaces>& pairs,
          PairMemory* memory,
          unsigned int num_threads,
          const ProgressCallback& progress)
{
  const double cell = kCoarser * medianCell(scans);
  std::vector<std::unique_ptr<UprightScan>> upright(scans.size());
  parallelFor(scans.size(), num_threads, [&](std::size_t i) {
    upright[i] =
        std::make_unique<UprightScan>(*scans[i], scans[i]->vertical().up, cell);
  });
  PlanSearch search;
  search.turns /= kCoarser;
  search.reach /= kCoarser;
  std::vector<RankedPair> ranked(pairs.size());
  if (progress) // each scan is drawn by now
    progress({"comparing", 0, pairs.size()});
  for (std::size_t begin = 0; begin < pairs.size(); begin += kComparedAtATime) {
    const std::size_t count = std::min(kComparedAtATime, pairs.size() - begin);
    parallelFor(count, num_threads, [&](std::size_t k) {
      const ScanPlaces& pair = pairs[begin + k];
      const auto known =
          memory ? memory->score(pairOf(scans, pair), cell) : std::nullopt;
      ranked[begin + k] = {pair, known.value_or(0)};
      if (known)
        return;
      const auto starts = placeStarts(*upright[pair.first],
                                      *upright[pair.second],
                                      kQuickPlacements,
                                      1,
                                      search,
                                      kEvery);
      if (!starts.empty())
        ranked[begin + k].score = starts.front().score;
    });
    if (progress)
      progress({"comparing", begin + count, pairs.size()});
  }
  for (const RankedPair& one : ranked)
    if (memory)
      memory->keepScore(pairOf(scans, one.scans), cell, one.score);
  return ranked;
}

std::vector<RankedPair>
furtherPairs(const std::vector<RankedPair>& ranked,
             const std::set<ScanPlaces>& placed,
             std::size_t num_scans,
             std::size_t per_scan,
             const std::function<bool(std::size_t)>& is_inside,
             const std::function<bool(std::size_t)>& is_known)
{
  std::size_t most = 0;
  for (std::size_t i = 0; i < num_scans; ++i)
    most += is_known(i) ? 0 : per_scan;
  std::vector<RankedPair> across;
  for (const auto& one : ranked)
    if (is_inside(one.scans.first) != is_inside(one.scans.second) &&
        placed.count(one.scans) == 0 && one.score > 0)
      across.push_back(one);
  sortBest(across);
  std::vector<std::size_t> taken(num_scans, 0);
  std::vector<RankedPair> best;
  for (const auto& one : across) {
    const auto& [first, second] = one.scans;
    if (placed.size() + best.size() < most &&
        taken[is_inside(first) ? second : first]++ < per_scan)
      best.push_back(one);
  }
  return best;
}

std::vector<RankedPair>
bestOfEach(std::vector<RankedPair> ranked,
           std::size_t num_scans,
           std::size_t per_scan,
           const std::function<bool(std::size_t)>& is_known)
{
  sortBest(ranked);
  std::vector<std::size_t> taken(num_scans, 0);
  std::vector<RankedPair> best;
  for (const auto& one : ranked) {
    const auto& [first, second] = one.scans;
    const bool one_is_known = is_known(first) != is_known(second);
    const bool wants_first =
        (!one_is_known || !is_known(first)) && taken[first] < per_scan;
    const bool wants_second =
        (!one_is_known || !is_known(second)) && taken[second] < per_scan;
    if (one.score <= 0 || (!wants_first && !wants_second))
      continue;
    ++taken[first];
    ++taken[second];
    best.push_back(one);
  }
  return best;
}

} // namespace pcl6d::global_registration
