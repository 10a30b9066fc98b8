// SPDX-License-Identifier: BSD-3-Clause
#include "rejection_numbers.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/rejection.h>

#include <algorithm>
#include <iterator>
#include <ostream>

namespace pcl6d {

namespace {
/** The name of a reason in files, and its words: {measured}, {needed}, {ratio} of both, {share}
 * and {least} of both in percent, {count:NOUN}, {deviations}, {status}, {found} by a search,
 * {text}, {cause} and {causes}; {metres} and {degrees} of a pose, and how many {more}. */
struct ReasonWords {
  RejectReason reason;
  const char* name;
  const char* words;
};

using rejection_numbers::andMore;
using rejection_numbers::countOf;
using rejection_numbers::fixed;
using rejection_numbers::percent;
using rejection_numbers::shortNumber;
using Reason = RejectReason;
constexpr ReasonWords kReasons[] = {
    {Reason::kNone, "", ""},
    {Reason::kStated, "stated", "{text}"},

    {Reason::kIcpFailed, "icp-failed", "ICP: {status}"},
    {Reason::kNoInitialPose, "no-initial-pose", "{text}: {found}"},
    {Reason::kOverlapTooSmall,
     "overlap-too-small",
     "overlap {measured} is less than {needed}"},
    {Reason::kTooFewPairs, "too-few-pairs", "{measured} pairs, fewer than {needed}"},
    {Reason::kUnrelatedPoints,
     "unrelated-points",
     "rms {measured} m is larger than {needed} m: unrelated points"},
    {Reason::kCorrectionTooLarge,
     "correction-too-large",
     "a correction of {measured} m is too large for a step of {needed} m"},
    {Reason::kAgreementLost,
     "agreement-lost",
     "agreement fell from {needed} to {measured}{deviations}"},
    {Reason::kAgreementWithPreviousLost,
     "agreement-with-previous-lost",
     "agreement with the scan before fell from {needed} to {measured}"},
    {Reason::kInconsistentPose,
     "inconsistent-pose",
     "points and rays contradict the matched pose"},
    {Reason::kNotMatchedWhereFound,
     "not-matched-where-found",
     "found again, but not matched there: {cause}"},
    {Reason::kLostTogether,
     "lost-together",
     "lost together with {count:other scan}, matched to each other"},
    {Reason::kNoPoseInMap, "no-pose-in-map", "in the map: {cause}"},
    {Reason::kNotJoined, "not-joined", "not joined to another scan: {cause}"},

    {Reason::kNoSurfacesMeet, "no-surfaces-meet", "no surfaces meet"},
    {Reason::kTooFewSurfacesMeet,
     "too-few-surfaces-meet",
     "at the best pose {share} % of the surfaces meet, fewer than {least} %"},
    {Reason::kSecondPose,
     "second-pose",
     "a second pose{text} fits nearly as well: {measured} of the best score"},
    {Reason::kSurfaceViolated,
     "surface-violated",
     "rays pass through {share} % of the points at the best pose, more than {least} %"},
    {Reason::kInconsistentLink,
     "inconsistent-link",
     "another scan contradicts the best pose: {cause}"},
    {Reason::kNoConsistentLink,
     "no-consistent-link",
     "no link to another scan confirms the best pose"},
    {Reason::kInconsistentTogether,
     "inconsistent-together",
     "rays go through {measured} of {needed} patches of surface between this part and "
     "the rest"},
    {Reason::kInTwoGroups,
     "in-two-groups",
     "a pose in each of two disconnected groups of scans"},
    {Reason::kNeighbourInTwoGroups,
     "neighbour-in-two-groups",
     "the scan at the other end of the link has a pose in each of two groups"},
    {Reason::kBetterPoseElsewhere,
     "better-pose-elsewhere",
     "another pose is better for the other scans of the group"},
    {Reason::kLinkNotGood, "link-not-good", "the best pose is {text}: {cause}"},
    {Reason::kFreeDirection,
     "free-direction",
     "the surfaces leave a motion open: poses along the free direction fit equally "
     "well"},
    {Reason::kRunWithoutPose,
     "run-without-pose",
     "no scan of {measured} searched scans has a unique pose in the map ({cause})"},
    {Reason::kRunContradictory,
     "run-contradictory",
     "the poses of {measured} searched scans contradict each other"},

    {Reason::kFreeDirections,
     "free-directions",
     "the surfaces leave {count:motion} open, as along a corridor"},
    {Reason::kTooFewConfirmed,
     "too-few-confirmed",
     "rays confirm only {share} % of the points"},
    {Reason::kPatchesViolated,
     "patches-violated",
     "rays go through {measured} of {needed} patches of surface"},
    {Reason::kTooFewPatches,
     "too-few-patches",
     "only {measured} patches of surface in common"},
    {Reason::kShifted,
     "shifted",
     "surfaces ask for a shift of {measured} m, {ratio} standard deviations"},
    {Reason::kOffCentre,
     "off-centre",
     "a scan is not centred on its scanner: only surfaces are compared"},
    {Reason::kTooFewSurfaces,
     "too-few-surfaces",
     "a scan has too few surfaces, or its rays contradict its own points"},
    {Reason::kRaysUnreliable,
     "rays-unreliable",
     "rays contradict too much even where the scans of this map fit best"},
    {Reason::kSamePoints, "same-points", "both scans hold the very same points"},
    {Reason::kScanUnregistered,
     "scan-unregistered",
     "unregistered scan: its pose is only predicted"},
    {Reason::kContradictsLinks, "contradicts-links", "contradicts the other links"},
    {Reason::kContradictsLoops,
     "contradicts-loops",
     "contradicts {count:loop} beside it, agrees with {needed}"},
    {Reason::kSurfacePassed,
     "surface-passed",
     "a scan looked through surfaces of the other (consistency {measured}, less than "
     "{needed})"},

    {Reason::kScanAgreementLost,
     "scan-agreement-lost",
     "agreement of scan {text} fell from {needed} to {measured}{deviations}"},
    {Reason::kRelaxationFailed, "relaxation-failed", "relaxation: {status}"},
    {Reason::kLoopClosingFailed, "loop-closing-failed", "loop closing: {status}"},
    {Reason::kNoCycle, "no-cycle", "the links close no cycle"},
    {Reason::kNoNeighbours, "no-neighbours", "no scan has a neighbour"},
    {Reason::kNothingJoined, "nothing-joined", "no two scans could be connected"},
    {Reason::kNoSolution, "no-solution", "no solution: {status}"},
    {Reason::kNoClearGain,
     "no-clear-gain",
     "the scans do not agree clearly better ({needed} to {measured})"},

    {Reason::kNoMotionSeen, "no-motion-seen", "no motion that could be seen"},
    {Reason::kDeskewedAgreesLess,
     "deskewed-agrees-less",
     "the deskewed points agree less"},
    {Reason::kDeskewedNotBetter,
     "deskewed-not-better",
     "the deskewed points do not agree clearly better"},
    {Reason::kTurnTooLarge,
     "turn-too-large",
     "a turn of {measured} deg between two knots, more than {needed} deg"},
    {Reason::kNoPreviousScanMet,
     "no-previous-scan-met",
     "no overlap with the scans before"},
    {Reason::kTooLittleKnown,
     "too-little-known",
     "too little is known of the motion after the scan"},
    {Reason::kOneTime, "one-time", "the points have equal times"},
    {Reason::kNoNextScan, "no-next-scan", "no later scan to compare with"},

    {Reason::kLinkNotConsistent, "link-not-consistent", "with {text}: {cause}"},
    {Reason::kNoCommonSurfaces,
     "no-common-surfaces",
     "no second scan has these surfaces"},
    {Reason::kContradictsScan, "contradicts-scan", "contradicts {text}: {cause}"},
    {Reason::kFitsElsewhere,
     "fits-elsewhere",
     "fits as well {metres} m away, turned by {degrees} deg, beside {text}"},
    {Reason::kSecondPoseNotSought,
     "second-pose-not-sought",
     "found by a search, not tested for a second place"},
    {Reason::kScansDisconnected,
     "scans-disconnected",
     "{count:scan} not connected to the rest: {text} ({cause}); better initial poses "
     "or "
     "scans in between would help"},
    {Reason::kScansContradict,
     "scans-contradict",
     "scans contradict each other: {causes}"},
    {Reason::kSingleLinksContradict,
     "single-links-contradict",
     "most links of these scans are consistent, a single link is not (glass, dynamic "
     "objects, little overlap?): {causes}"},
    {Reason::kPosesAmbiguous,
     "poses-ambiguous",
     "AMBIGUOUS, two places fit: {causes}; rough initial poses, or scans on the way "
     "between, would decide"},
    {Reason::kSecondPosesNotSought,
     "second-poses-not-sought",
     "{count:scan} found by a search, not tested for a second place, as the map is "
     "doubted anyway: {text}"},
    {Reason::kOfScans, "of-scans", "{text} ({cause})"},
    {Reason::kScansOffCentre,
     "scans-off-centre",
     "{count:scan} not centred on the scanner (rays from the origin would cross "
     "surfaces of their own scan): free-space tests are off, only surfaces were "
     "compared: {text}"},
    {Reason::kScansNotVerified,
     "scans-not-verified",
     "{count:scan} cannot be verified: too few surfaces, or rays contradicting points "
     "of their own scan (merged scans, motion during the scan?): {text}"},
    {Reason::kBackgroundTooHigh,
     "background-too-high",
     "rays contradict {share} % of the surface even where scans fit best (glass, "
     "motion "
     "during the scan, errors of the scanner?): rays cannot tell equal-looking places "
     "apart"},
    {Reason::kPoseMistake, "pose-mistake", "{text}"},
    {Reason::kScansAreCopies,
     "scans-are-copies",
     "scans are copies of earlier scans and verify no pose: {text}{more}"},
    {Reason::kSingleScan,
     "single-scan",
     "a single scan: no second scan to verify the pose"},
    {Reason::kNoSurfacesAtPose,
     "no-surfaces-at-pose",
     "at this pose the scans have no surfaces in common"},
    {Reason::kPoseContradicted,
     "pose-contradicted",
     "the scans contradict this pose: {cause}"},
    {Reason::kPoseUndecided, "pose-undecided", "the scans do not decide: {cause}"},
    {Reason::kPoseNotTested, "pose-not-tested", "the scans are no evidence: {cause}"},
};

const ReasonWords&
rowOf(RejectReason reason)
{
  const auto* const row =
      std::find_if(std::begin(kReasons), std::end(kReasons), [&](const auto& one) {
        return one.reason == reason;
      });
  return row != std::end(kReasons) ? *row : kReasons[0];
}

/** \return the first sentences, separated by commas */
std::string
listOf(const std::vector<Rejection>& causes)
{
  constexpr std::size_t kMostListed = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(causes.size(), kMostListed); ++i)
    text += (i > 0 ? ", " : "") + toWords(causes[i]);
  return causes.size() > kMostListed
             ? text + andMore(static_cast<double>(causes.size() - kMostListed))
             : text;
}

/** \return why no initial pose was found */
const char*
searchWords(Status status)
{
  return status == Status::kRankDeficient ? "several places fit equally well"
                                          : "too little in common with the last scans";
}

/** \return the value of a placeholder of ReasonWords */
std::string
valueOf(const std::string& name, const Rejection& rejection)
{
  if (name == "measured")
    return shortNumber(rejection.measured);
  if (name == "needed")
    return shortNumber(rejection.needed);
  if (name == "deviations")
    return rejection.deviations > 0
               ? ", " + shortNumber(rejection.deviations) + " standard deviations"
               : "";
  if (name == "ratio")
    return shortNumber(rejection.measured / rejection.needed);
  if (name == "share")
    return percent(rejection.measured);
  if (name == "least")
    return percent(rejection.needed);
  if (name.rfind("count:", 0) == 0)
    return countOf(rejection.measured, name.substr(std::string("count:").size()));
  if (name == "status")
    return toString(rejection.status);
  if (name == "found")
    return searchWords(rejection.status);
  if (name == "cause")
    return toWords(rejection.causes);
  if (name == "causes")
    return listOf(rejection.causes);
  if (name == "metres")
    return fixed(rejection.measured, 1);
  if (name == "degrees")
    return fixed(rejection.needed, 0);
  if (name == "more")
    return andMore(rejection.measured - 1);
  return rejection.text;
}
} // namespace

