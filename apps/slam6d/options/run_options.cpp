// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "slam6d/options/plugin_words.h"
#include "slam6d/options/run_options.h"

#include <pcl6d/io/text.h>
#include <pcl6d/run/run_summary.h>

#include <filesystem>

namespace pcl6d::app {

namespace {
/** \return the option of a name, if allowed in the summary of a run: the file is untrusted */
const OptionSpec*
findInSummary(const OptionList& options, const std::string& name)
{
  for (const OptionSpec& option : options.rows())
    if (option.name == name && isInSummary(option.role))
      return &option;
  return nullptr;
}

/** Scans are identified by their names. Older versions wrote the replacement character for bytes
 * outside UTF-8: scans with this character would be taken twice. */
void
requireNames(const RunResult& run, const std::filesystem::path& file)
{
  for (const ScanResult& scan : run.scans)
    if (scan.file.find("\xef\xbf\xbd") != std::string::npos)
      text::fail(
          file,
          "the name of scan " + std::to_string(scan.index) +
              " is no UTF-8 and was not kept; start the run again with this version");
}

[[noreturn]] void
refusePlugins(const std::filesystem::path& file, const std::string& word)
{
  std::string again;
  for (const std::string& plugin : pluginFiles(word))
    again += " --plugin " + plugin;
  throw UsageError(file.string() +
                   ": the run used plug-ins, and a file must not choose the code to "
                   "run; if you trust the plug-ins, give:" +
                   again);
}
} // namespace

BroughtOptions
optionsOfRun(const std::string& run,
             const OptionList& options,
             const OptionSpec& plugins,
             bool has_plugins)
{
  const std::filesystem::path file = std::filesystem::path(run) / "summary.json";
  requireRun(run);
  const RunResult earlier = readRunSummary(file);
  requireNames(earlier, file);
  BroughtOptions brought{file.string(), {}};
  for (const auto& option : earlier.options) {
    if (option.source != "given")
      continue;
    const OptionSpec* const known = findInSummary(options, option.name);
    if (!known)
      text::fail(file, "no run brings an option " + text::quoted(option.name));
    if (isTakenOver(known->role))
      brought.options.emplace_back(option.name, option.value);
    else if (known == &plugins && !has_plugins)
      refusePlugins(file, option.value);
  }
  return brought;
}

} // namespace pcl6d::app
