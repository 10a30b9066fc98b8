// SPDX-License-Identifier: BSD-3-Clause
#include "group/joint_placement.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/place_in_map.h>

#include <algorithm>

namespace pcl6d {
using namespace global_registration;

namespace {
/** \return the most likely pairs of a scan with scans of the map, by a quick search
 * \param[in] list of the map's scans, followed by the scan */
std::vector<RankedPair>
likeliestPairs(const ScanList& list, const MapPlaceOptions& options)
{
  const std::size_t scan = list.size() - 1;
  std::vector<ScanPlaces> pairs;
  for (std::size_t i = 0; i < scan; ++i)
    pairs.emplace_back(i, scan);
  auto ranked = rankPairs(list, pairs, nullptr, options.num_threads, options.progress);
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
    return a.score > b.score;
  });
  const auto end = std::find_if(
      ranked.begin(), ranked.end(), [](const auto& pair) { return pair.score <= 0; });
  ranked.erase(end, ranked.end());
  ranked.resize(std::min(ranked.size(), options.pairs));
  return ranked;
}

/** A candidate pose after matching, for the report. */
MapPlace
asMapPlace(const Settled& settled, const ScanGroup& map, std::size_t scan)
{
  MapPlace place;
  place.T_map_scan = settled.best.T_group_scan;
  place.overlap = settled.best.support.overlap;
  place.contradiction = settled.best.support.contradiction;
  place.score = settled.best.support.score;
  place.rejection = settled.rejection;
  const double background = contradictionBackground({});
  for (std::size_t k = 0; k < settled.links.size(); ++k)
    place.links.push_back(linkCheck(map.members()[settled.best.support.met[k]].scan,
                                    scan,
                                    settled.links[k],
                                    testLink(settled.links[k], background)));
  return place;
}

/** Adds a pose, unless an equal pose exists; of two equal poses the better stays. */
void
addPlace(MapPlace place, double cell, std::vector<MapPlace>& places)
{
  const auto same =
      std::find_if(places.begin(), places.end(), [&](const MapPlace& other) {
        return areSamePlace(place.T_map_scan, other.T_map_scan, cell);
      });
  if (same == places.end())
    places.push_back(std::move(place));
  else if (place.score > same->score)
    *same = std::move(place);
}

void
decide(double max_ambiguity, MapPlaces& found)
{
  if (found.candidates.empty()) {
    found.rejection = RejectReason::kNoSurfacesMeet;
    return;
  }
  found.rejection = found.candidates.front().rejection;
  if (found.rejection)
    return;
  const bool is_unique = found.ambiguity() <= max_ambiguity;
  found.answer = is_unique ? PlaceAnswer::kUnique : PlaceAnswer::kAmbiguous;
  if (!is_unique)
    found.rejection = {RejectReason::kSecondPose, found.ambiguity(), max_ambiguity};
}
} // namespace

double
MapPlaces::ambiguity() const
{
  return candidates.size() < 2 || candidates[0].score <= 0
             ? 0
             : candidates[1].score / candidates[0].score;
}

void
MapPlaceOptions::validate() const
{
  require(pairs > 0, "pairs", pairs, "> 0");
  require(candidates > 0, "candidates", candidates, "> 0");
  require(max_ambiguity >= 0 && max_ambiguity <= 1,
          "max_ambiguity",
          max_ambiguity,
          "in [0, 1]");
}

MapPlaces
placeInMap(const PlaceableScan& scan,
           const std::vector<KnownScan>& map,
           const MapPlaceOptions& options)
{
  options.validate();
  require(!map.empty(), "scans of the map", map.size(), "> 0");
  ScanList list;
  for (const KnownScan& known : map) {
    if (!isRigid(known.T_world_scan))
      throw BadArgument("a pose of the map is not a rigid motion");
    list.push_back(known.scan);
  }
  list.push_back(&scan);
  ScanGroup group(list);
  for (std::size_t i = 0; i < map.size(); ++i)
    group.add(i, map[i].T_world_scan);
  PlaceHypotheses hypotheses(
      list, options.max_ambiguity, options.num_threads, options.progress);
  MapPlaces found;
  found.pairs_compared = map.size();
  const auto pairs = likeliestPairs(list, options);
  found.pairs_placed = pairs.size();
  if (!pairs.empty())
    hypotheses.add(pairs);
  const JointPlacement placement(
      list, hypotheses, options.max_ambiguity, options.num_threads);
  // Settled separately: decide() must see a second pose that fits nearly as well.
  for (const Place& place : placement.placesOf(map.size(), group)) {
    const Settled settled = placement.settle(map.size(), {place}, group, {});
    if (settled.best.support.score > 0)
      addPlace(asMapPlace(settled, group, map.size()), scan.cell(), found.candidates);
  }
  std::stable_sort(
      found.candidates.begin(),
      found.candidates.end(),
      [](const MapPlace& a, const MapPlace& b) { return a.score > b.score; });
  decide(options.max_ambiguity, found);
  found.candidates.resize(std::min(found.candidates.size(), options.candidates));
  return found;
}

} // namespace pcl6d
