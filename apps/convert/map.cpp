// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "convert/map_settings.h"
#include "convert/scan_settings.h"
#include "convert/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/maps/grid_map.h>
#include <pcl6d/maps/height_map.h>
#include <pcl6d/maps/map_scans.h>
#include <pcl6d/maps/octree_map.h>
#include <pcl6d/sources/coordinate_system.h>
#include <pcl6d/sources/trajectory_bag.h>

#include <algorithm>
#include <functional>
#include <iostream>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

constexpr double kCoarsestVoxel = 10; ///< [m] larger voxels are of no use to a planner

/** \throws IoFailed a file of the output exists and may not be replaced, or cannot be written */
void
claimOutput(const MapSettings& s)
{
  std::vector<fs::path> files = {s.output};
  if (s.kind == MapKind::kGrid)
    files.push_back(GridMap::imageOf(s.output));
  for (const fs::path& file : files) {
    requireWritable(file);
    if (!s.force && text::isThere(file) && !isStream(file))
      text::fail(file, "exists; --force overwrites the file");
  }
}

/** \brief Makes a map of a run, scan by scan. */
class MapJob {
public:
  MapJob(const MapSettings& settings, std::size_t memory)
  : s_(settings), memory_(memory), bar_(settings.quiet), scans_(settings.run)
  {
    if (!s_.without_effect.empty())
      bar_.warn(s_.without_effect);
    if (scans_.leftOut() > 0)
      bar_.warn(text::counted(scans_.leftOut(), "scan") +
                " left out: not registered, or disconnected from the first scan");
  }

