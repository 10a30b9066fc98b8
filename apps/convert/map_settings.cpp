// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "convert/map_settings.h"
#include "convert/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>
#include <pcl6d/maps/grid_map.h>

#include <cmath>
#include <filesystem>
#include <utility>

namespace pcl6d::app {

namespace {
constexpr double kCoarsest = 100; ///< [m] a larger cell is a typing error

constexpr const char* kMapUsage =
    R"( map RUN -o FILE [options]
Writes a finished run of pcl_slam6d as a map for planners of robots: an octree of
OctoMap (FILE .bt or .ot), a grid map of ROS (.yaml, with its .pgm), a GeoTIFF of
heights (.tif), or as the trajectory in a recording of ROS 2 (.mcap, topics /odom and
/tf). Space is free where rays of the scans passed. Dynamic points, scans that could
not be registered and points outside the ranges of the run are left out. Coordinates
are relative to the world offset of the run; a GeoTIFF has full coordinates.
)";

MapKind
kindOf(const std::string& output)
{
  static const std::vector<std::pair<std::string, MapKind>> kinds = {
      {".bt", MapKind::kOctree},
      {".ot", MapKind::kOctree},
      {".yaml", MapKind::kGrid},
      {".tif", MapKind::kHeights},
      {".tiff", MapKind::kHeights},
      {".mcap", MapKind::kTrajectory}};
  const std::string extension = std::filesystem::path(output).extension().string();
  for (const auto& [name, kind] : kinds)
    if (name == extension)
      return kind;
  throw UsageError("--output = " + output +
                   ", but the extension must be .bt or .ot (OctoMap), .yaml (grid map "
                   "of ROS), .tif (heights, GeoTIFF) or .mcap (trajectory)");
}

/** \return the heights of "0.2,1.8" */
HeightRange
heightsFromText(const std::string& words)
{
  const std::size_t comma = words.find(',');
  HeightRange heights;
  if (comma == std::string::npos ||
      !text::parseNumber(std::string_view(words).substr(0, comma), heights.from) ||
      !text::parseNumber(std::string_view(words).substr(comma + 1), heights.to))
    throw BadArgument("heights = " + text::quoted(words) +
                      ", but must be two numbers with a comma, for example 0.2,1.8");
  GridMapOptions options;
  options.from = heights.from;
  options.to = heights.to;
  try {
    options.validate();
  } catch (const BadArgument&) {
    throw BadArgument("heights = " + text::quoted(words) +
                      ", but must be finite, and the first smaller than the second");
  }
  return heights;
}
} // namespace

bool
parseMapSettings(const std::vector<std::string>& arguments, MapSettings& s)
{
  OptionTable table(std::string("usage: ") + kConvert + kMapUsage);
  table.positional("RUN", &s.run);
  table.group("Output");
  table.add("output,o FILE", &s.output)
      .required()
      .help(".bt|.ot|.yaml|.tif|.mcap: format of the map");
  table.add("force", &s.force).help("overwrite an existing file");
  table.group("Map");
  table.addAuto("resolution", &s.resolution)
      .above(0, "> 0 and at most 100", kCoarsest)
      .help("[m] edge of a voxel or cell; auto: the voxel of the run or, if larger, "
            "the line spacing of the scans, rounded up to 0.05, 0.1, 0.2, 0.5, 1, ...; "
            "larger where the memory is too small");
  table.add("max-range", &s.max_range)
      .above(0, "> 0")
      .help("[m] rays end here, without a hit");
  table
      .addWord("heights FROM,TO",
               "auto",
               [&s](const std::string& words) {
                 if (words != "auto")
                   s.heights = heightsFromText(words);
               })
      .help("[m] heights above the floor of the obstacles in a grid map; auto: 0.2 to "
            "2, or to the height of the scanner, if larger");
  table.group("Run");
  s.memory.addTo(table);
  table.add("quiet", &s.quiet).help("print warnings and errors only");
  if (!table.parse(arguments))
    return false;
  s.kind = kindOf(s.output);
  refuseInputs(s.output, {s.run}, "the input");
  const bool has_rays = s.kind == MapKind::kOctree || s.kind == MapKind::kGrid;
  s.without_effect =
      table.withoutEffect({{"resolution", s.kind != MapKind::kTrajectory, "of maps"},
                           {"max-range", has_rays, "of .bt, .ot and .yaml"},
                           {"heights", s.kind == MapKind::kGrid, "of .yaml"}});
  return true;
}

} // namespace pcl6d::app
