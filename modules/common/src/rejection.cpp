// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/rejection.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ostream>
#include <sstream>

namespace pcl6d {

namespace {
/** The name of a reason in files, and its words: {measured}, {needed}, {ratio} of both, {share}
 * and {least} of both in percent, {count:NOUN}, {deviations}, {status}, {found} by a search,
 * {text} and {cause}. */
struct ReasonWords {
  RejectReason reason;
  const char* name;
  const char* words;
};

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
     "one of its scans could not be matched"},
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

/** \return three digits, without powers of ten */
std::string
shortNumber(double value)
{
  constexpr double kWholeFrom = 100;
  std::ostringstream digits;
  if (std::abs(value) >= kWholeFrom)
    digits << std::fixed;
  digits.precision(std::abs(value) >= kWholeFrom ? 0 : 3);
  digits << value;
  return digits.str();
}

std::string
percent(double share)
{
  std::ostringstream digits;
  digits.precision(2);
  digits << 100 * share;
  return digits.str();
}

/** \return "1 scan", "2 scans" */
std::string
countOf(double number, const std::string& noun)
{
  return shortNumber(number) + ' ' + noun + (number == 1 ? "" : "s");
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