  int
  run()
  try {
    switch (s_.kind) {
    case MapKind::kOctree:
      return writeOctree();
    case MapKind::kGrid:
      return writeGrid();
    case MapKind::kHeights:
      return writeHeights();
    case MapKind::kTrajectory:
      return writeRecording();
    }
    return kFailed;
  } catch (const Interrupted&) {
    return kInterrupted;
  }

private:
  /** \param[in] use \return false: no further scan is wanted */
  bool
  readScans(const char* stage, const std::function<bool(const MappedScan&)>& use)
  {
    const ProgressCallback progress = watched(bar_, interrupt_);
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      if (!use(scans_.read(i)))
        return false;
      progress({stage, i + 1, scans_.size()});
    }
    return true;
  }

  Parameter
  resolution() const
  {
    return s_.resolution ? Parameter{*s_.resolution, true, ""} : scans_.resolution();
  }

  /** \throws ComputeFailed no measured points */
  void
  requirePoints(bool is_there) const
  {
    if (!is_there)
      throw ComputeFailed(s_.run + ": the map is empty: no registered scan has static "
                                   "points within the ranges of the run");
  }

  int
  writeOctree()
  {
    OctreeMapOptions options;
    options.max_range = s_.max_range;
    options.memory = memory_;
    for (Parameter edge = resolution();; edge.value *= 2) {
      options.resolution = edge.value;
      OctreeMap map(options);
      bool fits = true;
      checkOptions([&] {
        fits = readScans("casting rays",
                         [&](const MappedScan& scan) { return map.insert(scan); });
      });
      if (fits) {
        requirePoints(!map.isEmpty());
        map.write(s_.output);
        tell("octree of " + text::counted(map.numNodes(), "node"), &edge);
        return kDone;
      }
      refuseTooLarge(edge);
    }
  }

  /** \throws ComputeFailed the user asked for a resolution beyond the memory */
  void
  refuseTooLarge(const Parameter& edge)
  {
    const std::string words = "an octree of voxels of " + text::shortest(edge.value) +
                              " m takes more than the " +
                              std::to_string(memory_ >> 20U) + " MB allowed";
    if (edge.given || edge.value > kCoarsestVoxel)
      throw ComputeFailed(s_.run + ": " + words +
                          "; give a larger --resolution, a smaller --max-range or more "
                          "--memory");
    bar_.warn(words + ": doubled");
  }

  /** \return raster of cells over the scans \param[in,out] edge of a cell; a derived
   * edge grows to fit into memory */
  MapRaster
  rasterOf(const MapExtent& extent, std::size_t bytes_of_cell, Parameter& edge)
  {
    requirePoints(!extent.box().isEmpty());
    const std::size_t most_cells = memory_ / bytes_of_cell;
    if (!edge.given)
      edge.value = std::max(edge.value, extent.leastResolution(most_cells));
    MapRaster raster;
    checkOptions([&] { raster = extent.raster(edge.value, most_cells); });
    return raster;
  }

  int
  writeGrid()
  {
    Parameter edge = resolution();
    MapExtent extent;
    FloorLayers layers;
    readScans("finding the floor", [&](const MappedScan& scan) {
      extent.add(scan);
      layers.add(scan);
      return true;
    });
    const MapRaster raster = rasterOf(extent, GridMap::kBytesOfCell, edge);
    const FloorHeights floor(layers, extent, memory_ / FloorHeights::kBytesOfCell);
    if (!floor.isKnown())
      bar_.warn("no floor was found below the scanners: heights count from the lowest "
                "scanner");
    GridMapOptions options;
    options.max_range = s_.max_range;
    options.to = std::max(options.to, medianHeight(layers.scanners(), floor));
    if (s_.heights) {
      options.from = s_.heights->from;
      options.to = s_.heights->to;
    }
    GridMap map(raster, floor, options);
    readScans("casting rays", [&](const MappedScan& scan) {
      map.insert(scan);
      return true;
    });
    map.write(s_.output);
    tellGrid(map, edge, options);
    if (map.count(CellState::kUnknown) < raster.size())
      return kDone;
    bar_.warn("every cell is unknown: no point and no ray lies at the given heights "
              "above the floor; change --heights");
    return kDoubtful;
  }

  void
  tellGrid(const GridMap& map, const Parameter& edge, const GridMapOptions& options)
  {
    tell("grid map of " + std::to_string(map.raster().columns) + " x " +
             std::to_string(map.raster().rows) +
             " cells: " + std::to_string(map.count(CellState::kFree)) + " free, " +
             std::to_string(map.count(CellState::kOccupied)) + " occupied, " +
             std::to_string(map.count(CellState::kUnknown)) + " unknown",
         &edge);
    if (!s_.quiet)
      std::cout << "  heights = " << options.from << " to " << options.to
                << " m above the floor (" << (s_.heights ? "given" : "auto") << ")\n";
  }

  int
  writeHeights()
  {
    if (!canWriteGeoTiff()) // fails before the work
      writeGeoTiff(s_.output, HeightMap({}), {});
    const int epsg = epsgOfRun(s_.run);
    const std::string system = epsg == 0 ? std::string() : wktOfEpsg(epsg);
    Parameter edge = resolution();
    MapExtent extent;
    readScans("measuring", [&](const MappedScan& scan) {
      extent.add(scan);
      return true;
    });
    HeightMap map(rasterOf(extent, sizeof(HeightMap::Cell), edge));
    readScans("adding heights", [&](const MappedScan& scan) {
      map.insert(scan);
      return true;
    });
    writeGeoTiff(s_.output, map, scans_.run().summary().world_offset, system);
    tell("heights in " + std::to_string(map.raster().columns) + " x " +
             std::to_string(map.raster().rows) + " cells, " +
             (system.empty() ? "no coordinate system" : nameOfWkt(system)),
         &edge);
    return kDone;
  }

  int
  writeRecording()
  {
    const RunFolder& run = scans_.run();
    TrajectoryBag bag;
    bag.trajectory = readTrajectory(run.path() / "trajectory.tum");
    const auto& scans = run.summary().scans;
    // else poses of every sweep of a drive
    if (bag.trajectory.poses.size() == scans.size()) {
      bag.trajectory.poses = run.trajectory().poses;
      for (const ScanResult& scan : scans)
        bag.covariances.push_back(scan.covariance);
    }
    else
      for (auto& pose : bag.trajectory.poses)
        pose.translation() -= run.summary().world_offset;
    writeTrajectoryBag(s_.output, bag);
    tell(text::counted(bag.trajectory.poses.size(), "pose") + " on /odom and /tf");
    return kDone;
  }

  /** \param[in] edge of voxels or cells; null: the output has no cells */
  void
  tell(const std::string& what, const Parameter* edge = nullptr)
  {
    if (scans_.withoutRays() > 0 && s_.kind != MapKind::kHeights)
      bar_.warn(text::counted(scans_.withoutRays(), "scan") +
                " not centred on the scanner: the rays are not known, and only the "
                "points count");
    if (s_.quiet)
      return;
    const RunResult& summary = scans_.run().summary();
    std::cout << text::counted(scans_.size(), "scan") << ": " << what << '\n';
    if (edge != nullptr)
      std::cout << parameterLine("resolution", *edge) << '\n';
    if (edge != nullptr && summary.moving)
      std::cout << "left out "
                << text::counted(summary.moving->total(), "dynamic point") << '\n';
    if (s_.kind != MapKind::kHeights && !summary.world_offset.isZero())
      std::cout << "world_offset " << text::shortest(summary.world_offset.x()) << ' '
                << text::shortest(summary.world_offset.y()) << ' '
                << text::shortest(summary.world_offset.z())
                << ": subtracted from every coordinate [m]\n";
  }

  const MapSettings& s_;
  std::size_t memory_; ///< [byte] of the map
  const Interrupt interrupt_;
  ProgressBar bar_;
  MapScans scans_;
};
} // namespace

int
runMap(const std::vector<std::string>& arguments)
{
  MapSettings settings;
  if (!parseMapSettings(arguments, settings))
    return kDone;
  const MemoryBudget memory(settings.memory, settings.output);
  claimOutput(settings);
  const int code = MapJob(settings, memory.bytes() / 4 * 3).run();
  flushOutput();
  return code;
}

} // namespace pcl6d::app
