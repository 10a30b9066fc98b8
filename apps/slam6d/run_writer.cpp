// SPDX-License-Identifier: BSD-3-Clause
#include "common/plane_files.h"
#include "slam6d/run_writer.h"
#include "slam6d/verdict.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/visualization/report.h>

#include <algorithm>
#include <sys/resource.h>

namespace pcl6d::app {

namespace {
constexpr const char* kProgram = "pcl_slam6d";

FrameKind
kindOf(ScanState state)
{
  switch (state) {
  case ScanState::kMatched:
  case ScanState::kUnconverged:
    return FrameKind::kIcp;
  case ScanState::kFixed:
    return FrameKind::kInactive;
  case ScanState::kPredicted:
  case ScanState::kPending:
    break;
  }
  return FrameKind::kInvalid;
}

RunResult::ScanEntry
entryOf(const std::string& file, int index, const ScanResult& scan)
{
  RunResult::ScanEntry entry;
  entry.file = file;
  entry.index = index;
  entry.initial_pose = scan.initial_pose;
  entry.T_world_scan = scan.T_world_scan;
  entry.covariance = scan.covariance;
  entry.state = toString(scan.state);
  entry.status = toString(scan.status);
  entry.start = toString(scan.start);
  entry.points = scan.points;
  entry.reduced = scan.reduced;
  entry.pairs = scan.pairs;
  entry.rms = scan.rms;
  entry.overlap = scan.overlap;
  entry.iterations = scan.iterations;
  entry.correction = scan.correction;
  entry.reason = scan.reason;
  return entry;
}

std::vector<RunResult::Option>
optionsOf(const Settings& settings, const Slam6DParameters& parameters)
{
  std::vector<RunResult::Option> options;
  for (const auto& word : settings.words)
    options.push_back({word.name, word.value, word.given ? "given" : "default", ""});
  for (const auto& [name, parameter] : named(parameters)) {
    options.push_back({name,
                       text::shortest(parameter.value),
                       parameter.given ? "given" : "derived",
                       parameter.why});
  }
  return options;
}
} // namespace

StageTimer::StageTimer(const std::string& name, std::vector<RunResult::Stage>& stages)
: name_(name), stages_(stages), start_(std::chrono::steady_clock::now())
{}

StageTimer::~StageTimer()
{
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  stages_.push_back({name_, spent.count(), usage.ru_maxrss / 1024.0});
}

OutputRules
runFolderRules(const Settings& settings)
{
  OutputRules rules;
  rules.folder = settings.out;
  rules.inputs = {settings.input, settings.folder.poses_file};
  rules.program = kProgram;
  rules.marker = "summary.json";
  rules.files = std::regex("trajectory\\.(kitti|tum)|frames/scan[0-9]+\\.frames|"
                           "scans/scan[0-9]+\\.pcd|map\\.pcd|graph\\.g2o|links\\.csv|"
                           "(summary|objects|semantic_map)\\.json|"
                           "semantic_map\\.(pcd|ply)|"
                           "top_view\\.png|report\\.html|pictures/[a-z-]+\\.png|" +
                           planeFilePattern());
  rules.force = settings.force;
  return rules;
}

RunWriter::RunWriter(const Settings& settings,
                     const RunScans& scans,
                     const Slam6DResult& result,
                     const OutputFolder& out,
                     ProgressBar& bar,
                     const Interrupt& interrupt)
: settings_(settings)
, scans_(scans)
, folder_(scans.folder())
, result_(result)
, out_(out)
, bar_(bar)
, interrupt_(interrupt)
{}

const RunResult&
RunWriter::write(bool complete, const RunLog& log)
{
  describe(complete, log);
  writeTrajectoryKitti(out_ / "trajectory.kitti", trajectory());
  writeTrajectoryTum(out_ / "trajectory.tum", trajectory());
  writeHistory();
  if (complete) {
    if (!result_.stages.empty())
      writeGraph();
    const double voxel = result_.parameters.voxel.value;
    MapBuilder map(voxel, summary_.world_offset);
    MapBuilder fine_map(planeVoxel(voxel), summary_.world_offset);
    summary_.complete = writeScansAndMap(map, settings_.planes ? &fine_map : nullptr);
    if (summary_.complete)
      drawTopView(map);
    if (summary_.complete && settings_.planes)
      writePlanesOf(fine_map);
    summary_.map_points = summary_.complete ? map.points().size() : 0;
  }
  summary_.trusted = summary_.complete && result_.trusted();
  summary_.verdict = verdictOf(result_, summary_);
  writeRunSummary(out_ / "summary.json", summary_);
  if (settings_.report)
    writeReportOf(out_ / "report.html");
  return summary_;
}

/** From the files that were written beside it. */
void
RunWriter::writeReportOf(const std::filesystem::path& path) const
{
  const std::string title =
      std::filesystem::absolute(settings_.out / std::filesystem::path("."))
          .lexically_normal()
          .parent_path()
          .filename()
          .string();
  writeReport(path, gatherReport(RunFolder(path.parent_path()), title));
}

Trajectory
RunWriter::trajectory() const
{
  Trajectory trajectory;
  for (std::size_t i = 0; i < folder_.size(); ++i) {
    trajectory.poses.push_back(result_.scans[i].T_world_scan);
    trajectory.stamps.push_back(folder_.stamps().empty() ? folder_.index(i)
                                                         : folder_.stamps()[i]);
  }
  return trajectory;
}

void
RunWriter::writeHistory() const
{
  for (std::size_t i = 0; i < folder_.size(); ++i) {
    const ScanResult& scan = result_.scans[i];
    std::vector<Frame> frames = {
        {scan.initial_pose, FrameKind::kInvalid},
        {result_.stages.empty() ? scan.T_world_scan : scan.matched_pose,
         kindOf(scan.state)}};
    for (const StageResult& stage : result_.stages)
      if (stage.name != "matching")
        for (const auto& poses : stage.history)
          frames.push_back(
              {poses[i],
               stage.name == "relaxation" ? FrameKind::kLum : FrameKind::kElch});
    writeFrames(out_ / ("frames/" + scanName(folder_.index(i)) + ".frames"), frames);
  }
}

void
RunWriter::describe(bool complete, const RunLog& log)
{
  summary_.generator = kProgram;
  summary_.version = PCL6D_VERSION;
  summary_.pose_source = folder_.poseSource();
  summary_.world_offset = worldOffset(result_.scans.front().T_world_scan);
  summary_.options = optionsOf(settings_, result_.parameters);
  summary_.stages = log.stages;
  for (std::size_t i = 0; i < folder_.size(); ++i) {
    summary_.scans.push_back(
        entryOf(folder_.name(i), folder_.index(i), result_.scans[i]));
    summary_.scans.back().dropped = log.dropped[i];
  }
  describeGraph();
  summary_.complete = complete;
  if (!folder_.hasPoses() && folder_.size() > 1)
    summary_.warnings.push_back(
        settings_.slam.initial_guess == InitialGuess::kFeatures
            ? "no initial poses were found: scans were placed by features alone"
            : "no initial poses were found: each scan starts where the one before is, "
              "which only fits scans taken close together; give poses with --poses or "
              "odometry.txt");
  if (!settings_.without_effect.empty())
    summary_.warnings.push_back(settings_.without_effect);
  if (settings_.slam.initial_guess == InitialGuess::kOverlap)
    warnOfOdometry();
}

/** Tells of scans that the overlap search was asked for, and found no clear place. */
void
RunWriter::warnOfOdometry()
{
  std::string names;
  std::size_t count = 0;
  for (std::size_t i = 1; i < folder_.size(); ++i) {
    const ScanResult& scan = result_.scans[i];
    if (scan.start != InitialGuess::kOdometry || scan.state == ScanState::kPending ||
        scan.state == ScanState::kPredicted)
      continue;
    if (++count <= 5)
      names += (names.empty() ? "" : ", ") + folder_.name(i);
  }
  if (count > 0)
    summary_.warnings.push_back("the overlap search was not sure of " +
                                std::to_string(count) +
                                " scans, which started from the odometry: " + names +
                                (count > 5 ? ", ..." : ""));
}

} // namespace pcl6d::app