const char*
toString(RejectReason reason)
{
  return rowOf(reason).name;
}

RejectReason
rejectReasonFromName(const std::string& name)
{
  for (const ReasonWords& row : kReasons)
    if (row.name == name)
      return row.reason;
  throw BadArgument("no reason of a rejection is called '" + name + "'");
}

Rejection
Rejection::stated(std::string words)
{
  Rejection rejection;
  rejection.reason = words.empty() ? RejectReason::kNone : RejectReason::kStated;
  rejection.text = std::move(words);
  return rejection;
}

std::string
toWords(const Rejection& rejection)
{
  const std::string pattern = rowOf(rejection.reason).words;
  std::string words;
  for (std::size_t at = 0; at < pattern.size();) {
    if (pattern[at] != '{') {
      words += pattern[at++];
      continue;
    }
    const std::size_t end = pattern.find('}', at);
    words += valueOf(pattern.substr(at + 1, end - at - 1), rejection);
    at = end + 1;
  }
  return words;
}

std::string
toWords(const std::vector<Rejection>& rejections)
{
  std::string words;
  for (const Rejection& one : rejections)
    words += (words.empty() ? "" : "; ") + toWords(one);
  return words;
}

std::vector<std::string>
wordsOfEach(const std::vector<Rejection>& rejections)
{
  std::vector<std::string> words;
  words.reserve(rejections.size());
  for (const Rejection& one : rejections)
    words.push_back(toWords(one));
  return words;
}

bool
operator==(const Rejection& a, const Rejection& b)
{
  return a.reason == b.reason && a.measured == b.measured && a.needed == b.needed &&
         a.deviations == b.deviations && a.status == b.status && a.text == b.text &&
         a.causes == b.causes;
}

std::ostream&
operator<<(std::ostream& out, const Rejection& rejection)
{
  return out << toWords(rejection);
}

} // namespace pcl6d
