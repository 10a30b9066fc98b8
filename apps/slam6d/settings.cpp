// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/option_table.h"
#include "common/reduction_options.h"
#include "slam6d/settings.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/link_list_io.h>
#include <pcl6d/io/text.h>
#include <pcl6d/registration/minimisers.h>
#include <pcl6d/run/run_summary.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

namespace pcl6d::app {

namespace fs = std::filesystem;

namespace {
constexpr const char* kUsageText =
    R"(usage: pcl_slam6d SCAN_DIR -o OUT_DIR [options]
Registers the 3D scans of a folder (PCD, PLY, 3DTK uos, KITTI bin, xyz) into one map
and writes poses, map, picture and summary. Distances are in metres.
)";

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
addInput(OptionTable& table, Settings& s)
{
  table.group("Input");
  table.add("first", &s.folder.first)
      .help("index of the first scan to take, in the order of the folder");
  table.add("last", &s.folder.last)
      .otherwise("end")
      .help("index of the last scan to take (default: the end)");
  table.add("every", &s.folder.every).help("take each n-th scan");
  table.add("poses FILE", &s.folder.poses_file)
      .help(
          "initial poses, KITTI or TUM rows, one per scan of the folder (default: "
          "*.pose, odometry.txt, poses.txt, PCD VIEWPOINT or identity, the first that "
          "is there)");
  table.add("format", &s.folder.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|kitti|xyz");
  table.add("deskew", &s.deskew)
      .help("scans were taken while moving: correct each point by its time (field t or "
            "time) along the initial poses; needs their time stamps (times.txt, or TUM "
            "rows)");
  table.add("interpolation", &s.interpolation, motionInterpolationFromName, "linear")
      .help("linear|cubic: how --deskew moves between two poses; cubic follows bends "
            "better");
  table.add("continue RUN_DIR", &s.continued)
      .help("goes on with a finished run: its scans keep their place and its options "
            "count unless given anew; taken are the files of SCAN_DIR whose names it "
            "lacks; -o is RUN_DIR by default");
}

void
addMethods(OptionTable& table, Settings& s)
{
  table.group("Matching");
  table.add("metric", &s.slam.metric, metricFromName)
      .help(joined(metricNames()) +
            ": distance between points, of points to planes, of planes");
  table.add("minimiser", &s.slam.minimiser, minimiserFromName, "quaternion")
      .help(joined(minimiserNames()) + ", of the metric point");
  table.add("plane-minimiser", &s.slam.plane_minimiser, planeMinimiserFromName, "helix")
      .help(joined(planeMinimiserNames()) + ", of the metrics plane and gicp");
  table.add("search", &s.slam.search, searchMethodFromName)
      .help(joined(searchMethodNames()) +
            ": how closest points are found; all but approximate give the same result");
  table.add("robust", &s.slam.robust, robustKernelFromName)
      .help(joined(robustKernelNames()) + ": less weight for pairs that are far apart");
  const auto takeGuess = [&s](const std::string& word) {
    s.auto_guess = word == "auto";
    if (!s.auto_guess)
      s.slam.initial_guess = initialGuessFromName(word);
  };
  table.addWord("initial-guess", "auto", takeGuess)
      .help("auto|" + joined(initialGuessNames()) +
            ": where matching starts; auto: odometry, features if there are no poses");
}

void
addMatching(OptionTable& table, Settings& s)
{
  table.group("Range gate and reduction");
  addReductionOptions(table, s.slam);
  addMethods(table, s);
  table.group("Limits of matching");
  table.addAuto("max-distance", &s.slam.max_distance)
      .help("[m] or auto: largest pair distance");
  table.addAuto("max-distance-start", &s.slam.max_distance_start)
      .help("[m] or auto: largest pair distance of the first iteration, which then "
            "shrinks to --max-distance");
  table.add("metascan N|all", &s.slam.metascan, metascanFromText, "all")
      .help("match against the union of the last N scans; 1 is pairwise");
  table.add("iterations", &s.slam.max_iterations)
      .help("most iterations of one ICP; a scan that needs more is not converged");
  table.add("min-overlap", &s.slam.min_overlap)
      .help("share of points with a partner below which a match is not believed");
  table.add("max-correction", &s.slam.max_correction)
      .help("share of the odometry's step by which a match may move a scan; beyond, it "
            "is not believed (inf: always). 1.5 x max-distance is always allowed; not "
            "applied to --initial-guess overlap and features");
}

std::optional<Relaxation>
relaxationOrNone(const std::string& word)
{
  return word == "none" ? std::nullopt : std::make_optional(relaxationFromName(word));
}

void
addGraph(OptionTable& table, Settings& s)
{
  table.group("Loops and graph");
  table.add("loop-closing", &s.slam.loop_closing, loopClosingFromName)
      .help(joined(loopClosingNames()) +
            ": how the error of a loop that is found is spread; none: no search");
  const std::string usual = toString(*s.slam.relaxation);
  table.add("relaxation", &s.slam.relaxation, relaxationOrNone, usual)
      .help(joined(relaxationNames()) +
            "|none: how all scans are moved at once after matching; undone if the map "
            "gets worse");
  table.add("links", &s.slam.links, linkRuleFromName)
      .help(joined(linkRuleNames()) +
            ": which scans are linked, those that see the same places or those within "
            "7.5 m");
  table.add("relaxation-rounds", &s.slam.relaxation_rounds)
      .help("most rounds, with links and pairs anew in each");
  table.add("graph-in FILE", &s.graph_in)
      .help(
          "links to look at besides those found: .g2o, or lines 'a b' with the indices "
          "of two scans; each counts as far as the others confirm it");
}

void
addRun(OptionTable& table, Settings& s)
{
  table.group("Run");
  table.add("output,o OUT_DIR", &s.out).help("folder to write; made if missing");
  table.addAs<int>("threads", &s.slam.num_threads)
      .within(0, 1024, "in [0, 1024]")
      .help("0: one per core; never changes the result");
  s.memory.addTo(table);
  table.add("planes", &s.planes)
      .help(
          "find the planes of the map and say what they are: planes.json, planes.pcd, "
          "hulls.ply and a picture (more choice: pcl_slam6d_planes OUT_DIR)");
  table.add("report", &s.report)
      .help("write report.html: verdict, map, plots and tables on one page for a "
            "browser");
  table.add("no-picture", &s.no_picture)
      .help("do not draw top_view.png, which takes a second");
  table.add("no-verification", &s.no_verification)
      .help("do not judge the map by the points and rays of its scans in the end");
  table.addAs<std::int64_t>("seed", &s.slam.seed)
      .within(0, kNoBound, ">= 0")
      .help("of random choices (those of --initial-guess features)");
  table.add("live-view", &s.live_view)
      .help("show the map in a window while it grows, and at the end until that is "
            "closed; without a display the run goes on without");
  table.add("resume", &s.resume)
      .help(
          "go on where an interrupted run into OUT_DIR stopped, which happens anyway; "
          "warns if there is none");
  table.add("fresh", &s.fresh)
      .help("start anew, and drop what an interrupted run has done");
  table.add("force", &s.force).help("write into a folder that holds other files");
  table.add("quiet", &s.quiet).help("print warnings and errors only");
  table.add("verbose", &s.verbose).help("print a line per scan");
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

/** The options that go into the summary; lengths go there as parameters. */
constexpr const char* kWords[] = {"first",
                                  "last",
                                  "every",
                                  "poses",
                                  "format",
                                  "deskew",
                                  "interpolation",
                                  "metric",
                                  "minimiser",
                                  "plane-minimiser",
                                  "search",
                                  "robust",
                                  "initial-guess",
                                  "metascan",
                                  "loop-closing",
                                  "relaxation",
                                  "links",
                                  "relaxation-rounds",
                                  "graph-in",
                                  "continue",
                                  "iterations",
                                  "min-overlap",
                                  "max-correction",
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
  std::vector<OptionWord> conditions = table.words(
      {"min-range", "max-range", "voxel", "max-distance", "max-distance-start"});
  for (const OptionWord& word : words)
    if (others.count(word.name) == 0)
      conditions.push_back(word);
  return conditions;
}
} // namespace

void
Settings::resolveGuess(bool has_poses)
{
  if (!auto_guess)
    return;
  slam.initial_guess = has_poses ? InitialGuess::kOdometry : InitialGuess::kFeatures;
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
parseSettings(const std::vector<std::string>& arguments, Settings& settings)
{
  OptionTable table(kUsageText);
  table.positional("SCAN_DIR", &settings.input);
  addInput(table, settings);
  addMatching(table, settings);
  addGraph(table, settings);
  addRun(table, settings);
  table.bringOptions("continue", optionsOfRun);
  if (!table.parse(arguments))
    return false;
  if (settings.out.empty())
    settings.out = settings.continued;
  if (settings.out.empty())
    throw UsageError("-o OUT_DIR is missing");
  checkOptions(
      [&] {
        settings.folder.validate();
        settings.slam.validate();
      },
      {{"max_iterations", "iterations"}});
  settings.slam.verify = !settings.no_verification;
  if (settings.resume && settings.fresh)
    throw UsageError("--resume and --fresh contradict each other");
  settings.words = table.words({std::begin(kWords), std::end(kWords)});
  settings.conditions = conditionsOf(settings.words, table);
  // Words have six digits; lengths are compared to the last bit by the tasks' names.
  for (const auto& [name, value] :
       {std::pair("min-overlap", settings.slam.min_overlap),
        std::pair("max-correction", settings.slam.max_correction)})
    settings.conditions.push_back({name, text::shortest(value), true});
  const bool planes = settings.slam.metric != Metric::kPoint;
  const bool relaxes = settings.slam.relaxation.has_value();
  settings.without_effect = table.withoutEffect(
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
