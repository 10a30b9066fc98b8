// SPDX-License-Identifier: BSD-3-Clause
#include "option_words.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/option_spec.h>
#include <pcl6d/registration/minimisers.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <algorithm>
#include <sstream>

namespace pcl6d {

namespace {
constexpr char kMetascan[] = "metascan";

int
metascanFromText(const std::string& text)
{
  if (text == "all")
    return 0;
  std::istringstream stream(text);
  int count = 0;
  if (!(stream >> count) || !stream.eof() || count < 1)
    throw BadArgument("--" + std::string(kMetascan) + " " + text +
                      ": expected a number >= 1 or all");
  return count;
}

void
describeMethods(MatchingOptions& o, OptionList& list)
{
  list.addChoice("metric", o.metric, metricFromName)
      .withHelp(slam6d::withBars(metricNames()) +
                ": distance between points, of points to planes, of planes");
  list.addWord("minimiser",
               o.minimiser,
               [&o](const std::string& word) { o.minimiser = minimiserFromName(word); })
      .withDefault("quaternion")
      .countsIf([&o] { return o.metric == Metric::kPoint; }, "of the metric point")
      .withHelp(slam6d::withBars(minimisersOfMotion()) + ", of the metric point");
  list.addWord("plane-minimiser",
               o.plane_minimiser,
               [&o](const std::string& word) {
                 o.plane_minimiser = planeMinimiserFromName(word);
               })
      .withDefault("helix")
      .countsIf([&o] { return o.metric != Metric::kPoint; },
                "of the metrics plane and gicp")
      .withHelp(slam6d::withBars(planeMinimiserNames()) +
                ", of the metrics plane and gicp");
  list.addChoice("search", o.search, searchMethodFromName)
      .withHelp(slam6d::withBars(searchMethodNames()) +
                ": search for closest points; every method except approximate is "
                "exact, and flann may choose a different point at equal distance");
  list.addChoice("robust", o.robust, robustKernelFromName)
      .withHelp(slam6d::withBars(robustKernelNames()) +
                ": less weight for pairs far apart");
  list.addChoice("initial-guess", o.initial_guess, initialGuessFromName)
      .withHelp("auto|" + slam6d::withBars(initialGuessNames()) +
                ": where matching starts; auto: odometry; without poses the scans in "
                "file order, then global: every scan against every scan, in any order");
  list.addField("order_first", o.order_first)
      .withHelp("without poses the order of the scans is tried before global; set by "
                "initial-guess auto");
}

void
describeLimits(MatchingOptions& o, Slam6DParameters& used, OptionList& list)
{
  list.add("max-distance", o.max_distance)
      .inUnit("m")
      .within(finiteAbove0())
      .derivedAs("1.7 voxels; 2 voxels with --metric point", used.max_distance)
      .withHelp("[m] or auto: largest pair distance");
  list.add("max-distance-start", o.max_distance_start)
      .inUnit("m")
      .within(finiteFrom0())
      .derivedAs("12 voxels, at least --max-distance; 0: off", used.max_distance_start)
      .withHelp("[m] or auto: largest pair distance of the first iteration, shrinking "
                "to --max-distance");
  list.addWord(std::string(kMetascan) + " N|all",
               o.metascan,
               [&o](const std::string& word) { o.metascan = metascanFromText(word); })
      .withDefault("all")
      .withHelp("match against the union of the last N scans; 1 is pairwise");
  list.add("iterations", o.max_iterations)
      .calledField("max_iterations")
      .within(above0())
      .withHelp("most iterations of an ICP; a scan that needs more is not converged");
  list.addField("translation_epsilon", o.translation_epsilon)
      .inUnit("m")
      .within(from0())
      .ifNotGiven("a thousandth of the voxel")
      .withHelp("ICP stops at a smaller step ...");
  list.addField("rotation_epsilon", o.rotation_epsilon)
      .inUnit("rad")
      .within(from0())
      .withHelp("... that also turns less");
  list.add("min-overlap", o.min_overlap)
      .within({0, 1, true, true, false, "in [0, 1]"})
      .withHelp("least share of points with a partner; a match below is rejected");
  list.add("max-correction", o.max_correction)
      .within(from0())
      .withHelp("share of the odometry's step by which a match may move a scan; larger "
                "moves are rejected (inf: never). 1.5 x max-distance is always "
                "allowed; not applied to --initial-guess overlap and features");
}
} // namespace

std::vector<std::string>
minimisersOfMotion()
{
  std::vector<std::string> names = minimiserNames();
  names.erase(std::remove(names.begin(), names.end(), kScaleMinimiser), names.end());
  return names;
}

void
describe(MatchingOptions& o, Slam6DParameters& used, OptionList& list)
{
  list.stage(OptionStage::kMatching);
  list.group("Matching");
  describeMethods(o, list);
  list.group("Limits of matching");
  describeLimits(o, used, list);
}

} // namespace pcl6d
