// SPDX-License-Identifier: BSD-3-Clause
#include "motion/motion_stage.h"
#include "registered.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/deskew/motion_relaxation.h>

#include <algorithm>
#include <chrono>

namespace pcl6d::slam6d {

using deskew::changeOf;
using deskew::fitOf;
using deskew::halfOf;
using deskew::pooled;

namespace {
/** Distance of matched scans in voxels, see agreementDistance(). */
constexpr double kHoldOfVoxel = 0.4;

/** Moves the knots to the pose from the relaxation of rigid scans. */
Trajectory
placed(const TrackedScan& scan, const Eigen::Isometry3d& T_world_scan)
{
  Trajectory knots = scan.knots;
  const Eigen::Isometry3d T_world_tracked = T_world_scan * scan.pose().inverse();
  for (Eigen::Isometry3d& pose : knots.poses) {
    pose = T_world_tracked * pose;
    pose.linear() = nearestRotation(pose.linear());
  }
  return knots;
}

/** Frees a rigid scan between two moving scans: its motion is interpolated. */
void
freeBetween(std::vector<MotionScan>& scans)
{
  for (std::size_t i = 1; i + 1 < scans.size(); ++i) {
    const Trajectory &before = scans[i - 1].knots, &after = scans[i + 1].knots;
    Trajectory& knots = scans[i].knots;
    const double gap =
        after.stamps.front() - before.stamps.back() -
        (knots.stamps.back() - knots.stamps.front()); // of time without a scan
    if (!scans[i].is_rigid || scans[i - 1].is_rigid || scans[i + 1].is_rigid ||
        knots.stamps.front() < before.stamps.back() ||
        gap > knots.stamps.back() - knots.stamps.front() || gap < 0)
      continue;
    Trajectory path;
    path.poses = {before.poses.back(), after.poses.front()};
    path.stamps = {before.stamps.back(), after.stamps.front()};
    const MotionCorrection between(path);
    for (std::size_t k = 0; k < knots.poses.size(); ++k)
      knots.poses[k] = between.poseAt(knots.stamps[k]);
    scans[i].is_rigid = false;
  }
}

/** \return the fit of each scan's second half of points to the map of all first halves */
std::vector<std::vector<double>>
fitsOf(const std::vector<MotionScan>& scans,
       const std::vector<TimedPoints>& test_halves,
       const MotionRelaxationOptions& options)
{
  SurfaceMap map(options.map);
  for (const MotionScan& scan : scans)
    map.add(worldPoints(scan.sample, scan.knots, options.num_threads));
  std::vector<std::vector<double>> fits;
  for (std::size_t i = 0; i < scans.size(); ++i)
    fits.push_back(
        fitOf(map,
              worldPoints(test_halves[i], scans[i].knots, options.num_threads),
              options.noise,
              options.num_threads));
  return fits;
}

/** The points of a scan, deskewed with a new motion.
 * \param[in] points deskewed with the previous motion */
Points
undoneAnew(const Points& points, const TrackedScan& before, const TrackedScan& now)
{
  const Points sample = undoMotion(before.sample, before.knots, before.stamp, 1);
  const PointTree tree(sample, 1);
  const MotionCorrection path_before(before.knots), path_now(now.knots);
  const Eigen::Isometry3d pose = before.pose(), T_scan_world = now.pose().inverse();
  Points anew = points;
  for (Eigen::Vector3f& p : anew) {
    const Neighbour nearest = tree.nearest(p, INFINITY); // measured at about the same
                                                         // time
    if (nearest.index < 0)
      continue;
    const double time = before.sample.times[static_cast<std::size_t>(nearest.index)];
    const Eigen::Vector3d measured =
        path_before.poseAt(time).inverse() * (pose * p.cast<double>());
    p = (T_scan_world * (path_now.poseAt(time) * measured)).cast<float>();
  }
  return anew;
}
} // namespace

/** \return the indices of the known scans that are registered, hence take part */
std::vector<std::size_t>
MotionStage::placedScans(const Slam6DResult& result) const
{
  std::vector<std::size_t> members;
  for (std::size_t k = 0; k < known_.size(); ++k)
    if (isRegistered(result.scans[known_[k].place]))
      members.push_back(k);
  return members;
}

MotionRelaxationOptions
MotionStage::relaxationOptions() const
{
  MotionRelaxationOptions relaxation;
  relaxation.map = tracker_->mapOptions();
  relaxation.noise = tracker_->noise();
  relaxation.motion = tracker_->motionNoise();
  relaxation.hold_translation = kHoldOfVoxel * voxel_;
  relaxation.hold_rotation =
      relaxation.hold_translation / std::max(tracker_->reach(), voxel_);
  relaxation.num_threads = options_.num_threads;
  return relaxation;
}

void
MotionStage::relax(const ScanMatcher& matcher, KeptScans& scans, Slam6DResult& result)
{
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::size_t> members = placedScans(result);
  if (members.size() < 2 || !anyMoved())
    return;
  std::vector<MotionScan> moving;
  std::vector<TimedPoints> test_halves;
  for (const std::size_t k : members) {
    const TrackedScan& tracked = known_[k].tracked;
    MotionScan scan;
    scan.sample = halfOf(tracked.sample, 0);
    scan.knots = placed(tracked, result.scans[known_[k].place].T_world_scan);
    scan.is_rigid = !tracked.is_moved;
    moving.push_back(std::move(scan));
    test_halves.push_back(halfOf(tracked.sample, 1));
  }
  freeBetween(moving);
  const MotionRelaxationOptions options = relaxationOptions();
  const auto before = fitsOf(moving, test_halves, options);
  const MotionRelaxationResult relaxed = relaxMotions(moving, options);
  for (std::size_t i = 0; i < moving.size(); ++i)
    moving[i].knots = relaxed.knots[i];
  const StageAgreement agreement =
      agreementOf(before, fitsOf(moving, test_halves, options), test_halves);
  StageResult stage;
  stage.kind = StageKind::kMotion;
  stage.agreement_before = agreement.total.before;
  stage.agreement_after = agreement.total.after;
  stage.rounds = relaxed.rounds;
  stage.rejection = whyNot(relaxed, agreement, members);
  stage.reverted = static_cast<bool>(stage.rejection);
  if (!stage.reverted) {
    takeOver(members, moving, matcher, scans, result);
    for (const ScanResult& scan : result.scans)
      stage.history.resize(1), stage.history[0].push_back(scan.T_world_scan);
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  stage.seconds = spent.count();
  result.stages.push_back(std::move(stage));
}

StageAgreement
MotionStage::agreementOf(const std::vector<std::vector<double>>& before,
                         const std::vector<std::vector<double>>& after,
                         const std::vector<TimedPoints>& test_halves) const
{
  StageAgreement agreement;
  for (std::size_t i = 0; i < test_halves.size(); ++i)
    agreement.scans.push_back(
        changeOf(before[i], after[i], test_halves[i].points, agreementCube(voxel_)));
  agreement.total = pooled(agreement.scans);
  return agreement;
}

Rejection
MotionStage::whyNot(const MotionRelaxationResult& relaxed,
                    const StageAgreement& agreement,
                    const std::vector<std::size_t>& members) const
{
  if (relaxed.status != Status::kOk && relaxed.status != Status::kMaxIterations)
    return {RejectReason::kNoSolution, relaxed.status};
  for (std::size_t i = 0; i < members.size(); ++i)
    if (agreement.scans[i].isLoss(kSureDeviations)) {
      Rejection lost(RejectReason::kScanAgreementLost,
                     agreement.scans[i].after,
                     agreement.scans[i].before);
      lost.text = std::to_string(known_[members[i]].place);
      return lost;
    }
  if (!agreement.total.isGain())
    return {RejectReason::kNoClearGain, agreement.total.after, agreement.total.before};
  return {};
}

/** Takes over poses and motions; the first scan stays. */
void
MotionStage::takeOver(const std::vector<std::size_t>& members,
                      const std::vector<MotionScan>& moving,
                      const ScanMatcher& matcher,
                      KeptScans& scans,
                      Slam6DResult& result)
{
  std::optional<Eigen::Isometry3d> T_world_relaxed;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const bool is_moved = !moving[i].is_rigid;
    Known& known = known_[members[i]];
    ScanResult& scan = result.scans[known.place];
    const TrackedScan before = known.tracked;
    known.tracked.knots = moving[i].knots;
    known.tracked.is_moved = is_moved;
    if (is_moved)
      known.tracked.rejection = {};
    else // to the last bit
      for (Eigen::Isometry3d& pose : known.tracked.knots.poses)
        pose = known.tracked.knots.poses.front();
    if (!T_world_relaxed)
      T_world_relaxed = scan.T_world_scan * known.tracked.pose().inverse();
    if (i > 0) {
      scan.T_world_scan = *T_world_relaxed * known.tracked.pose();
      scan.T_world_scan.linear() = nearestRotation(scan.T_world_scan.linear());
    }
    if (is_moved)
      scans.replace(known.place,
                    matcher.prepare(undoneAnew(
                        scans.reduced()[known.place].points(), before, known.tracked)));
  }
  for (std::size_t i = 0; i < result.graph.poses.size(); ++i)
    result.graph.poses[i] = result.scans[i].T_world_scan;
}

} // namespace pcl6d::slam6d
