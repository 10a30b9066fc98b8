// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/progress_bar.h"
#include "slam6d/input/join.h"
#include "slam6d/input/run_input.h"
#include "slam6d/input/sweep_tracking.h"
#include "slam6d/stage_timer.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/io/text.h>
#include <pcl6d/sources/open_source.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace pcl6d::app {

namespace {
std::string
whatIsRead(const ScanFolder& folder,
           const EarlierRuns& earlier,
           const std::optional<DriveResult>& drive)
{
  std::string text = text::counted(folder.size(), "scan");
  if (drive)
    text += " (keyframes of " + text::counted(drive->files.size(), "sweep") + ")";
  if (earlier.areJoined())
    return text + " of " + folder.poseSource();
  if (!earlier.empty())
    text += ", " + std::to_string(folder.numRegistered()) + " of them registered in " +
            earlier.runs[0].path().string();
  return text;
}
} // namespace

EarlierRuns
openEarlier(const Settings& settings)
{
  if (!settings.joined.empty())
    return openJoined(settings);
  EarlierRuns earlier;
  if (settings.continued.empty())
    return earlier;
  earlier.runs.push_back(RunFolder::finished(
      settings.continued, "the run was interrupted; start the run again, then go on"));
  earlier.runs[0].requireWhole("scans/");
  for (std::size_t i = 0; i < earlier.runs[0].summary().scans.size(); ++i)
    earlier.scans.push_back({0, i});
  return earlier;
}

RunInput
openInput(const Settings& settings,
          const EarlierRuns& earlier,
          const Interrupt* interrupt)
{
  if (earlier.areJoined())
    return {joinedFolder(earlier), {}, std::nullopt, {}, {}};
  std::optional<ScanFolder> folder;
  checkOptions([&] { folder.emplace(openScanFiles(settings.inputs, settings.folder)); },
               {{"poses_file", kPosesOption}});
  if (!earlier.empty())
    folder->continueRun(earlier.runs[0].path(), earlier.runs[0].summary());
  std::vector<RunResult::Stage> stages;
  TrackedScans tracked;
  if (earlier.empty() && isTracked(settings, *folder)) {
    const StageTimer timer("tracking", stages);
    tracked = trackSweeps(settings, *folder, interrupt);
  }
  if (earlier.empty() && !folder->posesAreEstimated())
    tracked.drive = selectKeyframes(settings, *folder);
  return {*std::move(folder),
          std::move(stages),
          std::move(tracked.drive),
          std::move(tracked.paths),
          std::move(tracked.contexts),
          tracked.are_moving};
}

RunScans
openScans(RunInput& input, const Settings& settings, const EarlierRuns& earlier)
{
  const ScanFolder& folder = input.folder;
  RunScans scans(folder);
  if (earlier.areJoined()) {
    scans.gate(gatesOf(earlier, settings));
    return scans;
  }
  // Sweeps tracked with the times of their points are deskewed along the tracked motion.
  const bool is_tracked_in_motion =
      settings.deskew == Deskew::kAuto && input.are_moving;
  if (settings.deskew == Deskew::kOdometry || is_tracked_in_motion)
    scans.deskew(settings.interpolation, input.paths);
  scans.setDriveContexts(std::move(input.contexts));
  if (settings.deskew == Deskew::kEstimate)
    scans.estimateMotion();
  scans.filterLines(settings.filter);
  scans.filterBy(settings.other_filter);
  return scans;
}

Settings
resolved(Settings settings, const ScanFolder& folder, const EarlierRuns& earlier)
{
  if (earlier.areJoined())
    takeLengths(earlier, settings);
  settings.resolveGuess(folder.posesDiffer());
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < folder.size(); ++i)
    indices.push_back(folder.index(i));
  settings.readLinks(indices);
  settings.readControl(folder);
  return settings;
}

std::string
foreseenWork(const Settings& settings,
             const EarlierRuns& earlier,
             std::size_t num_scans)
{
  // Only reported if above a few minutes. Seconds of one core per compared pair and per placed
  // pair, with four placed pairs per scan, from bench_join; scenes differ by a factor of two.
  constexpr std::size_t kMany = 100;
  constexpr double kCompared = 0.015, kPlaced = 0.35, kPlacedOfEach = 4;
  if (settings.slam.initial_guess != InitialGuess::kGlobal || num_scans < kMany)
    return "";
  const auto n = static_cast<double>(num_scans);
  double pairs = n * (n - 1) / 2;
  for (std::size_t r = 0; earlier.areJoined() && r < earlier.runs.size(); ++r) {
    const auto m = static_cast<double>(earlier.runs[r].summary().scans.size());
    pairs -= m * (m - 1) / 2; // no comparisons within a run
  }
  const double seconds = (kCompared * pairs + kPlaced * kPlacedOfEach * n) /
                         threadCount(settings.slam.num_threads);
  if (earlier.areJoined())
    return "all pairs of scans of different runs are compared, in about " +
           durationText(seconds);
  return std::string(settings.slam.order_first
                         ? "without poses the order of the files is tried first; if "
                           "scans stay disconnected, all pairs of "
                         : "without poses all pairs of ") +
         std::to_string(num_scans) + " scans are compared, in about " +
         durationText(seconds) + "; rough poses (--poses FILE) save most of the time";
}

std::vector<std::string>
describeInput(const Settings& settings,
              const RunScans& scans,
              const EarlierRuns& earlier,
              const std::optional<DriveResult>& drive,
              std::size_t num_processes)
{
  const ScanFolder& folder = scans.folder();
  std::string first = whatIsRead(folder, earlier, drive);
  if (num_processes > 1)
    first += ", shared by " + std::to_string(num_processes) + " processes";
  if (!earlier.areJoined())
    first += ", initial poses from " + folder.poseSource();
  std::vector<std::string> lines{first};
  for (const auto& plugin : settings.plugins.loaded())
    lines.push_back("plug-in " + plugin.name + " (" + plugin.file.string() +
                    "): " + plugin.adds);
  lines.push_back(folder.note());
  lines.push_back(folder.coordinates());
  lines.insert(lines.end(), earlier.notes.begin(), earlier.notes.end());
  lines.insert(lines.end(), scans.descriptions().begin(), scans.descriptions().end());
  lines.erase(std::remove(lines.begin(), lines.end(), ""), lines.end());
  return lines;
}

} // namespace pcl6d::app
