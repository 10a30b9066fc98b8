// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "slam6d/run_input.h"

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

} // namespace pcl6d::app
