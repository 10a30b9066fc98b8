// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/global_registration/pair_memory.h>

#include <utility>

namespace pcl6d {

std::optional<double>
PairMemory::score(const Pair& pair, double cell) const
{
  const auto found = scores_.find({pair.first, pair.second, cell});
  return found == scores_.end() ? std::nullopt : std::optional<double>(found->second);
}

void
PairMemory::keepScore(const Pair& pair, double cell, double score)
{
  scores_[{pair.first, pair.second, cell}] = score;
}

const std::vector<PairMemory::Candidate>*
PairMemory::candidates(const Pair& pair, double max_ambiguity) const
{
  const auto found = candidates_.find({pair.first, pair.second, max_ambiguity});
  return found == candidates_.end() ? nullptr : &found->second;
}

void
PairMemory::keepCandidates(const Pair& pair,
                           double max_ambiguity,
                           std::vector<Candidate> found)
{
  candidates_[{pair.first, pair.second, max_ambiguity}] = std::move(found);
}

} // namespace pcl6d
