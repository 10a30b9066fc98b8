// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/run_writer.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/trajectory_io.h>

#include <cstdio>
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

std::vector<RunSummary::Option>
optionsOf(const Settings& settings, const Slam6DParameters& parameters)
{
  std::vector<RunSummary::Option> options;
  for (const auto& word : settings.words)
    options.push_back({word.name, word.value, word.given ? "given" : "default", ""});
  for (const auto& [name, parameter] : named(parameters)) {
    std::ostringstream value;
    value << parameter.value;
    options.push_back(
        {name, value.str(), parameter.given ? "given" : "derived", parameter.why});
  }
  return options;
}
} // namespace

StageTimer::StageTimer(const std::string& name, std::vector<RunSummary::Stage>& stages)
: name_(name), stages_(stages), start_(std::chrono::steady_clock::now())
{}

StageTimer::~StageTimer()
{
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  stages_.push_back({name_, spent.count(), usage.ru_maxrss / 1024.0});
}

RunWriter::RunWriter(const Settings& settings,
                     const ScanFolder& folder,
                     const Slam6DResult& result,
                     const OutputFolder& out,
                     ProgressBar& bar)
: settings_(settings), folder_(folder), result_(result), out_(out), bar_(bar)
{}

const RunSummary&
RunWriter::write(bool complete, const RunLog& log)
{
  describe(complete, log);
  out_.removeOld(kRunFiles);
  writeTrajectoryKitti(out_ / "trajectory.kitti", trajectory());
  writeTrajectoryTum(out_ / "trajectory.tum", trajectory());
  writeHistory();
  if (complete) {
    const MapBuilder map = writeScansAndMap();
    summary_.map_points = map.points().size();
    drawTopView(map);
  }
  writeRunSummary(out_ / "summary.json", summary_);
  return summary_;
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
  fs::create_directories(out_ / "frames");
  for (std::size_t i = 0; i < folder_.size(); ++i) {
    const ScanResult& scan = result_.scans[i];
    const FrameKind kind =
        scan.state == ScanState::kPending ? FrameKind::kInvalid : FrameKind::kIcp;
    writeFrames(out_ / "frames" / (scanName(folder_.index(i)) + ".frames"),
                {{scan.initial_pose, FrameKind::kInvalid}, {scan.T_world_scan, kind}});
  }
}

void
RunWriter::describe(bool complete, const RunLog& log)
{
  summary_.version = PCL6D_VERSION;
  summary_.pose_source = folder_.poseSource();
  summary_.world_offset = worldOffset(result_.scans.front().T_world_scan);
  summary_.options = optionsOf(settings_, result_.parameters);
  summary_.stages = log.stages;
  for (std::size_t i = 0; i < folder_.size(); ++i)
    summary_.scans.push_back(
        entryOf(folder_.file(i).filename().string(), result_.scans[i], log.dropped[i]));
  summary_.complete = complete;
  summary_.trusted = complete && result_.trusted();
  summary_.verdict = verdictOf(result_, summary_);
}

std::string
scanName(int index)
{
  char name[32];
  std::snprintf(name, sizeof name, "scan%03d", index);
  return name;
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
