// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/options/reduction_options.h"
#include "evaluate/icp/icp_settings.h"
#include "evaluate/pair_pose.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/registration/minimisers.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
using Words = std::vector<std::string>;

/** Names of methods on the command line; "all" is a name, too. */
struct Methods {
  Words metrics = {"all"};
  Words minimisers = {"quaternion", "helix", "small-angle", "euler"};
  Words plane_minimisers = {"helix", "linear"};
  Words searches = {"remembered", "cached-tree", "kdtree", "approximate"};
  bool all_combinations = false;
};

std::string
usageOfIcp()
{
  return std::string("usage: ") + kEvaluate +
         R"( icp SCAN_A SCAN_B [options]
The basin of convergence of ICP: registers scan B onto scan A from a grid of
starts about the best pose, once for each method, and prints how often, how
precisely, in how many iterations and how fast ICP returns. Distances are in
metres, angles of options in degrees, angles in files in radians.

The best pose of a metric is where ICP comes to rest from the unperturbed start
(first minimiser, exact search). A run is correct if it ends within 3 sigma of
the best pose, in position and in orientation. The table's errors, rms (of the pairs),
iterations and ms (processor time on one thread, without the making of trees)
are means of the correct runs; reach is how far every start is correct, shifted
without a turn and turned without a shift.
With --scale one factor is estimated, too, by which B must be enlarged to be as
large as A: for scans of two devices, or in different units.
Exit code 3: a best pose is in doubt, because ICP fails from the unperturbed start
or does not stay at the pose found (the metric then has no rows), or because the
best poses of two metrics are far apart.
)";
}

/** \return the names, with "all" replaced by the missing names; each once */
Words
expanded(const Words& given, const Words& all)
{
  Words names;
  const auto add = [&names](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  };
  for (const std::string& name : given)
    if (name == "all")
      std::for_each(all.begin(), all.end(), add);
    else
      add(name);
  return names;
}

template <typename Value>
std::vector<Value>
valuesOf(const Words& names, Value (*fromName)(const std::string&))
{
  std::vector<Value> values;
  std::transform(names.begin(), names.end(), std::back_inserter(values), fromName);
  return values;
}

