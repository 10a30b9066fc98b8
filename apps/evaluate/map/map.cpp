// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/progress_bar.h"
#include "evaluate/map/map_report.h"
#include "evaluate/result_file.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>

#include <cstdio>

namespace pcl6d::app {

namespace {
struct MapSettings {
  MapSource source;
  MapQualityOptions options;
  std::size_t rows = 10;
  std::string output; ///< .json or .csv, or empty
  bool quiet = false;
};

constexpr const char* kMapUsage =
    R"( map RUN_DIR [options]
How good a map is, without a reference path: how well its scans agree, how sharp
walls are, and which scans stand out. RUN_DIR is the output of pcl_slam6d, or a
folder of scans with poses. What the measures mean: share/doc/measures.md.
)";

void
addOptions(OptionTable& table, MapSettings& s)
{
  table.positional("RUN_DIR", &s.source.folder);
  table.group("Map");
  table.add("poses FILE", &s.source.poses)
      .help("poses in place of the given poses, KITTI or TUM rows, a row per scan");
  table.add("reference CLOUD", &s.source.reference)
      .help("measure distances to this cloud, too; in the world of the map");
  table.addAuto("min-range", &s.source.min_range)
      .help("[m] or auto: nearer points are left out");
  table.addAuto("max-range", &s.source.max_range)
      .help("[m] or auto: farther points are left out");
  table.addAuto("voxel", &s.source.voxel)
      .help("[m] or auto (rule of pcl_slam6d): sampling of the map; compare maps at "
            "equal voxels");
  table.group("Measures");
  table.add("radius M", &s.options.radius)
      .help("[m] of the neighbourhood for the entropy; default: 2 voxels");
  table.add("max-distance M", &s.options.max_distance)
      .help("[m] beyond which points do not belong together; default: 3 voxels");
  table.add("outlier", &s.options.outlier)
      .help("robust z-score from which a scan stands out");
  table.add("rows", &s.rows).help("number of scans listed, worst first");
  table.group("Run");
  table.add("output,o FILE", &s.output)
      .help("write every number (.json) or a row per scan (.csv)");
  table.add("threads", &s.options.num_threads)
      .help("0: a thread per core; never changes the result");
  table.add("quiet", &s.quiet).help("show no progress");
}

bool
parse(const std::vector<std::string>& arguments, MapSettings& s)
{
  OptionTable table(std::string("usage: ") + kEvaluate + kMapUsage);
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  table.check([&] { s.options.validate(); });
  table.check([&] { validateSource(s.source); });
  requireResultFile("--output", s.output, {".json", ".csv"});
  refuseInputs(s.output, {s.source.folder, s.source.poses, s.source.reference});
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
