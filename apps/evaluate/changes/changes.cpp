// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/changes/changes_report.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/median.h>
#include <pcl6d/global_registration/vertical.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
/** Thrown to leave an interrupted comparison. */
struct ComparisonStopped {};

/** \return the up direction in the world, from the surfaces of a run; expected is the
 * mean up direction of its scanners */
Eigen::Vector3d
upOf(const ComparedRun& run)
{
  constexpr std::size_t kNormals = 6000; // enough for the normals of a scan
  std::size_t count = 0;
  Eigen::Vector3d expected = Eigen::Vector3d::Zero();
  for (const ComparedScan& scan : run) {
    count += scan.normals->size();
    expected += scan.T_world_scan.linear().col(2);
  }
  // the scanners' up directions cancel out
  if (expected.norm() < 0.1 * static_cast<double>(run.size()))
    expected = Eigen::Vector3d::UnitZ();
  const std::size_t stride = std::max<std::size_t>(1, count / kNormals);
  Normals normals;
  std::size_t next = 0, passed = 0;
  for (const ComparedScan& scan : run) {
    const Eigen::Matrix3f R = scan.T_world_scan.linear().cast<float>();
    for (; next < passed + scan.normals->size(); next += stride)
      normals.emplace_back(R * (*scan.normals)[next - passed]);
    passed += scan.normals->size();
  }
  return estimateVertical(normals, expected.normalized()).up;
}

double
usualNoise(const ComparedRuns& runs)
{
  std::vector<double> noises;
  for (std::size_t run = 0; run < 2; ++run)
    for (std::size_t i = 0; i < runs.size(run); ++i)
      noises.push_back(runs.scan(run, i).noise());
  return upperMedian(std::move(noises));
}

int
compare(const ChangesSettings& s, FolderJob& job)
{
  const auto show = [&](const Progress& now) {
    job.bar.show(now);
    if (job.interrupt.requested())
      throw ComparisonStopped();
  };
  const ComparedRuns runs(s, show);
  for (const std::string& note : runs.notes())
    job.bar.warn(note);
  const CommonWorld world = commonWorld(s, runs, show);
  RunChanges found;
  if (world.doubt.empty()) {
    RunChangesOptions options;
    options.voxel = runs.voxel();
    options.noise = usualNoise(runs);
    options.least_size = s.least_size;
    options.min_confidence = s.min_confidence;
    options.up = upOf(world.a);
    options.num_threads = s.num_threads;
    options.progress = show;
    found = findChanges(world.a, world.b, options);
  }
  const ChangesReport report{s, runs, world, found};
  printChanges(report);
  flushOutput();
  if (!world.doubt.empty()) {
    job.bar.warn(s.run_b + ": the pose in " + s.run_a + " is doubtful: " + world.doubt +
                 "; no changes are reported, nothing is written");
    return kDoubtful;
  }
  if (!s.json.empty())
    writeChangesJson(s.json, report);
  return !job.out || publishChanges(job, report) ? kDone : kDoubtful;
}
} // namespace

int
runChanges(const std::vector<std::string>& arguments)
{
  ChangesSettings s;
  if (!parseChangesSettings(arguments, s))
    return kDone;
  FolderJob job(s.quiet, s.without_effect, changesFolderRules(s));
  try {
    return compare(s, job);
  } catch (const ComparisonStopped&) {
    job.bar.warn("interrupted; nothing is written");
    return kInterrupted;
  }
}

} // namespace pcl6d::app
