// SPDX-License-Identifier: BSD-3-Clause
#include "pair/pair_places.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/pose.h>

#include <sstream>
#include <string>

namespace pcl6d::global_registration {

namespace {
/** Whether a pose is good except for motions left open by the surfaces. */
bool
isGoodButOpen(const PlaceCandidate& place)
{
  if (place.evidence.fit.open_directions == 0)
    return false;
  LinkEvidence fixed = place.evidence;
  fixed.fit.open_directions = 0;
  return testLink(fixed, contradictionBackground({})).trust == LinkTrust::kGood;
}

/** \return why the best pose is not reliable */
Rejection
rejectionOf(const PlaceCandidate& best, const PlaceSearchOptions& options)
{
  if (best.test_result.trust != LinkTrust::kGood && !isGoodButOpen(best)) {
    Rejection link(RejectReason::kLinkNotGood, best.test_result.rejection);
    link.text = toString(best.test_result.trust);
    return link;
  }
  if (best.overlap < options.min_overlap)
    return {RejectReason::kTooFewSurfacesMeet, best.overlap, options.min_overlap};
  if (best.contradiction > options.max_contradiction)
    return {
        RejectReason::kSurfaceViolated, best.contradiction, options.max_contradiction};
  return {};
}

Rejection
secondPose(const PlaceResult& result, double max_ambiguity)
{
  const MotionSize apart = distanceBetween(result.candidates[0].T_first_second,
                                           result.candidates[1].T_first_second);
  std::ostringstream text;
  text.precision(3);
  text << ' ' << apart.translation << " m and " << apart.rotation / kDegree
       << " deg away";
  Rejection second(RejectReason::kSecondPose, result.ambiguity(), max_ambiguity);
  second.text = text.str();
  return second;
}
} // namespace

void
decideUniqueness(const PairPlaces& places,
                 const PlaceSearchOptions& options,
                 PlaceResult& result)
{
  result.answer = PlaceAnswer::kNone;
  if (result.candidates.empty()) {
    result.rejection = RejectReason::kNoSurfacesMeet;
    return;
  }
  const PlaceCandidate& best = result.candidates.front();
  result.rejection = rejectionOf(best, options);
  if (result.rejection)
    return;
  result.answer = PlaceAnswer::kAmbiguous;
  if (result.ambiguity() > options.max_ambiguity)
    result.rejection = secondPose(result, options.max_ambiguity);
  else if (best.evidence.fit.open_directions > 0 &&
           !places.isHeld(best, options.max_ambiguity))
    result.rejection = RejectReason::kFreeDirection;
  else
    result.answer = PlaceAnswer::kUnique;
}

} // namespace pcl6d::global_registration
