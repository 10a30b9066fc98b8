// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/listed_options.h"
#include "common/options/option_table.h"
#include "slam6d/options/option_groups.h"
#include "slam6d/options/plugin_words.h"
#include "slam6d/options/run_options.h"
#include "slam6d/options/settings.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/link_list_io.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/survey_options.h>
#include <pcl6d/sources/coordinate_system.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
constexpr const char* kUsageText =
    R"(usage: pcl_slam6d SCAN_DIR|SITE.e57|DRIVE.bag|FILE FILE ... -o OUT_DIR [options]
       pcl_slam6d --join RUN_A RUN_B -o OUT_DIR [options]
Registers the 3D scans of a folder (PCD, PLY, LAS, LAZ, PTX, PTS, CSV, 3DTK uos, KITTI bin,
xyz), of an E57 or PTX file, of a robot's recording (ROS .bag, .mcap, .db3), or of several
files in the order given into one map and writes poses, map, picture and summary. Distances
are in metres.
Processes on one machine or many share the work: mpirun -n 4 pcl_slam6d SCAN_DIR -o OUT_DIR
)";

/** \return the options of the summary, without lengths, which are parameters there */
std::vector<OptionWord>
summaryWords(const OptionList& options, const OptionTable& table)
{
  std::vector<std::string> names;
  for (const OptionSpec& option : options.rows())
    if (isInSummary(option.role) && !option.parameter)
      names.push_back(option.name);
  return table.words(names);
}

/** \return the options that change poses: an interrupted run resumes only with equal values.
 * Lengths have six digits here; the task hashes compare all bits. */
std::vector<OptionWord>
conditionsOf(const OptionList& options, const OptionTable& table)
{
  std::vector<OptionWord> conditions = table.words(namesOf(options, mustStayAlike));
  for (OptionWord& word : conditions)
    for (const OptionSpec& option : options.rows())
      if (const auto* number = std::get_if<double*>(&option.variable);
          number && option.name == word.name)
        word.value = text::shortest(**number);
  return conditions;
}

bool
isDeskewWord(const std::string& word)
{
  for (const char* one : {kDeskewEstimate, kDeskewOdometry, "auto", "no", "yes"})
    if (word == one)
      return true;
  return false;
}

/** \return the arguments with `--deskew estimate` replaced by `--deskew=estimate`: the word is
 * optional, and the parser would take a separate word for another argument */
std::vector<std::string>
withDeskewWord(const std::string& option, std::vector<std::string> arguments)
{
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i)
    if (arguments[i] == "--" + option && isDeskewWord(arguments[i + 1])) {
      arguments[i] += "=" + arguments[i + 1];
      arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
  return arguments;
}

/** \return the arguments with former words replaced
 * \param[in] recovery name of the option */
std::vector<std::string>
withWordsOfToday(const std::string& recovery, std::vector<std::string> arguments)
{
  std::replace(arguments.begin(),
               arguments.end(),
               "--no-" + recovery,
               "--" + recovery + "=" + toString(RecoveryEffort::kOff));
  return arguments;
}

OptionWord&
wordOf(const std::string& name, std::vector<OptionWord>& words)
{
  return *std::find_if(
      words.begin(), words.end(), [&](const auto& one) { return one.name == name; });
}

/** Takes the arguments: a folder of scans, or runs to be joined. */
void
takeInputs(const std::vector<std::string>& inputs, Settings& settings)
{
  std::error_code missing;
  for (const auto& input : inputs)
    if (!settings.joins && inputs.size() > 1 &&
        std::filesystem::is_directory(input, missing))
      throw UsageError("SCAN_DIR is one folder, or several files are given, but " +
                       text::quoted(input) +
                       " is a folder among files (runs are joined by --join)");
  if (!settings.joins) {
    settings.inputs.assign(inputs.begin(), inputs.end());
    return;
  }
  settings.joined = inputs;
  if (inputs.size() < 2)
    throw UsageError("--join needs two finished runs: --join RUN_A RUN_B -o OUT_DIR");
  if (!settings.continued.empty())
    throw UsageError("--join and --continue contradict each other");
  settings.auto_guess = false;
  settings.slam.initial_guess = InitialGuess::kGlobal;
}

/** Words of the summary for joined runs. */
void
nameJoined(const OptionList& options, Settings& settings)
{
  if (settings.joined.empty())
    return;
  wordOf(options.of(&settings.joins).name, settings.words).value =
      joined(settings.joined, " ");
  const std::string guess = options.of(&settings.slam.initial_guess).name;
  wordOf(guess, settings.words) = {guess, toString(settings.slam.initial_guess), false};
}

/** \return a word, marked as given */
OptionWord
givenWord(const std::string& name, const std::string& value)
{
  return {name, value, true};
}

