// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/progress_bar.h"
#include "slam6d/run_input.h"

#include <pcl6d/common/parallel.h>

#include <utility>
#include <vector>

namespace pcl6d::app {

std::optional<RunFolder>
openEarlier(const Settings& settings)
{
  if (settings.continued.empty())
    return {};
  RunFolder run = RunFolder::finished(
      settings.continued, "the run was interrupted; run it again, then go on with it");
  run.requireWhole("scans/");
  return run;
}

ScanFolder
openFolder(const Settings& settings, const std::optional<RunFolder>& earlier)
{
  std::optional<ScanFolder> folder;
  checkOptions([&] { folder.emplace(settings.input, settings.folder); },
               {{"poses_file", "poses"}});
  if (earlier)
    folder->continueRun(earlier->path(), earlier->summary());
  return *std::move(folder);
}

RunScans
openScans(const ScanFolder& folder, const Settings& settings)
{
  RunScans scans(folder);
  if (settings.deskew)
    scans.deskew(settings.interpolation);
  scans.filterLines(settings.filter);
  scans.filterBy(settings.other_filter);
  return scans;
}

Settings
resolved(Settings settings, const ScanFolder& folder)
{
  settings.resolveGuess(folder.hasPoses());
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < folder.size(); ++i)
    indices.push_back(folder.index(i));
  settings.readLinks(indices);
  return settings;
}

std::string
foreseenWork(const Settings& settings, std::size_t num_scans)
{
  // Said where it is more than a few minutes. Seconds of one core for a pair that is compared
  // and for one that is placed, four of each scan: those of bench_join, which differ by a
  // factor of two between scenes.
  constexpr std::size_t kMany = 100;
  constexpr double kCompared = 0.015, kPlaced = 0.35, kPlacedOfEach = 4;
  if (settings.slam.initial_guess != InitialGuess::kGlobal || num_scans < kMany)
    return "";
  const auto n = static_cast<double>(num_scans);
  const double seconds = (kCompared * n * (n - 1) / 2 + kPlaced * kPlacedOfEach * n) /
                         threadCount(settings.slam.num_threads);
  return "without poses all pairs of " + std::to_string(num_scans) +
         " scans are compared, which takes about " + durationText(seconds) +
         "; with rough poses (--poses FILE) it takes a part of it";
}

} // namespace pcl6d::app
