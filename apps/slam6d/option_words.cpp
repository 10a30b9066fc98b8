// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/option_words.h"

#include <pcl6d/registration/minimisers.h>

namespace po = boost::program_options;

namespace pcl6d::app {

namespace {
void
describeInput(CommandLine& line, Settings& s, OptionWords& raw)
{
  line.group("Input").add_options()(
      "first",
      valueOf(s.folder.first),
      "index of the first scan to take, in the order of the folder")(
      "last",
      po::value(&raw.last),
      "index of the last scan to take (default: the end)")(
      "every", valueOf(s.folder.every), "take each n-th scan")(
      "poses",
      po::value<std::string>()->value_name("FILE")->notifier(
          [&s](const std::string& file) { s.folder.poses_file = file; }),
      "initial poses, KITTI or TUM rows, one per scan of the folder (default: *.pose, "
      "odometry.txt, poses.txt, PCD VIEWPOINT or identity, the first that is there)")(
      "format", valueOf(raw.format), "auto|pcd|ply|uos|kitti|xyz")(
      "deskew",
      po::bool_switch(&s.deskew),
      "scans were taken while moving: correct each point by its time (field t or time) "
      "along the initial poses; needs their time stamps (times.txt, or TUM rows)")(
      "interpolation",
      valueOf(raw.interpolation),
      "linear|cubic: how --deskew moves between two poses; cubic follows bends better")(
      "continue",
      po::value(&s.continued)->value_name("RUN_DIR"),
      "goes on with a finished run: its scans keep their place and its options count "
      "unless given anew; taken are the files of SCAN_DIR whose names it lacks; -o is "
      "RUN_DIR by default");
}

std::string
joined(const std::vector<std::string>& names)
{
  std::string text;
  for (const auto& name : names)
    text += (text.empty() ? "" : "|") + name;
  return text;
}

void
describeMetric(CommandLine& line, OptionWords& raw)
{
  line.group("Matching")
      .add_options()("metric",
                     valueOf(raw.metric),
                     (joined(metricNames()) +
                      ": distance between points, of points to planes, of planes")
                         .c_str())(
          "minimiser",
          valueOf(raw.minimiser),
          (joined(minimiserNames()) + ", of the metric point").c_str())(
          "plane-minimiser",
          valueOf(raw.plane_minimiser),
          (joined(planeMinimiserNames()) + ", of the metrics plane and gicp").c_str())(
          "search",
          valueOf(raw.search),
          (joined(searchMethodNames()) + ": how closest points are found; all but "
                                         "approximate give the same result")
              .c_str())(
          "robust",
          valueOf(raw.robust),
          (joined(robustKernelNames()) + ": less weight for pairs that are far apart")
              .c_str())(
          "initial-guess",
          valueOf(raw.initial_guess),
          ("auto|" + joined(initialGuessNames()) +
           ": where matching starts; auto: odometry, features if there are no poses")
              .c_str());
}

void
describeMatching(CommandLine& line, Settings& s, OptionWords& raw)
{
  line.group("Range gate and reduction")
      .add_options()("min-range",
                     valueOf(raw.min_range),
                     "[m] or auto: nearer points are dropped")(
          "max-range",
          valueOf(raw.max_range),
          "[m] or auto: farther points are dropped; auto drops no-return codes")(
          "voxel",
          valueOf(raw.voxel),
          "[m] or auto: edge length of the octree reduction");
  describeMetric(line, raw);
  line.group("Limits of matching")
      .add_options()("max-distance",
                     valueOf(raw.max_distance),
                     "[m] or auto: largest pair distance")(
          "max-distance-start",
          valueOf(raw.max_distance_start),
          "[m] or auto: largest pair distance of the first iteration, which then "
          "shrinks to "
          "--max-distance")(
          "metascan",
          po::value(&raw.metascan)->value_name("N|all")->default_value("all"),
          "match against the union of the last N scans; 1 is pairwise")(
          "iterations",
          valueOf(s.slam.max_iterations),
          "most iterations of one ICP; a scan that needs more is not converged")(
          "min-overlap",
          valueOf(s.slam.min_overlap),
          "share of points with a partner below which a match is not believed") //
      ("max-correction",
       valueOf(s.slam.max_correction),
       "share of the odometry's step by which a match may move a scan; beyond, it is "
       "not believed (inf: always). 1.5 x max-distance is always allowed; not applied "
       "to "
       "--initial-guess overlap and features");
}

void
describeGraph(CommandLine& line, Settings& s, OptionWords& raw)
{
  line.group("Loops and graph")
      .add_options()(
          "loop-closing",
          valueOf(raw.loop_closing),
          (joined(loopClosingNames()) +
           ": how the error of a loop that is found is spread; none: no search")
              .c_str())(
          "relaxation",
          valueOf(raw.relaxation),
          (joined(relaxationNames()) +
           "|none: how all scans are moved at once after matching; undone if the map "
           "gets worse")
              .c_str())("links",
                        valueOf(raw.links),
                        (joined(linkRuleNames()) +
                         ": which scans are linked, those that see the same places or "
                         "those within 7.5 m")
                            .c_str())("relaxation-rounds",
                                      valueOf(s.slam.relaxation_rounds),
                                      "most rounds, with links and pairs anew in each")(
          "graph-in",
          po::value(&s.graph_in)->value_name("FILE"),
          "links to look at besides those found: .g2o, or lines 'a b' with the indices "
          "of two scans; each counts as far as the others confirm it");
}

void
describeRun(CommandLine& line, Settings& s, OptionWords& raw)
{
  line.group("Run").add_options()("output,o",
                                  po::value(&s.out)->value_name("OUT_DIR"),
                                  "folder to write; made if missing")(
      "threads",
      po::value(&raw.threads)->default_value(0),
      "0: one per core; never changes the result")(
      "planes",
      po::bool_switch(&s.planes),
      "find the planes of the map and say what they are: planes.json, planes.pcd, "
      "hulls.ply and a picture (more choice: pcl_slam6d_planes OUT_DIR)")(
      "report",
      po::bool_switch(&s.report),
      "write report.html: verdict, map, plots and tables on one page for a browser")(
      "seed", valueOf(s.seed), "of random choices (those of --initial-guess features)")(
      "live-view",
      po::bool_switch(&s.live_view),
      "show the map in a window while it grows, and at the end until that is closed; "
      "without a display the run goes on without")(
      "force", po::bool_switch(&s.force), "write into a folder that holds other files")(
      "quiet", po::bool_switch(&s.quiet), "print warnings and errors only")(
      "verbose", po::bool_switch(&s.verbose), "print a line per scan");
}
} // namespace

void
describeOptions(CommandLine& line, Settings& settings, OptionWords& words)
{
  describeInput(line, settings, words);
  describeMatching(line, settings, words);
  describeGraph(line, settings, words);
  describeRun(line, settings, words);
}

} // namespace pcl6d::app
