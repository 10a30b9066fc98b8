// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Why a match, a pose, a link or a stage was rejected, or a map is in doubt. The comment of a reason says what
 * Rejection::measured and Rejection::needed hold; its words are in src/rejection.cpp. */
enum class RejectReason {
  kNone,   ///< accepted
  kStated, ///< in words only (text): from a file of a run, or from an error

  // a match of a scan with the scans before
  kIcpFailed,          ///< status
  kNoInitialPose,      ///< text: the start that was tried; status
  kOverlapTooSmall,    ///< overlap; least overlap
  kTooFewPairs,        ///< pairs; least number
  kUnrelatedPoints,    ///< rms of the pairs [m]; largest rms of scans that overlap
  kCorrectionTooLarge, ///< correction [m]; step of the odometry [m]
  kAgreementLost,      ///< agreement after; before
  kAgreementWithPreviousLost, ///< agreement with the previous scan after; before
  kInconsistentPose,          ///< verification contradicts the matched pose
  kNotMatchedWhereFound,      ///< recovery found a pose, ICP rejected it: cause
  kLostTogether,              ///< number of further lost scans, matched to each other
  kNoPoseInMap,               ///< recovery found none: cause
  kNotJoined,                 ///< no pose relative to any other scan: cause

  // a pose found by place recognition
  kNoSurfacesMeet,     ///< no candidate pose at which surfaces meet
  kTooFewSurfacesMeet, ///< overlap; least overlap
  kSecondPose,       ///< score of a second pose / score of the best one; largest ratio;
                     ///< text: how far apart the two are
  kSurfaceViolated,  ///< share of points in measured free space; largest share
  kInconsistentLink, ///< the link with a scan is wrong: cause
  kNoConsistentLink, ///< no link confirms the pose
  kInconsistentTogether, ///< violated patches of all links together; patches
  kInTwoGroups,          ///< a pose in each of two disconnected groups
  kNeighbourInTwoGroups, ///< the scan at the other end of the link has poses in two groups
  kBetterPoseElsewhere, ///< without the scan's own links another pose is better
  kLinkNotGood,         ///< text: trust of the link at the best pose; cause
  kFreeDirection,    ///< poses along a direction that surfaces leave free fit as well
  kRunWithoutPose,   ///< scans of the run that were looked for; cause
  kRunContradictory, ///< scans of the run that were looked for

  // a link between two scans
  kFreeDirections,   ///< number of motions that the surfaces leave free
  kTooFewConfirmed,  ///< share of points that rays confirm; least share
  kPatchesViolated,  ///< patches of surface that rays pass through; patches
  kTooFewPatches,    ///< patches of surface in common; least number
  kShifted,          ///< shift that surfaces ask for [m]; its standard deviation [m]
  kOffCentre,        ///< a scan is not centred on its scanner
  kTooFewSurfaces,   ///< of a scan, or its rays contradict its own points
  kRaysUnreliable,   ///< rays contradict even the best links of the map
  kSamePoints,       ///< both scans hold the same points
  kScanUnregistered, ///< the scan, or one of the link, is not registered
  kContradictsLinks, ///< switched off by the other links
  kContradictsLoops, ///< neighbouring loops that contradict the link; that agree
  kSurfacePassed,    ///< share of points near surfaces; least share

  // a stage
  kScanAgreementLost, ///< agreement of a scan after; before; text: index of the scan
  kRelaxationFailed,  ///< status
  kLoopClosingFailed, ///< status
  kNoCycle,           ///< the links close no cycle
  kNoNeighbours,      ///< no scan has a neighbour
  kNothingJoined,     ///< no two scans could be joined
  kNoSolution,        ///< status
  kNoClearGain,       ///< agreement after; before

  // the motion within a scan
  kNoMotionSeen,       ///< way of the points in multiples of the noise
  kDeskewedAgreesLess, ///< agreement after; before
  kDeskewedNotBetter,  ///< agreement after; before
  kTurnTooLarge,       ///< turn between two knots [deg]; largest turn [deg]
  kNoPreviousScanMet,  ///< overlap; least overlap
  kTooLittleKnown,     ///< of the motion after the first scan
  kOneTime,            ///< times of the points do not differ
  kNoNextScan,         ///< no scan follows

