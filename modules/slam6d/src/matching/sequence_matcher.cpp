// SPDX-License-Identifier: BSD-3-Clause
#include "matching/sequence_matcher.h"
#include "recovery/recovery_stage.h"
#include "registered.h"

#include <pcl6d/common/pose.h>

#include <algorithm>
#include <optional>
#include <string>

namespace pcl6d::slam6d {

bool
isRecovering(const Slam6DOptions& options)
{
  return options.recovery != RecoveryEffort::kOff &&
         (options.initial_guess == InitialGuess::kOdometry ||
          options.initial_guess == InitialGuess::kOverlap);
}

bool
hasGivenPoses(const std::vector<ScanResult>& scans)
{
  return std::any_of(scans.begin(), scans.end(), [&](const ScanResult& scan) {
    return !scan.initial_pose.isApprox(scans.front().initial_pose, 1e-12);
  });
}

Eigen::Isometry3d
predictedPose(const std::vector<ScanResult>& scans, std::size_t scan)
{
  if (scan == 0)
    return scans[scan].initial_pose;
  const ScanResult& before = scans[scan - 1];
  return extrapolateOdometry(
      before.T_world_scan, before.initial_pose, scans[scan].initial_pose);
}

/** \return the pose of a scan by the motion between the two previous scans, for scans without
 * initial poses; nothing unless both are registered */
std::optional<Eigen::Isometry3d>
carriedOn(const std::vector<ScanResult>& scans, std::size_t i)
{
  if (i < 2 || !isRegistered(scans[i - 1]) || !isRegistered(scans[i - 2]) ||
      !scans[i].initial_pose.isApprox(scans[i - 1].initial_pose, 1e-12))
    return std::nullopt;
  const Eigen::Isometry3d& last = scans[i - 1].T_world_scan;
  return last * (scans[i - 2].T_world_scan.inverse() * last);
}

SequenceMatcher::SequenceMatcher(const Slam6DOptions& options,
                                 const Slam6DParameters& parameters,
                                 const KeptScans& scans,
                                 Recovery& recovery)
: options_(options), scans_(scans), recovery_(recovery), matcher_(options, parameters)
{}

void
SequenceMatcher::match(std::size_t i, std::vector<ScanResult>& scans)
{
  matchOrRecover(i, scans);
  if (isFixedByStep(i, scans))
    scans[i].state = ScanState::kMatched;
}

/** \return whether the match leaves a direction open that the measured step from the scan before
 * fixes */
bool
SequenceMatcher::isFixedByStep(std::size_t i,
                               const std::vector<ScanResult>& scans) const
{
  const ScanResult& scan = scans[i];
  return i > 0 && scans_.isStepMeasured(i) && isRegistered(scans[i - 1]) &&
         scan.state == ScanState::kUnconverged &&
         scan.status == Status::kRankDeficient && scan.recovered == RecoveredBy::kNone;
}

void
SequenceMatcher::matchOrRecover(std::size_t i, std::vector<ScanResult>& scans)
{
  ScanResult& scan = scans[i];
  scan.T_world_scan = predictedPose(scans, i);
  if (i == 0)
    return matcher_.fix(scans_.reduced()[i], scans_.measured()[i], scan);
  const Eigen::Isometry3d odometry =
      scans[i - 1].initial_pose.inverse() * scan.initial_pose;
  const ScanResult predicted = scan;
  matcher_.setHoldsOpenDirections(hasGivenPoses(scans));
  RejectedMatch rejected;
  const auto verify = [&](const ScanResult& found) {
    Rejection rejection;
    if (isDoubtful(found, i, scans))
      rejection = recovery_.rejectionOf(
          i, found.T_world_scan, scans, neededBy(found, i, scans));
    rejected.is_unconfirmed = static_cast<bool>(rejection);
    rejected.is_contradicted =
        rejection && rejection.reason != RejectReason::kNoConsistentLink;
    rejected.is_expected = isExpected(found, i, scans);
    return rejection;
  };
  const auto carried = options_.order_first ? carriedOn(scans, i) : std::nullopt;
  if (carried) {
    scan.T_world_scan = *carried;
    matcher_.match(scans_.reduced()[i], scans_.measured()[i], odometry, scan, verify);
    if (isRegistered(scan)) {
      if (!matcher_.isSmallCorrection(scan, *carried))
        scan.start = InitialGuess::kGlobal;
      return;
    }
    scan = predicted;
    matcher_.passOver(scans_.measured()[i - 1], scans[i - 1].T_world_scan);
  }
  matcher_.match(scans_.reduced()[i], scans_.measured()[i], odometry, scan, verify);
  if (options_.order_first) // the pose may be ambiguous
    scan.start = InitialGuess::kGlobal;
  if (!isRecovering(options_) || isRegistered(scan))
    return;
  if (rejected.is_unconfirmed) // rays decide nothing else
    rejected.rays = recovery_.testRays(i, scans);
  lookFor(i, isLongSearchUseful(rejected, options_.recovery), scans);
  // Where rays cannot test, a match without a better alternative is kept: the verdict on the whole
  // map decides.
  if (isRegistered(scan) || !rejected.is_unconfirmed || !isRegistered(scans[i - 1]) ||
      rejected.rays == RayTest::kConfirming)
    return;
  scan = predicted;
  matcher_.passOver(scans_.measured()[i - 1], scans[i - 1].T_world_scan);
  matcher_.match(scans_.reduced()[i], scans_.measured()[i], odometry, scan);
}

void
SequenceMatcher::takeIn(std::size_t i, const std::vector<ScanResult>& scans)
{
  matcher_.takeIn(scans_.reduced()[i], scans_.measured()[i], scans[i]);
}

KnownPlaces
SequenceMatcher::recover(const ProgressCallback& report, Slam6DResult& result)
{
  return RecoveryStage(options_, scans_, recovery_, matcher_).run(report, result);
}

/** \return whether a match stays, by less than its pair distance, where the sweeps in between were
 * tracked: whatever moves around the scanner, it is at no other place */
bool
SequenceMatcher::isWhereTracked(const ScanResult& found,
                                std::size_t i,
                                const std::vector<ScanResult>& scans) const
{
  return scans_.isStepMeasured(i) && isRegistered(scans[i - 1]) &&
         matcher_.isWithinPairDistance(found, predictedPose(scans, i));
}

/** \return whether a match needs confirmation by points and rays: the previous scan was lost, the
 * odometry was far off, or a quick check raises doubts */
bool
SequenceMatcher::isDoubtful(const ScanResult& found,
                            std::size_t i,
                            const std::vector<ScanResult>& scans)
{
  return isRecovering(options_) && !isWhereTracked(found, i, scans) &&
         (!isRegistered(scans[i - 1]) ||
          !matcher_.isSmallCorrection(found, predictedPose(scans, i)) ||
          recovery_.seemsContradicted(i, found.T_world_scan, scans));
}

/** \return what the place of a match needs. Where surfaces leave a motion open, no link can confirm
 * it */
PlaceNeeds
SequenceMatcher::neededBy(const ScanResult& found,
                          std::size_t i,
                          const std::vector<ScanResult>& scans) const
{
  if (found.status == Status::kRankDeficient)
    return PlaceNeeds::kNoContradiction;
  return isExpected(found, i, scans) ? PlaceNeeds::kConfirmedAsExpected
                                     : PlaceNeeds::kConfirmed;
}

/** \return whether a match agrees with the odometry from the previous scan. Isolated objects that
 * contradict such a match are dynamic, rather than evidence of a wrong pose */
bool
SequenceMatcher::isExpected(const ScanResult& found,
                            std::size_t i,
                            const std::vector<ScanResult>& scans) const
{
  const Eigen::Isometry3d odometry =
      scans[i - 1].initial_pose.inverse() * scans[i].initial_pose;
  return isRegistered(scans[i - 1]) &&
         !odometry.isApprox(Eigen::Isometry3d::Identity(), 1e-12) &&
         matcher_.isSmallCorrection(found, predictedPose(scans, i));
}

/** Recovers a scan without a match at its prediction.
 * \param[in] is_long false: only where the odometry and the motion before lead */
void
SequenceMatcher::lookFor(std::size_t i, bool is_long, std::vector<ScanResult>& scans)
{
  const auto found =
      is_long ? recovery_.find(i, scans) : recovery_.findByMotion(i, scans);
  if (!found)
    return;
  ScanResult scan = scans[i];
  const Eigen::Vector3d predicted = scan.T_world_scan.translation();
  scan.T_world_scan = found->T_world_scan;
  matcher_.matchFound(scans_.reduced()[i], scans_.measured()[i], scan);
  if (!isRegistered(scan))
    return matcher_.passOver(scans_.measured()[i], scans[i].T_world_scan);
  scan.correction = (scan.T_world_scan.translation() - predicted).norm();
  scan.recovered = found->by;
  scans[i] = scan;
}

} // namespace pcl6d::slam6d