void
addInput(OptionTable& table, IcpSettings& s)
{
  table.positional("SCAN_A", &s.scan_a);
  table.positional("SCAN_B", &s.scan_b);
  table.group("Input");
  const auto takeGuess = [&s](const auto& text) {
    s.guess = poseFromText("--guess", text);
  };
  table.addWord("guess \"X Y Z R P Y\"", "", takeGuess)
      .help("start: pose of B in the frame of A, [m] and roll pitch yaw [deg]; by "
            "default from the poses of the files (*.pose, odometry.txt, poses.txt, PCD "
            "VIEWPOINT or identity, the first found)");
  table.add("format", &s.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|kitti|xyz|las|laz");
  table.group("Range gate and reduction");
  addReductionOptions(table, s.slam);
}

void
addMethods(OptionTable& table, Methods& methods, bool& estimate_scale)
{
  table.group(
      "Methods; each NAME may be repeated, or 'all'; the first is the standard");
  table.add("metric NAME", &methods.metrics).help(joined(metricNames()));
  table.add("minimiser NAME", &methods.minimisers)
      .help("of the metric point: " + joined(minimiserNames()));
  table.add("plane-minimiser NAME", &methods.plane_minimisers)
      .help("of the metrics plane and gicp: " + joined(planeMinimiserNames()));
  table.add("search NAME", &methods.searches)
      .help(joined(searchMethodNames()) +
            ": every method except approximate is exact, with equal runs; brute-force "
            "takes hours on large scans");
  table.add("scale", &estimate_scale)
      .help("estimate the scale of B and apply it, by --metric point and --minimiser " +
            std::string(kScaleMinimiser) + "; at most a factor of 2");
  table.add("all-combinations", &methods.all_combinations)
      .help("run every minimiser of every metric with every search; by default the "
            "minimisers run with the first search, and the searches with the first "
            "metric and minimiser");
}

void
addMatching(OptionTable& table, IcpSettings& s)
{
  OptionList matching; // shared with pcl_slam6d
  Slam6DParameters unused;
  describe(static_cast<MatchingOptions&>(s.slam), unused, matching);
  table.group("Matching");
  addOption(table, matching.of(&s.slam.max_distance));
  addOption(table, matching.of(&s.slam.max_distance_start));
  table.add("robust", &s.basin.icp.robust, robustKernelFromName)
      .help("none|huber|cauchy|geman-mcclure: weight of a pair by its residual");
  table.add("iterations", &s.slam.max_iterations).help("most iterations of an ICP");
  table.group("Starts and criteria");
  table.addAuto("offset-xy", &s.offset_xy)
      .help("[m] or auto: largest shift of the starts in +-x and +-y; auto: 1.5 x "
            "--max-distance-start");
  table.addAuto("offset-yaw", &s.offset_yaw, kDegree)
      .above(0, "in (0, 180] degrees", 180)
      .help("[deg] or auto: largest turn of the starts in +-yaw; auto: the angle that "
            "moves a point at the median range by --max-distance-start");
  table.add("steps-xy", &s.basin.steps_xy).help("values of x and of y, odd");
  table.add("steps-yaw", &s.basin.steps_yaw).help("values of yaw, odd");
  table.addAuto("sigma-position", &s.basin.sigma_position)
      .help("[m] or auto: from the covariance of the best pose, voxel / 10 at least");
  table.addAuto("sigma-orientation", &s.basin.sigma_orientation, kDegree)
      .above(0, "finite and > 0 degrees", kFinite)
      .help("[deg] or auto: from the covariance of the best pose; at least the angle "
            "that moves a point at the median range by voxel / 10");
}

void
addRun(OptionTable& table, IcpSettings& s)
{
  table.group("Run");
  table.add("output,o OUT_DIR", &s.out)
      .help("folder for icp.csv (a row per method), icp_runs.csv (a row per run), "
            "icp.json (start, best poses, sigma, parameters) and icp_basin_*.png; made "
            "if missing");
  table.addAs<int>("threads", &s.basin.num_threads)
      .within(0, 1024, "in [0, 1024]")
      .help("0: a thread per core; never changes the result");
  table.add("force", &s.force).help("write into a folder that is not empty");
  table.add("quiet", &s.quiet).help("print the table, warnings and errors only");
}

void
interpretMethods(const Methods& typed, IcpSettings& s)
{
  s.methods.metrics = valuesOf(expanded(typed.metrics, metricNames()), metricFromName);
  s.methods.minimisers = expanded(typed.minimisers, minimiserNames());
  s.methods.plane_minimisers = expanded(typed.plane_minimisers, planeMinimiserNames());
  s.methods.searches =
      valuesOf(expanded(typed.searches, searchMethodNames()), searchMethodFromName);
  s.combination =
      typed.all_combinations ? IcpCombination::kAll : IcpCombination::kOneByOne;
  for (const auto& name : s.methods.minimisers) // also minimisers that no metric uses
    minimiserFromName(name);
  for (const auto& name : s.methods.plane_minimisers)
    planeMinimiserFromName(name);
}

/** --scale selects the only methods with a scale. \throws UsageError other methods were
 * given */
void
takeScale(const OptionTable& table, const IcpSettings& s, Methods& typed)
{
  if (!s.basin.icp.estimate_scale)
    return;
  const auto bring = [&](const char* option, Words& words, const Words& only) {
    if (table.given(option) && expanded(words, {"all"}) != only)
      throw UsageError(std::string("--scale is estimated by --") + option + " " +
                       only.front() + " alone, not by " + joined(words, ", "));
    words = only;
  };
  bring("metric", typed.metrics, {toString(Metric::kPoint)});
  bring("minimiser", typed.minimisers, {kScaleMinimiser});
}

std::string
withoutEffect(const OptionTable& table, const IcpSettings& s)
{
  const auto& metrics = s.methods.metrics;
  const auto points = std::count(metrics.begin(), metrics.end(), Metric::kPoint);
  const bool planes = points < static_cast<std::ptrdiff_t>(metrics.size());
  return table.withoutEffect(
      {{"minimiser", points > 0, "of the metric point"},
       {"plane-minimiser", planes, "of the metrics plane and gicp"},
       {"offset-xy", s.basin.steps_xy > 1, "with --steps-xy 3 or more"},
       {"offset-yaw", s.basin.steps_yaw > 1, "with --steps-yaw 3 or more"},
       {"force", !s.out.empty(), "with --output"}});
}
} // namespace

bool
parseIcpSettings(const std::vector<std::string>& arguments, IcpSettings& s)
{
  OptionTable table(usageOfIcp());
  Methods methods;
  addInput(table, s);
  addMethods(table, methods, s.basin.icp.estimate_scale);
  addMatching(table, s);
  addRun(table, s);
  if (!table.parse(arguments))
    return false;
  takeScale(table, s, methods);
  s.basin.offset_xy = s.offset_xy.value_or(s.basin.offset_xy);
  table.check(
      [&] {
        interpretMethods(methods, s);
        s.slam.validate();
        s.basin.validate();
      },
      {{"max_iterations", "iterations"}});
  s.without_effect = withoutEffect(table, s);
  return true;
}

} // namespace pcl6d::app
