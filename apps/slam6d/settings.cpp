// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "slam6d/option_words.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/link_list_io.h>
#include <pcl6d/registration/minimisers.h>
#include <pcl6d/run/run_summary.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

namespace pcl6d::app {

namespace fs = std::filesystem;

namespace {
constexpr int kMostThreads = 1024;

constexpr const char* kUsageText =
    "usage: pcl_slam6d SCAN_DIR -o OUT_DIR [options]\n"
    "Registers the 3D scans of a folder (PCD, PLY, 3DTK uos, KITTI bin, xyz) into one "
    "map\n"
    "and writes poses, map, picture and summary. Distances are in metres.\n";

std::optional<double>
toOptional(const AutoDouble& value)
{
  return value.is_auto ? std::nullopt : std::optional<double>(value.value);
}

int
metascanFromText(const std::string& text)
{
  if (text == "all")
    return 0;
  std::istringstream stream(text);
  int count = 0;
  if (!(stream >> count) || !stream.eof() || count < 1)
    throw UsageError("--metascan " + text + ": expected a number >= 1 or all");
  return count;
}

void
interpret(const CommandLine& line, const OptionWords& raw, Settings& s)
{
  if (s.out.empty())
    s.out = s.continued;
  if (s.out.empty())
    throw UsageError("-o OUT_DIR is missing");
  if (line.given("last"))
    s.folder.last = raw.last;
  s.slam.num_threads = static_cast<unsigned int>(raw.threads);
  s.slam.metascan = metascanFromText(raw.metascan);
  s.slam.min_range = toOptional(raw.min_range);
  s.slam.max_range = toOptional(raw.max_range);
  s.slam.voxel = toOptional(raw.voxel);
  s.slam.max_distance = toOptional(raw.max_distance);
  s.slam.max_distance_start = toOptional(raw.max_distance_start);
  checkOptions(
      [&] {
        require(raw.threads >= 0 && raw.threads <= kMostThreads,
                "threads",
                raw.threads,
                "in [0, " + std::to_string(kMostThreads) + "]");
        require(s.seed >= 0, "seed", s.seed, ">= 0");
        s.interpolation = motionInterpolationFromName(raw.interpolation);
        s.slam.metric = metricFromName(raw.metric);
        s.slam.minimiser = minimiserFromName(raw.minimiser);
        s.slam.plane_minimiser = planeMinimiserFromName(raw.plane_minimiser);
        s.slam.search = searchMethodFromName(raw.search);
        s.slam.robust = robustKernelFromName(raw.robust);
        s.slam.loop_closing = loopClosingFromName(raw.loop_closing);
        s.slam.relaxation =
            raw.relaxation == "none"
                ? std::nullopt
                : std::make_optional(relaxationFromName(raw.relaxation));
        s.slam.links = linkRuleFromName(raw.links);
        s.auto_guess = raw.initial_guess == "auto";
        if (!s.auto_guess)
          s.slam.initial_guess = initialGuessFromName(raw.initial_guess);
        s.slam.seed = static_cast<std::uint64_t>(s.seed);
        s.folder.format = scanFormatFromName(raw.format);
        s.folder.validate();
        s.slam.validate();
      },
      {{"max_iterations", "iterations"},
       {"plane minimiser", "plane-minimiser"},
       {"relaxation_rounds", "relaxation-rounds"},
       {"loop closing", "loop-closing"},
       {"initial guess", "initial-guess"}});
}

/** \return the options that were given to a run, but for those that say what it reads,
 * as lines of a config file */
std::string
optionsOfRun(const std::string& run)
{
  const std::set<std::string> of_input = {
      "first", "last", "every", "poses", "format", "graph-in", "continue", "threads"};
  std::string lines;
  for (const auto& option : readRunSummary(fs::path(run) / "summary.json").options)
    if (option.source == "given" && of_input.count(option.name) == 0)
      lines += option.name + " = " + option.value + '\n';
  return lines;
}

template <typename T>
Settings::Word
word(const CommandLine& line, const std::string& name, const T& value)
{
  std::ostringstream text;
  text << value;
  return {name, text.str(), line.given(name)};
}

/** The words that go into the summary; lengths go there as parameters. */
std::vector<Settings::Word>
wordsOf(const CommandLine& line, const OptionWords& raw, const Settings& s)
{
  return {word(line, "first", s.folder.first),
          word(line, "last", s.folder.last ? std::to_string(*s.folder.last) : "end"),
          word(line, "every", s.folder.every),
          word(line, "poses", s.folder.poses_file.string()),
          word(line, "format", raw.format),
          word(line, "deskew", s.deskew ? "yes" : "no"),
          word(line, "interpolation", raw.interpolation),
          word(line, "metric", raw.metric),
          word(line, "minimiser", raw.minimiser),
          word(line, "plane-minimiser", raw.plane_minimiser),
          word(line, "search", raw.search),
          word(line, "robust", raw.robust),
          word(line, "initial-guess", raw.initial_guess),
          word(line, "metascan", raw.metascan),
          word(line, "loop-closing", raw.loop_closing),
          word(line, "relaxation", raw.relaxation),
          word(line, "links", raw.links),
          word(line, "relaxation-rounds", s.slam.relaxation_rounds),
          word(line, "graph-in", s.graph_in),
          word(line, "continue", s.continued),
          word(line, "iterations", s.slam.max_iterations),
          word(line, "min-overlap", s.slam.min_overlap),
          word(line, "max-correction", s.slam.max_correction),
          word(line, "planes", s.planes ? "yes" : "no"),
          word(line, "report", s.report ? "yes" : "no"),
          word(line, "threads", raw.threads),
          word(line, "seed", s.seed)};
}
} // namespace

void
Settings::resolveGuess(bool has_poses)
{
  if (!auto_guess)
    return;
  slam.initial_guess = has_poses ? InitialGuess::kOdometry : InitialGuess::kFeatures;
  for (auto& word : words)
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
parseSettings(const std::vector<std::string>& arguments, Settings& settings)
{
  CommandLine line(kUsageText);
  OptionWords raw;
  line.positional("SCAN_DIR", &settings.input);
  describeOptions(line, settings, raw);
  line.bringOptions("continue", optionsOfRun);
  if (!line.parse(arguments))
    return false;
  interpret(line, raw, settings);
  settings.words = wordsOf(line, raw, settings);
  const bool planes = settings.slam.metric != Metric::kPoint;
  const bool relaxes = settings.slam.relaxation.has_value();
  settings.without_effect = line.withoutEffect(
      {{"interpolation", settings.deskew, "of --deskew"},
       {"links", relaxes, "of --relaxation"},
       {"relaxation-rounds", relaxes, "of --relaxation"},
       {"graph-in", relaxes, "of --relaxation"},
       {"minimiser", !planes, "of the metric point"},
       {"plane-minimiser", planes, "of the metrics plane and gicp"}});
  return true;
}

std::vector<std::pair<std::string, Parameter>>
named(const Slam6DParameters& parameters)
{
  return {{"min-range", parameters.min_range},
          {"max-range", parameters.max_range},
          {"voxel", parameters.voxel},
          {"max-distance", parameters.max_distance},
          {"max-distance-start", parameters.max_distance_start}};
}

} // namespace pcl6d::app
