// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "slam6d/plugin_words.h"
#include "slam6d/run_options.h"

#include <pcl6d/io/text.h>
#include <pcl6d/run/run_summary.h>

#include <filesystem>
#include <set>

namespace pcl6d::app {

namespace {
/** What a run may bring: an allowlist, as anybody may have written the file. */
const std::set<std::string> kBrought = {"close-loops",
                                        "deskew",
                                        "filter",
                                        "initial-guess",
                                        "interpolation",
                                        "knots",
                                        "iterations",
                                        "line-spacing",
                                        "link-distance",
                                        "link-hysteresis",
                                        "link-weights",
                                        "links",
                                        "loop-closing",
                                        "loop-distance",
                                        "loop-gap",
                                        "loop-gate",
                                        "loop-pairs",
                                        "max-correction",
                                        "max-distance",
                                        "max-distance-start",
                                        "max-range",
                                        "metascan",
                                        "metric",
                                        "min-overlap",
                                        "min-range",
                                        "minimiser",
                                        "moving",
                                        "no-picture",
                                        "no-recovery",
                                        "no-verification",
                                        "plane-minimiser",
                                        "planes",
                                        "reduction",
                                        "reduction-points",
                                        "relaxation",
                                        "relaxation-rounds",
                                        "report",
                                        "robust",
                                        "search",
                                        "seed",
                                        "voxel"};

/** What it read and how it ran, which each run says anew. */
const std::set<std::string> kOfEachRun = {"continue",
                                          "every",
                                          "first",
                                          "format",
                                          "graph-in",
                                          "join",
                                          "last",
                                          "poses",
                                          "threads"};

/** Scans are told apart by their names. Older versions wrote the replacement character for
 * what is no UTF-8: such scans would be taken twice. */
void
requireNames(const RunResult& run, const std::filesystem::path& file)
{
  for (const ScanResult& scan : run.scans)
    if (scan.file.find("\xef\xbf\xbd") != std::string::npos)
      text::fail(file,
                 "the name of scan " + std::to_string(scan.index) +
                     " is no UTF-8 and was not kept; run it again with this version");
}

[[noreturn]] void
refusePlugins(const std::filesystem::path& file, const std::string& word)
{
  std::string again;
  for (const std::string& plugin : pluginFiles(word))
    again += " --plugin " + plugin;
  throw UsageError(file.string() +
                   ": the run used plug-ins, and a file must not choose "
                   "the code that runs here; if you trust them, give:" +
                   again);
}
} // namespace

BroughtOptions
optionsOfRun(const std::string& run, bool has_plugins)
{
  const std::filesystem::path file = std::filesystem::path(run) / "summary.json";
  const RunResult earlier = readRunSummary(file);
  requireNames(earlier, file);
  BroughtOptions brought{file.string(), {}};
  for (const auto& option : earlier.options) {
    if (option.source != "given" || kOfEachRun.count(option.name))
      continue;
    if (kBrought.count(option.name))
      brought.options.emplace_back(option.name, option.value);
    else if (option.name != "plugin")
      text::fail(file, "no run brings an option " + text::quoted(option.name));
    else if (!has_plugins)
      refusePlugins(file, option.value);
  }
  return brought;
}

} // namespace pcl6d::app
