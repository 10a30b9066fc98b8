// SPDX-License-Identifier: BSD-3-Clause
#include "any_order/kept_pieces.h"
#include "recovery/piece_matcher.h"

#include <map>

namespace pcl6d::slam6d {

KnownPlaces
withPieces(KnownPlaces known, const KnownPlaces& pieces)
{
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (!known[i])
      known[i] = pieces[i];
  return known;
}

std::vector<std::pair<std::size_t, std::size_t>>
pairsBesidePieces(const KnownPlaces& pieces)
{
  std::map<std::size_t, std::vector<std::size_t>> scans_of; // by piece
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i])
      scans_of[pieces[i]->group].push_back(i);
  if (scans_of.empty())
    return {};
  std::vector<bool> is_compared(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
    is_compared[i] = !pieces[i];
  for (const auto& [number, scans] : scans_of)
    for (const std::size_t i : comparedOfPiece(scans))
      is_compared[i] = true;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t j = 0; j < pieces.size(); ++j)
    for (std::size_t i = 0; i < j && is_compared[j]; ++i)
      if (is_compared[i])
        pairs.emplace_back(i, j);
  return pairs;
}

} // namespace pcl6d::slam6d