/** Words of the summary for the options set by --start. */
void
nameStart(const OptionList& options, const OptionTable& table, Settings& settings)
{
  const std::string& start = options.of(&settings.start).name;
  const std::string& guess = options.of(&settings.slam.initial_guess).name;
  const std::string& track = options.of(&settings.track).name;
  if (settings.start == "auto" || !settings.joined.empty())
    return;
  for (const std::string& name : {guess, track})
    if (table.given(name))
      throw UsageError("--" + start + " sets --" + name + ": give one of them");
  for (auto* words : {&settings.words, &settings.conditions}) {
    wordOf(guess, *words) = givenWord(guess, toString(settings.slam.initial_guess));
    wordOf(track, *words) =
        givenWord(track, settings.track == Tracking::kOn ? "on" : "off");
  }
}

/** Sets values derived from several options. */
void
takeWords(const OptionList& options, const OptionTable& table, Settings& settings)
{
  const std::string& plugins = options.of(&settings.plugin_files).name;
  settings.words = summaryWords(options, table);
  wordOf(plugins, settings.words).value = pluginWord(settings);
  if (!settings.project.empty())
    wordOf(options.of(&settings.project).name, settings.words).value =
        joined(settings.project, "\n");
  nameJoined(options, settings);
  settings.conditions = conditionsOf(options, table);
  wordOf(plugins, settings.conditions).value = pluginCondition(settings);
  if (!settings.joined.empty())
    for (const void* place : {static_cast<const void*>(&settings.joins),
                              static_cast<const void*>(&settings.slam.initial_guess)})
      wordOf(options.of(place).name, settings.conditions) =
          wordOf(options.of(place).name, settings.words);
  nameStart(options, table, settings);
  settings.without_effect = withoutEffect(table, options);
}
} // namespace

std::string
Settings::inputWords() const
{
  std::vector<std::string> names = joined;
  for (const auto& input : inputs)
    names.push_back(input.string());
  return pcl6d::app::joined(names, " ");
}

void
Settings::resolveGuess(bool has_poses)
{
  slam.motion.keep_still = deskew == Deskew::kEstimate && !continued.empty();
  if (!auto_guess)
    return;
  slam.motion.gives_poses = !has_poses && deskew == Deskew::kEstimate;
  slam.initial_guess = has_poses ? InitialGuess::kOdometry : InitialGuess::kGlobal;
  slam.order_first = !has_poses;
  Slam6DParameters unused;
  const std::string name = optionsOf(*this, unused).of(&slam.initial_guess).name;
  for (auto* options : {&words, &conditions})
    for (auto& word : *options)
      if (word.name == name)
        word.value = toString(slam.initial_guess);
}

void
Settings::readLinks(const std::vector<std::size_t>& indices)
{
  if (graph_in.empty())
    return;
  const auto place = [&](std::size_t index) {
    const auto found = std::find(indices.begin(), indices.end(), index);
    if (found == indices.end())
      throw IoFailed(graph_in + ": links scan " + std::to_string(index) +
                     ", which is not among the chosen scans");
    return static_cast<std::size_t>(found - indices.begin());
  };
  for (const auto& [a, b] : readLinkList(graph_in))
    slam.given_links.emplace_back(place(a), place(b));
}

bool
parseSettings(const std::vector<std::string>& given, Settings& settings)
{
  Slam6DParameters unused;
  const OptionList options = optionsOf(settings, unused);
  const std::vector<std::string> arguments =
      withWordsOfToday(options.of(&settings.slam.recovery).name,
                       withDeskewWord(options.of(&settings.deskew).name, given));
  refuseScale(arguments);
  OptionTable table(kUsageText);
  std::vector<std::string> inputs;
  table.positionals("SCAN_DIR", &inputs);
  addOptions(table, options);
  const OptionSpec& plugins = options.of(&settings.plugin_files);
  table.bringOptions(options.of(&settings.continued).name, [&](const std::string& run) {
    return optionsOfRun(run, options, plugins, table.given(plugins.name));
  });
  if (!table.parse(arguments))
    return false;
  takeInputs(inputs, settings);
  if (settings.out.empty())
    settings.out = settings.continued;
  if (settings.out.empty() && !settings.explain)
    throw UsageError("-o OUT_DIR is missing");
  table.check(
      [&] {
        settings.folder.validate();
        settings.slam.validate();
        surveyOptionsFrom(settings.project, settings.tolerance);
        if (settings.epsg != 0)
          wktOfEpsg(settings.epsg);
      },
      optionsOfFields(options));
  settings.slam.leave_out_moving = settings.moving != Moving::kKeep;
  if (settings.resume && settings.fresh)
    throw UsageError("--resume and --fresh contradict each other");
  loadPlugins(settings);
  takeWords(options, table, settings);
  return true;
}

std::vector<NamedParameter>
named(const Slam6DParameters& parameters, const Settings& settings)
{
  Slam6DOptions options = settings.slam;
  Slam6DParameters used = parameters;
  OptionList list;
  describe(options, used, list);
  std::vector<NamedParameter> known;
  for (const OptionSpec& option : list.rows()) {
    if (!option.parameter ||
        (!option.parameter->given && option.parameter->why.empty()))
      continue;
    known.push_back({option.name, option.unit, *option.parameter});
    if (const auto reason = settings.length_reasons.find(option.name);
        reason != settings.length_reasons.end())
      known.back().parameter.why = reason->second;
  }
  return known;
}

} // namespace pcl6d::app
