// SPDX-License-Identifier: BSD-3-Clause
#include "recovery_stage.h"
#include "registered.h"
#include "sequence_matcher.h"

#include <pcl6d/common/pose.h>

#include <string>

namespace pcl6d::slam6d {

bool
isRecovering(const Slam6DOptions& options)
{
  return options.recover && (options.initial_guess == InitialGuess::kOdometry ||
                             options.initial_guess == InitialGuess::kOverlap);
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

SequenceMatcher::SequenceMatcher(const Slam6DOptions& options,
                                 const Slam6DParameters& parameters,
                                 const KeptScans& scans,
                                 Recovery& recovery)
: options_(options), scans_(scans), recovery_(recovery), matcher_(options, parameters)
{}

void
SequenceMatcher::match(std::size_t i, std::vector<ScanResult>& scans)
{
  ScanResult& scan = scans[i];
  scan.T_world_scan = predictedPose(scans, i);
  if (i == 0)
    return matcher_.fix(scans_.reduced()[i], scans_.measured()[i], scan);
  const Eigen::Isometry3d odometry =
      scans[i - 1].initial_pose.inverse() * scan.initial_pose;
  const ScanResult predicted = scan;
  bool is_vetoed = false;
  const auto judge = [&](const ScanResult& found) {
    const std::string objection =
        isDoubtful(found, i, scans)
            ? recovery_.objection(i,
                                  found.T_world_scan,
                                  scans,
                                  isExpected(found, i, scans)
                                      ? PlaceNeeds::kToBeHeldAsExpected
                                      : PlaceNeeds::kToBeHeld)
            : "";
    is_vetoed = !objection.empty();
    return objection;
  };
  matcher_.match(scans_.reduced()[i], scans_.measured()[i], odometry, scan, judge);
  if (!isRecovering(options_) || isRegistered(scan))
    return;
  lookFor(i, scans);
  // Without a better place the match stands where rays are no judges: the verdict on the whole
  // map tells what is to be thought of it.
  if (isRegistered(scan) || !is_vetoed || !isRegistered(scans[i - 1]) ||
      recovery_.raysJudge(i, scans))
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

void
SequenceMatcher::recover(const ProgressCallback& report, Slam6DResult& result)
{
  RecoveryStage(options_, scans_, recovery_, matcher_).run(report, result);
}

/** \return whether points and rays have to confirm a match: where the scan before was lost,
 * the odometry was far off, or a look at it raises doubts */
bool
SequenceMatcher::isDoubtful(const ScanResult& found,
                            std::size_t i,
                            const std::vector<ScanResult>& scans)
{
  return isRecovering(options_) &&
         (!isRegistered(scans[i - 1]) ||
          !matcher_.isSmallCorrection(found, predictedPose(scans, i)) ||
          recovery_.seemsContradicted(i, found.T_world_scan, scans));
}

/** \return whether a match is where odometry leads from the scan before: what is contradicted
 * there by things that stand alone are things that moved, rather than another place */
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

/** A scan that could not be matched where it was predicted. */
void
SequenceMatcher::lookFor(std::size_t i, std::vector<ScanResult>& scans)
{
  const auto found = recovery_.find(i, scans);
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
