// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/map_writer.h"
#include "slam6d/run_writer.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/trajectory_io.h>

#include <sstream>
#include <sys/resource.h>

namespace fs = std::filesystem;

namespace pcl6d::app {

namespace {
/** Everything that a run may leave behind. */
const std::vector<std::string> kRunFiles = {"trajectory.kitti",
                                            "trajectory.tum",
                                            "frames",
                                            "scans",
                                            "map.pcd",
                                            "graph.g2o",
                                            "links.csv",
                                            "summary.json",
                                            "planes.json",
                                            "objects.json",
                                            "semantic_map.json",
                                            "top_view.png",
                                            "report.html"};

Trajectory
trajectoryOf(const ScanFolder& folder, const Slam6DResult& result)
{
  Trajectory trajectory;
  for (std::size_t i = 0; i < folder.size(); ++i) {
    trajectory.poses.push_back(result.scans[i].T_world_scan);
    trajectory.stamps.push_back(folder.stamps().empty() ? folder.index(i)
                                                        : folder.stamps()[i]);
  }
  return trajectory;
}

void
writeHistory(const ScanFolder& folder,
             const Slam6DResult& result,
             const OutputFolder& out)
{
  fs::create_directories(out / "frames");
  for (std::size_t i = 0; i < folder.size(); ++i) {
    const ScanResult& scan = result.scans[i];
    const FrameKind kind =
        scan.state == ScanState::kPending ? FrameKind::kInvalid : FrameKind::kIcp;
    writeFrames(out / "frames" / (scanName(folder, i) + ".frames"),
                {{scan.initial_pose, FrameKind::kInvalid}, {scan.T_world_scan, kind}});
  }
}

RunSummary::ScanEntry
entryOf(const std::string& file, const ScanResult& scan, std::size_t dropped)
{
  RunSummary::ScanEntry entry;
  entry.file = file;
  entry.T_world_scan = scan.T_world_scan;
  entry.covariance = scan.covariance;
  entry.state = toString(scan.state);
  entry.status = toString(scan.status);
  entry.points = scan.points;
  entry.dropped = dropped;
  entry.reduced = scan.reduced;
  entry.pairs = scan.pairs;
  entry.rms = scan.rms;
  entry.overlap = scan.overlap;
  entry.iterations = scan.iterations;
  return entry;
}

/** \return ": a.pcd, b.pcd and 3 more" for the scans in a state */
std::string
filesIn(const std::string& state, const RunSummary& summary)
{
  constexpr int kMost = 8;
  std::string text;
  int count = 0;
  for (const auto& scan : summary.scans)
    if (scan.state == state && ++count <= kMost)
      text += (count == 1 ? ": " : ", ") + scan.file;
  return count > kMost ? text + " and " + std::to_string(count - kMost) + " more"
                       : text;
}

std::string
verdictOf(const Slam6DResult& result, const RunSummary& summary)
{
  const std::string all = std::to_string(result.scans.size());
  std::ostringstream text;
  if (!summary.complete)
    text << "PARTIAL: interrupted; " << result.count(ScanState::kPending) << " of "
         << all << " scans are not registered and have predicted poses";
  else if (result.trusted())
    text << "all " << all << " scans registered, every match converged";
  else
    text << result.count(ScanState::kMatched) + 1 << " of " << all
         << " scans registered";
  if (const auto failed = result.count(ScanState::kPredicted))
    text << "\nNOT TO BE TRUSTED: " << failed
         << " scans could not be matched and keep their predicted pose"
         << filesIn("predicted", summary);
  if (const auto limit = result.count(ScanState::kUnconverged))
    text << "\nNOT TO BE TRUSTED: the match of " << limit
         << " scans did not converge (see --iterations)"
         << filesIn("unconverged", summary);
  return text.str();
}

void
describeOptions(const Settings& settings,
                const Slam6DParameters& parameters,
                RunSummary& summary)
{
  for (const auto& word : settings.words)
    summary.options.push_back(
        {word.name, word.value, word.given ? "given" : "default", ""});
  for (const auto& [name, parameter] : named(parameters)) {
    std::ostringstream value;
    value << parameter.value;
    summary.options.push_back(
        {name, value.str(), parameter.given ? "given" : "derived", parameter.why});
  }
}

void
completeSummary(const Settings& settings,
                const ScanFolder& folder,
                const Slam6DResult& result,
                bool complete,
                Run& run)
{
  RunSummary& summary = run.summary;
  summary.version = PCL6D_VERSION;
  summary.pose_source = folder.poseSource();
  summary.world_offset = worldOffset(result.scans.front().T_world_scan);
  describeOptions(settings, result.parameters, summary);
  for (std::size_t i = 0; i < folder.size(); ++i)
    summary.scans.push_back(
        entryOf(folder.file(i).filename().string(), result.scans[i], run.dropped[i]));
  summary.complete = complete;
  summary.trusted = complete && result.trusted();
  summary.verdict = verdictOf(result, summary);
}
} // namespace

StageTimer::StageTimer(const std::string& name, Run& run)
: name_(name), run_(run), start_(std::chrono::steady_clock::now())
{}

StageTimer::~StageTimer()
{
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  run_.summary.stages.push_back({name_, spent.count(), usage.ru_maxrss / 1024.0});
}

void
writeRun(const Settings& settings,
         const ScanFolder& folder,
         const Slam6DResult& result,
         bool complete,
         ProgressBar& bar,
         const OutputFolder& out,
         Run& run)
{
  out.removeOld(kRunFiles);
  completeSummary(settings, folder, result, complete, run);
  const Trajectory trajectory = trajectoryOf(folder, result);
  writeTrajectoryKitti(out / "trajectory.kitti", trajectory);
  writeTrajectoryTum(out / "trajectory.tum", trajectory);
  writeHistory(folder, result, out);
  if (complete) {
    const MapBuilder map = writeScansAndMap(settings, folder, result, bar, out, run);
    run.summary.map_points = map.points().size();
    drawTopView(map, folder, result, bar, out, run);
  }
  writeRunSummary(out / "summary.json", run.summary);
}

std::string
closingText(const RunSummary& summary, const OutputFolder& out)
{
  std::ostringstream text;
  text << summary.verdict << '\n';
  for (const auto& name : kRunFiles)
    if (fs::exists(out / name))
      text << "  " << (out / name).string() << '\n';
  return text.str();
}

} // namespace pcl6d::app
