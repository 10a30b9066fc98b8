// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "pair/pair_places.h"
#include "pair/place_matching.h"
#include "pair/place_starts.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/place_search.h>
#include <pcl6d/registration/icp.h>

#include <algorithm>
#include <array>
#include <utility>

namespace pcl6d {
using namespace global_registration;

namespace {
/** Number of scored placements of the plans, fewer for a second vertical, which is rarely
 * right; number of matched starts. */
constexpr std::size_t kPlacements = 400, kOtherPlacements = 60, kMatchedPlaces = 30;

/** Every start is matched with few points, at least this number of the best with more. */
constexpr std::size_t kFinelyMatched = 10;

/** The search for one pair. */
class Search {
public:
  Search(const PlaceableScan& first,
         const PlaceableScan& second,
         const PlaceSearchOptions& options)
  : first_(first), second_(second), options_(options), places_(first, second)
  {}

  PlaceResult
  run() const
  {
    const UprightScan fixed(first_, first_.vertical().up, places_.cell());
    std::vector<PlaceStart> starts =
        startsOn(fixed, second_.vertical().up, kPlacements);
    PlaceResult result = evaluatedPlaces(starts);
    if (!options_.any_axis || second_.vertical().others.empty() || isClear(result))
      return result;
    for (const auto& other : second_.vertical().others)
      for (const double sign : {1.0, -1.0}) {
        auto more = startsOn(fixed, sign * other, kOtherPlacements);
        for (auto& one : more)
          one.placement = kOtherPlacements; // second vertical
        starts.insert(starts.end(), more.begin(), more.end());
      }
    sortByScore(starts);
    return evaluatedPlaces(starts);
  }

private:
  /** Whether the best pose stands out: the vertical is then beyond doubt. */
  bool
  isClear(const PlaceResult& result) const
  {
    return !result.candidates.empty() &&
           result.candidates[0].test_result.trust == LinkTrust::kGood &&
           result.candidates[0].overlap >= kLeastOverlap &&
           result.ambiguity() < options_.max_ambiguity;
  }

  std::vector<PlaceStart>
  startsOn(const UprightScan& fixed,
           const Eigen::Vector3d& up,
           std::size_t placements) const
  {
    return placeStarts(fixed,
                       UprightScan(second_, up, places_.cell()),
                       placements,
                       options_.num_threads);
  }

  /** \param[in] starts the best first */
  PlaceResult
  evaluatedPlaces(const std::vector<PlaceStart>& starts) const
  {
    PlaceResult result;
    for (const auto& start : matched(starts))
      result.candidates.push_back(places_.evaluated(start.T_first_second));
    std::stable_sort(result.candidates.begin(),
                     result.candidates.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    decideUniqueness(places_, options_, result);
    return result;
  }

  /** Starts for consecutive scans: the identity, with equal sensor frames or with equal
   * verticals. Plans of sparse scans may miss this start. */
  std::vector<PlaceStart>
  smallMotions() const
  {
    PlaceStart same, upright;
    upright.T_first_second.linear() =
        uprightRotation(first_.vertical().up).transpose() *
        uprightRotation(second_.vertical().up);
    if (places_.areNear(same.T_first_second, upright.T_first_second))
      return {same};
    return {same, upright};
  }

  /** The best few poses, each after matching, without duplicates. */
  std::vector<PlaceStart>
  matched(const std::vector<PlaceStart>& starts) const
  {
    std::vector<PlaceStart> chosen = smallMotions();
    std::array<bool, kTrustedPlacements> is_known{};
    for (const auto& start : starts) {
      const bool is_trusted =
          start.placement < kTrustedPlacements && !is_known[start.placement];
      if (chosen.size() >= kMatchedPlaces && !is_trusted)
        continue;
      if (is_trusted)
        is_known[start.placement] = true;
      if (std::none_of(chosen.begin(), chosen.end(), [&](const PlaceStart& other) {
            return places_.areNear(start.T_first_second, other.T_first_second);
          }))
        chosen.push_back(start);
    }
    polish(chosen, second_.evaluated());
    chosen.resize(
        std::min(chosen.size(), std::max(kFinelyMatched, 2 * options_.candidates)));
    polish(chosen, second_.matched());
    std::vector<PlaceStart> distinct;
    for (const auto& one : chosen)
      if (distinct.size() < options_.candidates && one.score > 0 &&
          std::none_of(distinct.begin(), distinct.end(), [&](const PlaceStart& other) {
            return places_.areNear(one.T_first_second, other.T_first_second);
          }))
        distinct.push_back(one);
    return distinct;
  }

  /** Matches poses with a part of the points, and sorts them. */
  void
  polish(std::vector<PlaceStart>& places, const PlaceableScan::Sample& by) const
  {
    parallelFor(places.size(), options_.num_threads, [&](std::size_t i) {
      places[i] = places_.matched(places[i].T_first_second, by);
    });
    sortByScore(places);
  }

  const PlaceableScan& first_;
  const PlaceableScan& second_;
  const PlaceSearchOptions& options_;
  PairPlaces places_;
};
} // namespace

const char*
toString(PlaceAnswer answer)
{
  switch (answer) {
  case PlaceAnswer::kUnique:
    return "unique";
  case PlaceAnswer::kAmbiguous:
    return "ambiguous";
  case PlaceAnswer::kNone:
    break;
  }
  return "none";
}

double
PlaceResult::ambiguity() const
{
  if (candidates.size() < 2 || candidates[0].score <= 0)
    return 0;
  return candidates[1].score / candidates[0].score;
}

PlaceSearchOptions
PlaceSearchOptions::forTwoScans()
{
  PlaceSearchOptions options;
  options.min_overlap = 0.2;
  options.max_contradiction = 0.01;
  return options;
}

void
PlaceSearchOptions::validate() const
{
  require(candidates > 0, "candidates", candidates, "> 0");
  for (const auto& [share, name] : {std::pair(max_ambiguity, "max_ambiguity"),
                                    std::pair(min_overlap, "min_overlap"),
                                    std::pair(max_contradiction, "max_contradiction")})
    require(share >= 0 && share <= 1, name, share, "in [0, 1]");
}

PlaceResult
placeScan(const PlaceableScan& first,
          const PlaceableScan& second,
          const PlaceSearchOptions& options)
{
  options.validate();
  return Search(first, second, options).run();
}

PlaceCandidate
evaluatePlace(const PlaceableScan& first,
              const PlaceableScan& second,
              const Eigen::Isometry3d& T_first_second)
{
  if (!isRigid(T_first_second))
    throw BadArgument("T_first_second is not a rigid motion");
  const PairPlaces places(first, second);
  return places.evaluated(
      places.matched(T_first_second, second.matched()).T_first_second);
}

Eigen::Isometry3d
refinePlace(const PlaceableScan& first,
            const PlaceableScan& second,
            const Eigen::Isometry3d& T_first_second,
            unsigned int num_threads)
{
  if (!isRigid(T_first_second))
    throw BadArgument("T_first_second is not a rigid motion");
  const double voxel = std::max(first.scan().voxel(), second.scan().voxel());
  const double cell = std::max(first.cell(), second.cell());
  const IcpResult found = icp({first.scan().surfaces().part()},
                              second.scan().surfaces().source(),
                              T_first_second,
                              fineOptions(voxel, num_threads));
  const MotionSize way = distanceBetween(T_first_second, found.T_target_source);
  const bool is_near =
      way.translation < kOtherCells * cell && way.rotation < kOtherTurn;
  return is_near ? found.T_target_source : T_first_second;
}

} // namespace pcl6d
