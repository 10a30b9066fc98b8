// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/option_table.h"
#include "common/reduction_options.h"
#include "slam6d/option_groups.h"
#include "slam6d/plugin_words.h"

#include <pcl6d/common/error.h>

#include <sstream>

namespace pcl6d::app {

namespace {
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

/** What takes the word of an option that plug-ins may add words to. */
using TakeWord = void (*)(Settings&, const std::string&);

Option&
addOpen(OptionTable& table,
        Settings& s,
        const std::string& name,
        const std::string& usual,
        TakeWord take)
{
  return table.addWord(
      name, usual, [&s, take](const std::string& word) { take(s, word); });
}

void
takeDeskew(Settings& s, const std::string& word)
{
  if (word == "no")
    s.deskew = Deskew::kNone;
  else if (word == "yes" || word == "odometry")
    s.deskew = Deskew::kOdometry;
  else if (word == "estimate")
    s.deskew = Deskew::kEstimate;
  else
    throw BadArgument("deskew = " + word +
                      ", but must be odometry, estimate, yes or no");
}

void
addInput(OptionTable& table, Settings& s, bool& joins)
{
  table.group("Input");
  table.add("plugin FILE", &s.plugin_files)
      .composing()
      .otherwise("none")
      .help("a shared library that adds words to --format, --filter, --minimiser, "
            "--plane-minimiser and --search (share/doc/plugins.md); its code runs with "
            "your rights; once for each file");
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
  addOpen(table, s, "format", toString(s.folder.format), takeFormat)
      .help("auto|pcd|ply|uos|kitti|xyz, or one of a plug-in");
  table
      .addWord(
          "deskew WORD", "no", [&s](const std::string& word) { takeDeskew(s, word); })
      .implied("yes")
      .help("scans were taken while moving: correct each point by its time (field t or "
            "time). odometry, or no word: along the initial poses; needs their time "
            "stamps (times.txt, or TUM rows). estimate: by the motion that the scans "
            "show "
            "themselves; needs neither");
  table.add("interpolation", &s.interpolation, motionInterpolationFromName, "linear")
      .help("linear|cubic: how --deskew moves between two poses; cubic follows bends "
            "better");
  table.addAuto("knots SECONDS", &s.slam.motion.knots)
      .above(0, "> 0 s", kFinite)
      .help("[s] or auto: of --deskew estimate, a pose every so many seconds of a "
            "scan; auto: a "
            "third of a second, or one at its begin and one at its end if it is "
            "shorter than half a "
            "second");
  table.add("continue RUN_DIR", &s.continued)
      .help("goes on with a finished run: its scans keep their place and its options "
            "count unless given anew; taken are the files of SCAN_DIR whose names it "
            "lacks; -o is RUN_DIR by default");
  table.add("join", &joins)
      .help(
          "the arguments are two finished runs of one site, RUN_A RUN_B (or more), in "
          "place of SCAN_DIR: they become one, in the world of RUN_A, relaxed "
          "together; their poses need have nothing in common");
}

void
addMethods(OptionTable& table, Settings& s)
{
  table.group("Matching");
  table.add("metric", &s.slam.metric, metricFromName)
      .help(joined(metricNames()) +
            ": distance between points, of points to planes, of planes");
  addOpen(table, s, "minimiser", "quaternion", takeMinimiser)
      .help(joined(minimisersOfMotion()) + ", of the metric point");
  addOpen(table, s, "plane-minimiser", "helix", takePlaneMinimiser)
      .help(joined(planeMinimiserNames()) + ", of the metrics plane and gicp");
  addOpen(table, s, "search", toString(s.slam.search), takeSearch)
      .help(joined(searchMethodNames()) +
            ": how closest points are found; all but approximate give the same result, "
            "flann up to which of equally near points it takes");
  table.add("robust", &s.slam.robust, robustKernelFromName)
      .help(joined(robustKernelNames()) + ": less weight for pairs that are far apart");
  const auto takeGuess = [&s](const std::string& word) {
    s.auto_guess = word == "auto";
    if (!s.auto_guess)
      s.slam.initial_guess = initialGuessFromName(word);
  };
  table.addWord("initial-guess", "auto", takeGuess)
      .help("auto|" + joined(initialGuessNames()) +
            ": where matching starts; auto: odometry, global if there are no poses: "
            "scans in any "
            "order, all looked at together");
}

void
addMatching(OptionTable& table, Settings& s)
{
  table.group("Filters and reduction");
  addOpen(table, s, "filter", toString(s.filter), takeFilter)
      .help(joined(lineFilterNames()) +
            ": along the lines of organized scans; the median moves mixed pixels at "
            "edges, the reduction merges points closer than 0.1 m on a line");
  addReductionOptions(table, s.slam);
  table.add("reduction", &s.slam.reduction, reductionMethodFromName)
      .help(joined(reductionMethodNames()) +
            ": what stands for the points of a voxel: their mean, its centre, or "
            "--reduction-points of them chosen at random");
  table.add("reduction-points N", &s.slam.reduction_points)
      .help("points of a voxel, of --reduction random");
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
  table.add("no-recovery", &s.no_recovery)
      .help(
          "scans that cannot be matched keep their predicted pose, and are not looked "
          "for elsewhere");
}

void
addLoopOptions(OptionTable& table, Settings& s)
{
  table.addAuto("loop-distance", &s.slam.loop_distance)
      .help("[m] or auto: between the positions of scans that may close a loop");
  table.addAuto("loop-gap", &s.slam.loop_gap)
      .help("or auto: scans between the ends of a loop");
  table.addAuto("loop-pairs", &s.slam.loop_pairs)
      .help("or auto: pairs of points that a loop needs");
  table.add("loop-gate", &s.slam.loop_gate)
      .help("largest squared Mahalanobis distance between the ends of a loop, by the "
            "covariances of the matches; 11.3 leaves out one true loop in a hundred, "
            "inf: "
            "none");
}

void
addGraph(OptionTable& table, Settings& s)
{
  table.group("Loops and graph");
  table.add("loop-closing", &s.slam.loop_closing, loopClosingFromName)
      .help(joined(loopClosingNames()) +
            ": how the error of a loop that is found is spread; none: no search");
  table
      .addWord("close-loops",
               "after",
               [&s](const std::string& word) {
                 if (word != "after" && word != "online")
                   throw BadArgument("close-loops = " + word +
                                     ", but must be after or online");
                 s.slam.close_loops_online = word == "online";
               })
      .help("after|online: loops are closed when all scans are matched, or each before "
            "the "
            "next scan is matched");
  addLoopOptions(table, s);
  const std::string usual = toString(*s.slam.relaxation);
  const auto takeRelaxation = [&s](const std::string& word) {
    s.slam.simultaneous = word == "simultaneous";
    s.slam.relaxation = word == "none" || s.slam.simultaneous
                            ? std::nullopt
                            : std::make_optional(relaxationFromName(word));
  };
  table.addWord("relaxation", usual, takeRelaxation)
      .help(
          joined(relaxationNames()) +
          "|none: how all scans are moved at once after matching, or simultaneous: one "
          "after the other, until none moves; undone if the map gets worse");
  table.add("links", &s.slam.links, linkRuleFromName)
      .help(joined(linkRuleNames()) +
            ": which scans are linked, those that see the same places or those within "
            "--link-distance");
  table.addAuto("link-distance", &s.slam.link_distance)
      .help("[m] or auto: of --links distance");
  table.add("link-hysteresis", &s.slam.link_hysteresis)
      .help(
          "share by which a link may fall short of what made it before it is dropped");
  table.add("link-weights", &s.slam.link_weights, linkWeightsFromName)
      .help(joined(linkWeightsNames()) +
            ": how links count while relaxing: all alike, by their pairs, or by the "
            "covariance that their pairs give");
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
  table.add("moving", &s.moving, movingFromName, "label")
      .help(
          "keep|label|remove: points that moved while scans were taken, as other "
          "scans saw through their places; label: field dynamic (0 or 1) in scans/, "
          "and they are not in the map; remove: in neither; keep: nobody asks. Unless "
          "kept they take no part in planes, nor in the last round of relaxation where "
          "they may pull a scan");
  table.add("report", &s.report)
      .help("write report.html: verdict, map, plots and tables on one page for a "
            "browser");
  table.add("no-picture", &s.no_picture)
      .help("do not draw top_view.png, which takes a second");
  table.add("no-verification", &s.no_verification)
      .help("do not judge the map by the points and rays of its scans in the end");
  table.addAs<std::int64_t>("seed", &s.slam.seed)
      .within(0, kNoBound, ">= 0")
      .help("of random choices (those of --initial-guess features and --reduction "
            "random)");
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
  table.add("timing", &s.timing)
      .help("print in the end where the time went, as summary.json has it");
}
} // namespace

void
refuseScale(const std::vector<std::string>& arguments)
{
  for (const std::string& word : arguments)
    if (word == "--scale" || word.rfind("--scale=", 0) == 0)
      throw UsageError(std::string("--scale: ") + kOneScale);
}

void
addOptions(OptionTable& table, Settings& settings, bool& joins)
{
  addInput(table, settings, joins);
  addMatching(table, settings);
  addGraph(table, settings);
  addRun(table, settings);
}

} // namespace pcl6d::app
