// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/progress_bar.h"
#include "evaluate/map_report.h"
#include "evaluate/result_file.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>

#include <cstdio>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;

struct MapSettings {
  MapSource source;
  MapQualityOptions options;
  double radius = 0;       ///< [m] if given
  double max_distance = 0; ///< [m] if given
  std::size_t rows = 10;
  std::string output; ///< .json or .csv, or empty
  bool quiet = false;
};

constexpr const char* kUsageText =
    " map RUN_DIR [options]\n"
    "How good a map is, without a reference path: how well its scans agree, how sharp\n"
    "walls are, and which scans stand out. RUN_DIR is the output of pcl_slam6d, or a\n"
    "folder of scans with poses. What the measures mean: share/doc/measures.md.\n";

void
addOptions(CommandLine& line, MapSettings& s)
{
  line.group("Map").add_options() //
      ("poses",
       po::value(&s.source.poses)->value_name("FILE"),
       "poses in place of its own, KITTI or TUM rows, one per scan") //
      ("reference",
       po::value(&s.source.reference)->value_name("CLOUD"),
       "measure distances to this cloud, too; in the world of the map") //
      ("min-range",
       valueOf(s.source.min_range),
       "[m] or auto: nearer points are left out") //
      ("max-range",
       valueOf(s.source.max_range),
       "[m] or auto: farther points are left out") //
      ("voxel",
       valueOf(s.source.voxel),
       "[m] or auto, as in pcl_slam6d: how densely the map is sampled; compare maps at "
       "the same voxel");
  line.group("Measures")
      .add_options() //
      ("radius",
       po::value(&s.radius)->value_name("M"),
       "[m] of the surroundings whose entropy is taken; default: 2 voxels") //
      ("max-distance",
       po::value(&s.max_distance)->value_name("M"),
       "[m] beyond which points do not belong together; default: 3 voxels") //
      ("outlier",
       valueOf(s.options.outlier),
       "robust z-score from which a scan stands out") //
      ("rows", valueOf(s.rows), "so many scans are listed, worst first");
  line.group("Run").add_options() //
      ("output,o",
       po::value(&s.output)->value_name("FILE"),
       "write all numbers (.json) or a row per scan (.csv)") //
      ("threads",
       valueOf(s.options.num_threads),
       "0: one per core; never changes the result") //
      ("quiet", po::bool_switch(&s.quiet), "show no progress");
}

bool
parse(const std::vector<std::string>& arguments, MapSettings& s)
{
  CommandLine line(std::string("usage: ") + kEvaluate + kUsageText);
  line.positional("RUN_DIR", &s.source.folder);
  addOptions(line, s);
  if (!line.parse(arguments))
    return false;
  if (line.given("radius"))
    s.options.radius = s.radius;
  if (line.given("max-distance"))
    s.options.max_distance = s.max_distance;
  checkOptions([&] { s.options.validate(); });
  checkOptions([&] { validateSource(s.source); });
  requireExtension("--output", s.output, {".json", ".csv"});
  refuseInput("--output", s.output, {s.source.poses, s.source.reference});
  return true;
}

MapQuality
measure(const MapSettings& s, const LoadedMap& map)
{
  ProgressBar bar(s.quiet);
  MapQualityOptions options = s.options;
  options.voxel = map.voxel;
  options.progress = [&](const Progress& progress) { bar.show(progress); };
  try {
    return measureMap(map.scans, map.poses, options, map.reference);
  } catch (const BadArgument& e) { // the options were checked before
    throw ComputeFailed(s.source.folder + ": " + e.what());
  }
}

void
write(const MapSettings& s, const MapReport& report)
{
  printTable(report, s.rows);
  flushOutput();
  if (s.output.empty())
    return;
  writeFileAtomically(s.output, [&](std::ostream& stream) {
    if (hasExtension(s.output, ".csv"))
      writeCsv(stream, report);
    else
      stream << toJson(report);
  });
}
} // namespace

int
runMap(const std::vector<std::string>& arguments)
{
  MapSettings s;
  if (!parse(arguments, s))
    return kDone;
  const LoadedMap map = loadMap(s.source, s.options.num_threads);
  MapReport report{s.source, map.names, map.pose_source, map.voxel, {}};
  report.quality = measure(s, map);
  write(s, report);
  return kDone;
}

} // namespace pcl6d::app
