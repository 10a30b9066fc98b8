// SPDX-License-Identifier: BSD-3-Clause
#include "pair_places.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/pose.h>

#include <sstream>
#include <string>

namespace pcl6d::global_registration {

namespace {
/** Whether a place is good but for motions that the surfaces leave open. */
bool
isGoodButOpen(const PlaceCandidate& place)
{
  if (place.evidence.fit.open_directions == 0)
    return false;
  LinkEvidence fixed = place.evidence;
  fixed.fit.open_directions = 0;
  return judgeLink(fixed, contradictionBackground({})).trust == LinkTrust::kGood;
}

std::string
percent(double share)
{
  std::ostringstream text;
  text.precision(2);
  text << 100 * share << " %";
  return text.str();
}

/** Why the best place is none that can be believed; nothing if it can. */
std::string
doubtOf(const PlaceCandidate& best, const PlaceSearchOptions& options)
{
  if (best.opinion.trust != LinkTrust::kGood && !isGoodButOpen(best))
    return std::string("the best place is ") + toString(best.opinion.trust) + ": " +
           best.opinion.reason;
  if (best.overlap < options.min_overlap)
    return "at the best place only " + percent(best.overlap) + " of the surfaces meet";
  if (best.contradiction > options.max_contradiction)
    return "at the best place rays go through " + percent(best.contradiction) +
           " of the surfaces: of things that moved, or of another place that looks "
           "alike";
  return "";
}

std::string
secondPlace(const PlaceResult& result)
{
  const MotionSize apart = distanceBetween(result.candidates[0].T_first_second,
                                           result.candidates[1].T_first_second);
  std::ostringstream text;
  text.precision(3);
  text << "a place " << apart.translation << " m and " << apart.rotation / kDegree
       << " deg from the best has " << result.ambiguity() << " of its score";
  return text.str();
}
} // namespace

void
decideUniqueness(const PairPlaces& places,
                 const PlaceSearchOptions& options,
                 PlaceResult& result)
{
  result.answer = PlaceAnswer::kNone;
  if (result.candidates.empty()) {
    result.reason = "no place where surfaces of both meet";
    return;
  }
  const PlaceCandidate& best = result.candidates.front();
  result.reason = doubtOf(best, options);
  if (!result.reason.empty())
    return;
  result.answer = PlaceAnswer::kAmbiguous;
  if (result.ambiguity() > options.max_ambiguity)
    result.reason = secondPlace(result);
  else if (best.evidence.fit.open_directions > 0 &&
           !places.isHeld(best, options.max_ambiguity))
    result.reason = "the surfaces leave a motion open, and places along it are as good";
  else
    result.answer = PlaceAnswer::kUnique;
}

} // namespace pcl6d::global_registration
