// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "place_matching.h"
#include "place_starts.h"
#include "place_support.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/place_search.h>
#include <pcl6d/registration/icp.h>

#include <algorithm>
#include <sstream>

namespace pcl6d {
using namespace global_registration;

namespace {
/** So many placements of the plans are looked at, with another direction up fewer: it seldom
 * is. So many starts are matched. */
constexpr std::size_t kPlacements = 200, kOtherPlacements = 60, kMatchedPlaces = 30;

/** All of them are matched by few points, at least so many of the best by more. */
constexpr std::size_t kFinelyMatched = 10;

/** The search for one pair. */
class Search {
public:
  Search(const PlaceableScan& first,
         const PlaceableScan& second,
         const PlaceSearchOptions& options)
  : first_(first)
  , second_(second)
  , options_(options)
  , voxel_(std::max(first.scan().voxel(), second.scan().voxel()))
  , cell_(std::max(first.cell(), second.cell()))
  {}

  PlaceResult
  run() const
  {
    const UprightScan fixed(first_, first_.vertical().up, cell_);
    std::vector<PlaceStart> starts =
        startsOn(fixed, second_.vertical().up, kPlacements);
    PlaceResult result = judgedPlaces(starts);
    if (result.answer == PlaceAnswer::kUnique || !options_.any_axis ||
        second_.vertical().others.empty())
      return result;
    for (const auto& other : second_.vertical().others)
      for (const double sign : {1.0, -1.0}) {
        const auto more = startsOn(fixed, sign * other, kOtherPlacements);
        starts.insert(starts.end(), more.begin(), more.end());
      }
    sortByScore(starts);
    return judgedPlaces(starts);
  }

  PlaceCandidate
  judged(const Eigen::Isometry3d& T_first_second) const
  {
    return candidateAt(polished(T_first_second, second_.matched()));
  }

private:
  std::vector<PlaceStart>
  startsOn(const UprightScan& fixed,
           const Eigen::Vector3d& up,
           std::size_t placements) const
  {
    return placeStarts(
        fixed, UprightScan(second_, up, cell_), placements, options_.num_threads);
  }

  /** \param[in] starts the best first */
  PlaceResult
  judgedPlaces(const std::vector<PlaceStart>& starts) const
  {
    PlaceResult result;
    for (const auto& start : matched(starts))
      result.candidates.push_back(candidateAt(start));
    std::stable_sort(result.candidates.begin(),
                     result.candidates.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    decide(result);
    return result;
  }

  bool
  areNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
  {
    const MotionSize apart = distanceBetween(a, b);
    return apart.translation < kOtherCells * cell_ && apart.rotation < kOtherTurn;
  }

  /** The best few, each where matching brings it, without those that fall together. */
  std::vector<PlaceStart>
  matched(const std::vector<PlaceStart>& starts) const
  {
    std::vector<PlaceStart> chosen;
    for (const auto& start : starts) {
      if (chosen.size() == kMatchedPlaces)
        break;
      if (std::none_of(chosen.begin(), chosen.end(), [&](const PlaceStart& other) {
            return areNear(start.T_first_second, other.T_first_second);
          }))
        chosen.push_back(start);
    }
    polish(chosen, second_.judged());
    chosen.resize(
        std::min(chosen.size(), std::max(kFinelyMatched, 2 * options_.candidates)));
    polish(chosen, second_.matched());
    std::vector<PlaceStart> distinct;
    for (const auto& one : chosen)
      if (distinct.size() < options_.candidates && one.score > 0 &&
          std::none_of(distinct.begin(), distinct.end(), [&](const PlaceStart& other) {
            return areNear(one.T_first_second, other.T_first_second);
          }))
        distinct.push_back(one);
    return distinct;
  }

  /** Matches places by some of the points, and sorts them. */
  void
  polish(std::vector<PlaceStart>& places, const PlaceableScan::Sample& by) const
  {
    parallelFor(places.size(), options_.num_threads, [&](std::size_t i) {
      places[i] = polished(places[i].T_first_second, by);
    });
    sortByScore(places);
  }

  PlaceStart
  polished(const Eigen::Isometry3d& T_first_second,
           const PlaceableScan::Sample& sample) const
  {
    const IcpResult found = icp({first_.scan().surfaces().part()},
                                {&sample.points, &sample.normals},
                                T_first_second,
                                matchingOptions(voxel_, 2 * cell_));
    PlaceStart place{found.T_target_source, 0};
    const PlaceSupport support = supportOf(first_,
                                           second_,
                                           place.T_first_second,
                                           kMetVoxels * voxel_,
                                           kPlaceVoxels * voxel_);
    place.score = support.score(kContradictedMatch);
    return place;
  }

  PlaceCandidate
  candidateAt(const PlaceStart& start) const
  {
    PlaceCandidate one;
    one.T_first_second = start.T_first_second;
    const PlaceSupport support = supportOf(first_,
                                           second_,
                                           one.T_first_second,
                                           kMetVoxels * voxel_,
                                           kPlaceVoxels * voxel_);
    one.overlap = support.overlap();
    one.evidence = linkEvidence(first_.scan(), second_.scan(), one.T_first_second);
    one.contradiction = one.evidence.sight.contradiction();
    one.score = one.overlap * portableExp(-one.contradiction / kContradictedPlace);
    one.opinion = judgeLink(one.evidence, contradictionBackground({}));
    return one;
  }

  void
  decide(PlaceResult& result) const
  {
    std::ostringstream reason; // read by people
    reason.precision(3);
    const auto& candidates = result.candidates;
    if (candidates.empty())
      reason << "no place where surfaces of both meet";
    else if (candidates[0].opinion.trust != LinkTrust::kGood)
      reason << "the best place is " << toString(candidates[0].opinion.trust) << ": "
             << candidates[0].opinion.reason;
    else if (candidates[0].overlap < kLeastOverlap)
      reason << "at the best place only " << 100 * candidates[0].overlap
             << " % of the surfaces meet";
    else if (result.ambiguity() > options_.max_ambiguity) {
      const MotionSize apart =
          distanceBetween(candidates[0].T_first_second, candidates[1].T_first_second);
      result.answer = PlaceAnswer::kAmbiguous;
      reason << "a place " << apart.translation << " m and " << apart.rotation / kDegree
             << " deg from the best has " << result.ambiguity() << " of its score";
    }
    else
      result.answer = PlaceAnswer::kUnique;
    result.reason = reason.str();
  }

  const PlaceableScan& first_;
  const PlaceableScan& second_;
  const PlaceSearchOptions options_;
  double voxel_, cell_; // [m]
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

void
PlaceSearchOptions::validate() const
{
  require(candidates > 0, "candidates", candidates, "> 0");
  require(max_ambiguity >= 0 && max_ambiguity <= 1,
          "max_ambiguity",
          max_ambiguity,
          "in [0, 1]");
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
judgePlace(const PlaceableScan& first,
           const PlaceableScan& second,
           const Eigen::Isometry3d& T_first_second)
{
  if (!isRigid(T_first_second))
    throw BadArgument("T_first_second is not a rigid motion");
  return Search(first, second, {}).judged(T_first_second);
}

} // namespace pcl6d
