// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/output/folder_job.h"
#include "evaluate/icp/icp_report.h"
#include "evaluate/pair_pose.h"
#include "evaluate/pair_scan.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>

#include <algorithm>
#include <cstdio>
#include <iostream>

namespace pcl6d::app {

namespace {
/** Options of the runs, with automatic values derived from the scans. */
IcpBasinOptions
basinOptions(const IcpSettings& s, const Slam6DParameters& p, const Points& points)
{
  constexpr double kSigmaShare = 0.1;  // of the voxel
  constexpr double kOffsetShare = 1.5; // of the first pair distance
  IcpBasinOptions o = s.basin;
  const double first_distance =
      std::max(p.max_distance_start.value, p.max_distance.value);
  const double range = medianRange(points);
  o.offset_xy = s.offset_xy.value_or(kOffsetShare * first_distance);
  o.offset_yaw = s.offset_yaw.value_or(std::min(first_distance / range, M_PI));
  o.min_sigma_position = kSigmaShare * p.voxel.value;
  o.min_sigma_orientation = o.min_sigma_position / range;
  o.icp.max_iterations = s.slam.max_iterations;
  o.icp.max_distance = p.max_distance.value;
  o.icp.max_distance_start = p.max_distance_start.value;
  o.icp.translation_epsilon = s.slam.translation_epsilon.value_or(1e-3 * p.voxel.value);
  o.icp.rotation_epsilon = s.slam.rotation_epsilon;
  return o;
}

IcpEvaluation
evaluate(const IcpSettings& s, ProgressBar& bar, const Interrupt& interrupt)
{
  const NearScan a = readNear(s.scan_a, s.format, bar);
  const NearScan b = readNear(s.scan_b, s.format, bar);
  const PairPose start = s.guess ? PairPose{*s.guess, "--guess", true}
                                 : poseOfPair(s.scan_a, s.scan_b, s.format, "--guess");
  IcpEvaluation e;
  e.pose_source = start.source;
  e.has_poses = start.found;
  e.guess = start.T_a_b;
  e.parameters = deriveParameters(s.slam, {a.points, b.points});
  const Points target = prepareScan(a.points, s.scan_a, e.parameters);
  const Points source = prepareScan(b.points, s.scan_b, e.parameters);
  e.points_a = target.size();
  e.points_b = source.size();
  e.options = basinOptions(s, e.parameters, source);
  e.basin = evaluateIcpBasin(target,
                             source,
                             nearPose(e.guess, a, b),
                             icpVariants(s.methods, s.combination),
                             e.options,
                             [&](const Progress& progress) {
                               bar.show(progress);
                               return !interrupt.requested();
                             });
  for (IcpBestPose& best : e.basin.best)
    best.result.T_target_source = farPose(best.result.T_target_source, a, b);
  for (IcpBasinRow& row : e.basin.rows)
    for (IcpBasinRun& run : row.runs)
      run.T_target_source = farPose(run.T_target_source, a, b);
  return e;
}

/** \return whether every best pose is reliable */
bool
warnOfDoubts(const IcpSettings& s, const IcpEvaluation& e, ProgressBar& bar)
{
  for (const IcpBestPose& best : e.basin.best)
    if (!best.doubt.empty())
      bar.warn(std::string("metric ") + toString(best.metric) + ": " + s.scan_b +
               " cannot be matched onto " + s.scan_a +
               " even from the unperturbed start: " + best.doubt);
  for (const IcpDisagreement& d : e.basin.disagreements) {
    char distance[64];
    std::snprintf(distance,
                  sizeof distance,
                  "%.3f m and %.2f deg",
                  d.distance.translation,
                  degrees(d.distance.rotation));
    bar.warn(std::string("the best poses of ") + toString(d.a) + " and " +
             toString(d.b) + " are " + distance +
             " apart, far more than sigma: at least one best pose is wrong, and so are "
             "the errors measured from this pose");
  }
  if (!e.has_poses)
    bar.warn("no poses were found: ICP starts from the identity; give --guess if B was "
             "not recorded near A");
  return e.basin.disagreements.empty() &&
         std::all_of(e.basin.best.begin(), e.basin.best.end(), [](const auto& best) {
           return best.doubt.empty();
         });
}
} // namespace

int
runIcp(const std::vector<std::string>& arguments)
{
  IcpSettings s;
  if (!parseIcpSettings(arguments, s))
    return kDone;
  FolderJob job(s.quiet, s.without_effect, icpFolderRules(s));
  const IcpEvaluation e = evaluate(s, job.bar, job.interrupt);
  printIcpTable(s, e);
  bool is_drawn = true;
  if (job.out) {
    writeIcpFiles(*job.out, s, e);
    job.publish();
    is_drawn = drawIcpBasins(job, s, e);
  }
  flushOutput();
  const bool trusted = warnOfDoubts(s, e, job.bar) && is_drawn;
  if (!e.basin.complete) {
    job.bar.warn("interrupted; the table holds the finished methods");
    return kInterrupted;
  }
  return trusted ? kDone : kDoubtful;
}

} // namespace pcl6d::app
