// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/option_table.h"
#include "slam6d/option_groups.h"
#include "slam6d/plugin_words.h"
#include "slam6d/run_options.h"
#include "slam6d/settings.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/link_list_io.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <set>

namespace pcl6d::app {

namespace {
constexpr const char* kUsageText =
    R"(usage: pcl_slam6d SCAN_DIR -o OUT_DIR [options]
       pcl_slam6d --join RUN_A RUN_B -o OUT_DIR [options]
Registers the 3D scans of a folder (PCD, PLY, 3DTK uos, KITTI bin, xyz) into one map
and writes poses, map, picture and summary. Distances are in metres.
Processes on one machine or many share the work: mpirun -n 4 pcl_slam6d SCAN_DIR -o OUT_DIR
)";

/** The options that go into the summary; lengths go there as parameters. */
constexpr const char* kWords[] = {"plugin",
                                  "first",
                                  "last",
                                  "every",
                                  "poses",
                                  "format",
                                  "deskew",
                                  "interpolation",
                                  "knots",
                                  "filter",
                                  "reduction",
                                  "reduction-points",
                                  "metric",
                                  "minimiser",
                                  "plane-minimiser",
                                  "search",
                                  "robust",
                                  "initial-guess",
                                  "metascan",
                                  "loop-closing",
                                  "close-loops",
                                  "loop-gate",
                                  "relaxation",
                                  "links",
                                  "link-weights",
                                  "link-hysteresis",
                                  "relaxation-rounds",
                                  "graph-in",
                                  "continue",
                                  "join",
                                  "iterations",
                                  "min-overlap",
                                  "max-correction",
                                  "moving",
                                  "no-recovery",
                                  "planes",
                                  "report",
                                  "threads",
                                  "no-picture",
                                  "no-verification",
                                  "seed"};

/** \return the options that poses follow from: an interrupted run goes on with the same
 * alone. Given poses, links and runs are told apart by what they hold. */
std::vector<OptionWord>
conditionsOf(const std::vector<OptionWord>& words, const OptionTable& table)
{
  const std::set<std::string> others = {"poses",
                                        "graph-in",
                                        "continue",
                                        "planes",
                                        "report",
                                        "threads",
                                        "no-picture",
                                        "no-verification"};
  std::vector<OptionWord> conditions = table.words({"min-range",
                                                    "max-range",
                                                    "voxel",
                                                    "line-spacing",
                                                    "max-distance",
                                                    "max-distance-start",
                                                    "loop-distance",
                                                    "loop-gap",
                                                    "loop-pairs",
                                                    "link-distance"});
  for (const OptionWord& word : words)
    if (others.count(word.name) == 0)
      conditions.push_back(word);
  return conditions;
}

/** \return the arguments, in which `--deskew estimate` is `--deskew=estimate`: as the word may be
 * left out, the parser takes another argument for no word of it */
std::vector<std::string>
withDeskewWord(std::vector<std::string> arguments)
{
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i)
    if (arguments[i] == "--deskew" &&
        (arguments[i + 1] == "estimate" || arguments[i + 1] == "odometry")) {
      arguments[i] += "=" + arguments[i + 1];
      arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
  return arguments;
}

OptionWord&
wordOf(const std::string& name, std::vector<OptionWord>& words)
{
  return *std::find_if(
      words.begin(), words.end(), [&](const auto& one) { return one.name == name; });
}

/** Takes the arguments: a folder of scans, or runs that are joined. */
void
takeInputs(const std::vector<std::string>& inputs, bool joins, Settings& settings)
{
  if (!joins && inputs.size() > 1)
    throw UsageError("SCAN_DIR is one folder, but " + text::quoted(inputs[1]) +
                     " is given, too (runs are joined by --join)");
  if (!joins) {
    settings.input = inputs.front();
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

/** Where runs are joined: what the summary says of that. */
void
nameJoined(Settings& settings)
{
  if (settings.joined.empty())
    return;
  wordOf("join", settings.words).value = joined(settings.joined, " ");
  wordOf("initial-guess", settings.words) = {
      "initial-guess", toString(settings.slam.initial_guess), false};
}
} // namespace

std::string
Settings::inputWords() const
{
  return input.empty() ? pcl6d::app::joined(joined, " ") : input;
}

void
Settings::resolveGuess(bool has_poses)
{
  slam.motion.keep_still = deskew == Deskew::kEstimate && !continued.empty();
  if (!auto_guess)
    return;
  slam.motion.gives_poses = !has_poses && deskew == Deskew::kEstimate;
  slam.initial_guess = has_poses ? InitialGuess::kOdometry : InitialGuess::kGlobal;
  for (auto* options : {&words, &conditions})
    for (auto& word : *options)
      if (word.name == "initial-guess")
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
  const std::vector<std::string> arguments = withDeskewWord(given);
  refuseScale(arguments);
  OptionTable table(kUsageText);
  std::vector<std::string> inputs;
  bool joins = false;
  table.positionals("SCAN_DIR", &inputs);
  addOptions(table, settings, joins);
  table.bringOptions("continue", [&table](const std::string& run) {
    return optionsOfRun(run, table.given("plugin"));
  });
  if (!table.parse(arguments))
    return false;
  takeInputs(inputs, joins, settings);
  if (settings.out.empty())
    settings.out = settings.continued;
  if (settings.out.empty())
    throw UsageError("-o OUT_DIR is missing");
  table.check(
      [&] {
        settings.folder.validate();
        settings.slam.validate();
      },
      {{"max_iterations", "iterations"}, {"reduction_points", "reduction-points"}});
  settings.slam.verify = !settings.no_verification;
  settings.slam.leave_out_moving = settings.moving != Moving::kKeep;
  settings.slam.recover = !settings.no_recovery;
  if (settings.resume && settings.fresh)
    throw UsageError("--resume and --fresh contradict each other");
  loadPlugins(settings);
  settings.words = table.words({std::begin(kWords), std::end(kWords)});
  wordOf("plugin", settings.words).value = pluginWord(settings);
  nameJoined(settings);
  settings.conditions = conditionsOf(settings.words, table);
  wordOf("plugin", settings.conditions).value = pluginCondition(settings);
  // Words have six digits; lengths are compared to the last bit by the tasks' names.
  for (const auto& [name, value] :
       {std::pair("min-overlap", settings.slam.min_overlap),
        std::pair("max-correction", settings.slam.max_correction),
        std::pair("loop-gate", settings.slam.loop_gate),
        std::pair("link-hysteresis", settings.slam.link_hysteresis)})
    settings.conditions.push_back({name, text::shortest(value), true});
  const bool planes = settings.slam.metric != Metric::kPoint;
  const bool relaxes = settings.slam.relaxation.has_value();
  const bool closes = settings.slam.loop_closing != LoopClosing::kNone;
  settings.without_effect = table.withoutEffect(
      {{"first", !joins, "of SCAN_DIR"},
       {"last", !joins, "of SCAN_DIR"},
       {"every", !joins, "of SCAN_DIR"},
       {"poses", !joins, "of SCAN_DIR"},
       {"format", !joins, "of SCAN_DIR"},
       {"deskew", !joins, "of SCAN_DIR"},
       {"filter", !joins, "of SCAN_DIR"},
       {"initial-guess", !joins, "of SCAN_DIR"},
       {"resume", !joins, "of SCAN_DIR"},
       {"fresh", !joins, "of SCAN_DIR"},
       {"interpolation", settings.deskew == Deskew::kOdometry, "of --deskew"},
       {"knots", settings.deskew == Deskew::kEstimate, "of --deskew estimate"},
       {"line-spacing", !settings.slam.voxel, "where --voxel is derived"},
       {"reduction-points",
        settings.slam.reduction == ReductionMethod::kRandom,
        "of --reduction random"},
       {"close-loops", closes, "of --loop-closing"},
       {"loop-distance", closes, "of --loop-closing"},
       {"loop-gap", closes, "of --loop-closing"},
       {"loop-pairs", closes, "of --loop-closing"},
       {"loop-gate", closes, "of --loop-closing"},
       {"links", relaxes, "of --relaxation"},
       {"link-distance",
        relaxes && settings.slam.links == LinkRule::kDistance,
        "of --links distance"},
       {"link-hysteresis", relaxes, "of --relaxation"},
       {"link-weights", relaxes, "of --relaxation"},
       {"relaxation-rounds", relaxes, "of --relaxation"},
       {"graph-in", relaxes, "of --relaxation"},
       {"minimiser", !planes, "of the metric point"},
       {"plane-minimiser", planes, "of the metrics plane and gicp"}});
  return true;
}

std::vector<std::pair<std::string, Parameter>>
named(const Slam6DParameters& parameters, const Settings& settings)
{
  std::vector<std::pair<std::string, Parameter>> known = {
      {"min-range", parameters.min_range},
      {"max-range", parameters.max_range},
      {"voxel", parameters.voxel},
      {"line-spacing", parameters.line_spacing},
      {"max-distance", parameters.max_distance},
      {"max-distance-start", parameters.max_distance_start},
      {"loop-distance", parameters.loop_distance},
      {"loop-gap", parameters.loop_gap},
      {"loop-pairs", parameters.loop_pairs},
      {"link-distance", parameters.link_distance}};
  known.erase(std::remove_if(known.begin(),
                             known.end(),
                             [](const auto& one) {
                               return !one.second.given && one.second.why.empty();
                             }),
              known.end());
  for (auto& [name, parameter] : known)
    if (const auto reason = settings.length_reasons.find(name);
        reason != settings.length_reasons.end())
      parameter.why = reason->second;
  return known;
}

} // namespace pcl6d::app
