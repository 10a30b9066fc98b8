// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/suite/suite_check.h"
#include "simulate/settings.h"
#include "slam6d/options/settings.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>

#include <functional>
#include <set>

namespace pcl6d::app {

namespace {
constexpr const char* kAnyFolder = "scans"; // for parsing only

/** Throws on invalid options. */
using Trial = std::function<void(const SuiteOptions&)>;

/** \return the error in the options; empty if valid */
std::string
faultOf(const SuiteOptions& options, const Trial& trial)
try {
  trial(options);
  return "";
} catch (const std::exception&) {
  return wordsOfCurrent();
}

/** Checks the options at one position of the file, together with the options inherited
 * there. An invalid option is named. */
void
checkOptionsAt(const std::string& place,
               const SuiteOptions& options,
               const SuiteOptions& below,
               const Suite& suite,
               const Trial& trial)
{
  static const std::set<std::string> kOfTheRunner = {"config",
                                                     "continue",
                                                     "force",
                                                     "help",
                                                     "join",
                                                     "output",
                                                     "quiet",
                                                     "verbose",
                                                     "version"};
  for (const auto& [name, value] : options.items()) {
    const std::string at = place + '/' + name;
    if (kOfTheRunner.count(name) > 0)
      refuseSuite(suite.file, at, "the option --" + name + " is not for suites");
    SuiteOptions alone = SuiteOptions::object();
    alone[name] = value;
    const std::string fault = faultOf(alone, trial);
    if (!fault.empty() && !faultOf(overlaid(below, options), trial).empty())
      refuseSuite(suite.file, at, fault);
  }
  const std::string fault = faultOf(overlaid(below, options), trial);
  if (!fault.empty())
    refuseSuite(suite.file, place, fault);
}

Settings
slamSettings(const std::string& folder, const SuiteOptions& options)
{
  std::vector<std::string> words = {folder, "-o", "out"};
  for (const auto& word : wordsOf(options))
    words.push_back(word);
  Settings settings;
  parseSettings(words, settings);
  if (!settings.graph_in.empty() && !std::filesystem::exists(settings.graph_in))
    throw UsageError(settings.graph_in + ": no such file");
  return settings;
}

void
tryScene(const std::string& scene, const SuiteOptions& options)
{
  std::vector<std::string> words = {scene, "-o", "out"};
  for (const auto& word : wordsOf(options))
    words.push_back(word);
  SimulateSettings settings;
  parseSettings(words, settings);
  sceneOf(settings);
}

void
checkSimulation(const SuiteData& data, const Suite& suite)
{
  const std::string place = "/data/" + data.entry + "/simulate";
  const std::string fault =
      faultOf({}, [&](const SuiteOptions&) { tryScene(data.scene, {}); });
  const bool is_mesh = fault.find("--path") != std::string::npos; // needs an option
  if (!fault.empty() && !is_mesh)
    refuseSuite(suite.file, place + "/scene", fault);
  checkOptionsAt(place, data.simulation, {}, suite, [&](const SuiteOptions& options) {
    tryScene(data.scene, options);
  });
}

void
checkReference(const SuiteData& data, const Suite& suite)
{
  if (data.reference.empty())
    return;
  const std::string fault =
      faultOf({}, [&](const SuiteOptions&) { readTrajectory(data.reference); });
  if (!fault.empty())
    refuseSuite(suite.file, "/data/" + data.entry + "/reference", fault);
}

void
openFolder(const SuiteData& data, const SuiteOptions& options)
{
  const Settings settings = slamSettings(data.folder, options);
  const ScanFolder folder(settings.inputs.front(), settings.folder);
}
void
checkData(const SuiteData& data, const Suite& suite, const Trial& parsing)
{
  checkOptionsAt(
      "/data/" + data.entry + "/options", data.options, suite.defaults, suite, parsing);
  if (!data.scene.empty())
    checkSimulation(data, suite);
  checkReference(data, suite);
}

/** Rejects impossible damages before the first run. */
void
checkDamage(const SuiteData& data, const Suite& suite)
{
  if (data.damage.odometry_noise != 1 && data.scene.empty() && data.reference.empty())
    refuseSuite(suite.file,
                "/data/" + data.entry,
                "has no reference, needed by odometry_noise of '" + data.damage.name +
                    "'");
}

/** Checks the options together, on a data set with its damage. */
void
checkTogether(const SuiteData& data, const Suite& suite, const Trial& parsing)
{
  const SuiteOptions below =
      overlaid(overlaid(suite.defaults, data.options), data.damage.options);
  for (const auto& method : suite.methods) {
    const SuiteOptions options = overlaid(below, method.options);
    const std::string fault = faultOf(options, [&](const SuiteOptions& all) {
      data.scene.empty() ? openFolder(data, all) : parsing(all);
    });
    if (!fault.empty())
      refuseSuite(
          suite.file, "/data/" + data.entry, fault + " (with '" + method.name + "')");
  }
}
} // namespace

void
checkSuite(const Suite& suite)
{
  const Trial parsing = [](const SuiteOptions& options) {
    slamSettings(kAnyFolder, options);
  };
  checkOptionsAt("/defaults", suite.defaults, {}, suite, parsing);
  for (const auto& damage : suite.damages)
    checkOptionsAt("/damages/" + damage.name + "/options",
                   damage.options,
                   suite.defaults,
                   suite,
                   parsing);
  for (const auto& method : suite.methods)
    checkOptionsAt(
        "/methods/" + method.name, method.options, suite.defaults, suite, parsing);
  std::set<std::string> checked; // seeds and damages repeat much
  for (const auto& data : suite.data) {
    if (checked.insert(data.entry).second)
      checkData(data, suite, parsing);
    checkDamage(data, suite);
    if (checked.insert(data.entry + '\n' + data.damage.name).second)
      checkTogether(data, suite, parsing);
  }
}

} // namespace pcl6d::app