  // a doubt about a scan of a map
  kLinkNotConsistent, ///< text: scan at the other end of its most informative link; cause
  kNoCommonSurfaces, ///< no link of the scan has surfaces in common
  kContradictsScan,  ///< text: the other scan, which is connected, too; cause
  kFitsElsewhere, ///< distance to a second pose [m]; turn to it [deg]; text: scan beside
  kSecondPoseNotSought, ///< found without a prior pose, in a map that is doubted anyway

  // a doubt about a map
  kScansDisconnected,     ///< number of scans; text: names; cause, of one of them
  kScansContradict,       ///< number of links; causes: kOfScans, one per link
  kSingleLinksContradict, ///< number of links; causes: kOfScans, one per link
  kPosesAmbiguous,        ///< number of scans; causes: kOfScans, one per scan
  kSecondPosesNotSought,  ///< number of scans; text: names
  kOfScans,               ///< text: a scan, or the two of a link; cause
  kScansOffCentre,        ///< number of scans; text: names
  kScansNotVerified,      ///< number of scans; text: names
  kBackgroundTooHigh,     ///< share of patches violated in correct links; largest share
  kPoseMistake,           ///< text: the mistake, such as positions in feet
  kScansAreCopies,        ///< number of copies; text: a copy and its original
  kSingleScan,            ///< no second scan to test with
  kNoSurfacesAtPose,      ///< of two scans: nothing in common at the given pose
  kPoseContradicted,      ///< of two scans: cause
  kPoseUndecided,         ///< of two scans: too little to decide; cause
  kPoseNotTested          ///< of two scans: free-space test inconclusive; cause
};

/** \return a word for files, such as "overlap-too-small"; "" for kNone */
const char*
toString(RejectReason reason);
/** \throws BadArgument no reason has that name */
RejectReason
rejectReasonFromName(const std::string& name);

/** \brief A decision against a result: the reason and the numbers behind it. False as a
 * condition if the result was accepted. \ingroup common */
struct Rejection {
  Rejection() = default;
  Rejection(RejectReason why, double was = 0, double limit = 0)
  : reason(why), measured(was), needed(limit)
  {}
  Rejection(RejectReason why, Status result) : reason(why), status(result) {}
  Rejection(RejectReason why, Rejection cause) : reason(why), causes{std::move(cause)}
  {}
  /** \return in words only; accepted if there are none */
  static Rejection
  stated(std::string words);

  explicit operator bool() const { return reason != RejectReason::kNone; }

  RejectReason reason = RejectReason::kNone;
  double measured = 0;   ///< unit by reason
  double needed = 0;     ///< limit or reference of measured, in its unit
  double deviations = 0; ///< |measured - needed| / standard deviation; 0: not known
  Status status = Status::kOk; ///< of the estimator that failed
  std::string text;            ///< a name, by reason
  std::vector<Rejection>
      causes; ///< cause of this rejection; several only if the reason says so
};

/** \return one sentence without a full stop, with the numbers; "" if accepted */
std::string
toWords(const Rejection& rejection);
/** \return the sentences of several rejections, separated by semicolons */
std::string
toWords(const std::vector<Rejection>& rejections);

/** \return the sentence of each rejection */
std::vector<std::string>
wordsOfEach(const std::vector<Rejection>& rejections);

bool
operator==(const Rejection& a, const Rejection& b);
inline bool
operator!=(const Rejection& a, const Rejection& b)
{
  return !(a == b);
}
std::ostream&
operator<<(std::ostream& out, const Rejection& rejection);

template <typename Archive>
void
packFields(Archive& archive, Rejection& rejection)
{
  archive(rejection.reason, rejection.measured, rejection.needed, rejection.status);
  archive(rejection.deviations, rejection.text, rejection.causes);
}

} // namespace pcl6d
