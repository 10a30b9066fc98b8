// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/icp_command_line.h"
#include "evaluate/verbs.h"

#include <pcl6d/registration/minimisers.h>

namespace po = boost::program_options;

namespace pcl6d::app {

namespace {
using Words = std::vector<std::string>;
using Raw = RawIcpSettings;

std::string
joined(const Words& words, const char* separator)
{
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : separator) + word;
  return text;
}

void
describeInput(CommandLine& line, Raw& raw)
{
  line.group("Input").add_options() //
      ("guess",
       po::value(&raw.guess)->value_name("\"X Y Z R P Y\""),
       "start: pose of B in the frame of A, [m] and roll pitch yaw [deg]; by default "
       "from "
       "the poses that belong to the files (*.pose, odometry.txt, poses.txt, PCD "
       "VIEWPOINT or identity, the first that is there)") //
      ("format", valueOf(raw.format), "auto|pcd|ply|uos|kitti|xyz");
  line.group("Range gate and reduction")
      .add_options()                                                                  //
      ("min-range", valueOf(raw.min_range), "[m] or auto: nearer points are dropped") //
      ("max-range",
       valueOf(raw.max_range),
       "[m] or auto: farther points are dropped; auto drops no-return codes") //
      ("voxel", valueOf(raw.voxel), "[m] or auto: edge length of the octree reduction");
}

/** \return an option that takes one of the names, or all, and may be repeated */
po::typed_value<Words>*
wordsOf(Words& words, const Words& standard)
{
  return po::value(&words)->value_name("NAME")->default_value(standard,
                                                              joined(standard, " "));
}

void
describeMethods(CommandLine& line, Raw& raw)
{
  line.group("Methods; each NAME may be repeated or all, the first is the standard one")
      .add_options()                                                                //
      ("metric", wordsOf(raw.metrics, {"all"}), joined(metricNames(), "|").c_str()) //
      ("minimiser",
       wordsOf(raw.minimisers, {"quaternion", "helix", "small-angle", "euler"}),
       ("of the metric point: " + joined(minimiserNames(), "|")).c_str()) //
      ("plane-minimiser",
       wordsOf(raw.plane_minimisers, {"helix", "linear"}),
       ("of the metrics plane and gicp: " + joined(planeMinimiserNames(), "|"))
           .c_str()) //
      ("search",
       wordsOf(raw.searches, {"cached", "kdtree", "approximate"}),
       (joined(searchMethodNames(), "|") + ": all but approximate are exact and give "
                                           "the same runs; brute-force takes hours "
                                           "on large scans")
           .c_str()) //
      ("all-combinations",
       po::bool_switch(&raw.all_combinations),
       "run every minimiser of every metric with every search; by default the "
       "minimisers "
       "run with the first search, and the searches with the first metric and "
       "minimiser");
}

void
describeMatching(CommandLine& line, IcpSettings& s, Raw& raw)
{
  line.group("Matching")
      .add_options() //
      ("max-distance",
       valueOf(raw.max_distance),
       "[m] or auto: largest pair distance") //
      ("max-distance-start",
       valueOf(raw.max_distance_start),
       "[m] or auto: largest pair distance of the first iteration, which then shrinks "
       "to "
       "--max-distance") //
      ("robust",
       valueOf(raw.robust),
       "none|huber|cauchy|geman-mcclure: weight of a pair by its residual") //
      ("iterations", valueOf(s.slam.max_iterations), "most iterations of one ICP");
}

void
describeGrid(CommandLine& line, IcpSettings& s, Raw& raw)
{
  line.group("Starts and judgement")
      .add_options() //
      ("offset-xy",
       valueOf(raw.offset_xy),
       "[m] or auto: starts reach so far in +-x and +-y; auto: 1.5 x "
       "--max-distance-start") //
      ("offset-yaw",
       valueOf(raw.offset_yaw),
       "[deg] or auto: and so far in +-yaw; auto: the angle that moves a point at the "
       "median range by --max-distance-start") //
      ("steps-xy",
       valueOf(s.basin.steps_xy),
       "values of x and of y, odd")                                   //
      ("steps-yaw", valueOf(s.basin.steps_yaw), "values of yaw, odd") //
      ("sigma-position",
       valueOf(raw.sigma_position),
       "[m] or auto: from the covariance of the best pose, voxel / 10 at least") //
      ("sigma-orientation",
       valueOf(raw.sigma_orientation),
       "[deg] or auto: from the covariance of the best pose; at least the angle that "
       "moves a point at the median range by voxel / 10");
}

void
describeRun(CommandLine& line, IcpSettings& s, Raw& raw)
{
  line.group("Run").add_options() //
      ("output,o",
       po::value(&s.out)->value_name("OUT_DIR"),
       "folder for icp.csv (a row per method), icp_runs.csv (a row per run), icp.json "
       "(start, best poses, sigma, parameters) and icp_basin_*.png; made if missing") //
      ("threads",
       valueOf(raw.threads),
       "0: one per core; never changes the result") //
      ("force",
       po::bool_switch(&s.force),
       "write into a folder that holds other files") //
      ("quiet", po::bool_switch(&s.quiet), "print the table, warnings and errors only");
}
} // namespace

std::string
icpUsage()
{
  return std::string("usage: ") + kEvaluate +
         " icp SCAN_A SCAN_B [options]\n"
         "The basin of convergence of ICP: registers scan B onto scan A from a grid "
         "of\n"
         "starts about the best pose, once for each method, and prints how often, how\n"
         "precisely, in how many iterations and how fast it finds back. Distances are "
         "in\n"
         "metres, angles of options in degrees, angles in files in radians.\n"
         "\n"
         "The best pose of a metric is where ICP comes to rest from the unperturbed "
         "start\n"
         "(first minimiser, exact search). A run is correct if it ends within 3 sigma "
         "of\n"
         "it, in position and in orientation. The table's errors, rms (of the pairs),\n"
         "iterations and ms (processor time on one thread, without the making of "
         "trees)\n"
         "are means of the correct runs; reach is how far every start is correct, "
         "shifted\n"
         "without a turn and turned without a shift.\n"
         "Exit code 3: a best pose is in doubt, because ICP fails from the unperturbed "
         "start\n"
         "or does not stay at the pose found (the metric then has no rows), or because "
         "the\n"
         "best poses of two metrics are far apart.\n";
}

void
describeIcp(CommandLine& line, IcpSettings& settings, RawIcpSettings& raw)
{
  describeInput(line, raw);
  describeMethods(line, raw);
  describeMatching(line, settings, raw);
  describeGrid(line, settings, raw);
  describeRun(line, settings, raw);
}

} // namespace pcl6d::app
