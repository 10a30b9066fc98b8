// SPDX-License-Identifier: BSD-3-Clause
#include "common/open_scans.h"
#include "objects/locate_scans.h"

#include <pcl6d/common/error.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/scan_fields.h>

#include <chrono>
#include <limits>

namespace pcl6d::app {
namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::vector<StoredModel>
readModels(const LocateSettings& s)
{
  std::vector<StoredModel> models;
  for (const auto& path : s.models)
    models.push_back(fs::is_directory(path) ? readStoredModel(path)
                                            : readModelFile(path, s.file));
  if (!s.store.empty())
    for (const auto& folder : listModels(s.store))
      models.push_back(readStoredModel(folder));
  for (std::size_t i = 0; i < models.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (models[i].model.objectClass() == models[j].model.objectClass())
        throw BadArgument("two models are of the class '" +
                          models[i].model.objectClass() +
                          "': give one of them alone, or another name to one: to a "
                          "folder in its model.json, to a file by its own name");
  return models;
}

/** The points of a scan within the range gate, and which they are. */
struct GatedScan {
  GatedScan(const Scan& scan, double min_range, double max_range)
  {
    const auto field = fieldValues(scan.cloud, "intensity");
    for (std::size_t i = 0; i < scan.points.size(); ++i)
      if (isWithinRange(scan.points[i], min_range, max_range)) {
        points.push_back(scan.points[i]);
        places.push_back(static_cast<std::uint32_t>(i));
        if (field)
          reflectance.push_back(static_cast<float>(field->values[i]));
      }
  }

  Points points;
  std::vector<float> reflectance;
  std::vector<std::uint32_t> places;
};

/** Looks for objects in the scans of an input, one after the other. */
class Locator {
public:
  Locator(const LocateSettings& settings, ProgressBar& bar)
  : settings_(settings), bar_(bar), finder_(readModels(settings), settings.finder)
  {}

  /** \return nothing if interrupted */
  std::optional<Located>
  run(const Interrupt& interrupt) const
  {
    Located located;
    if (!fs::is_directory(settings_.input)) {
      const Scan scan = readScan(settings_.input, settings_.folder.format);
      add(scan, settings_.input, Eigen::Isometry3d::Identity(), 0, {}, located);
      return located;
    }
    const RegisteredScans scans = openScans(settings_.input, settings_.folder);
    bar_.say(std::to_string(scans.folder().size()) + " scans, poses from " +
             scans.poseSource());
    for (std::size_t i = 0; i < scans.folder().size(); ++i) {
      if (interrupt.requested())
        return {};
      add(scans.folder().read(i),
          scans.folder().file(i),
          scans.pose(i),
          scans.index(i),
          {scans.minRange(), scans.maxRange()},
          located);
      bar_.show({"scans", i + 1, scans.folder().size()});
    }
    return located;
  }

private:
  struct Gate {
    double min_range = 0;
    double max_range = std::numeric_limits<double>::infinity();
  };

  void
  add(const Scan& scan,
      const fs::path& file,
      const Eigen::Isometry3d& T_world_scan,
      std::size_t id,
      const Gate& gate,
      Located& located) const
  {
    const GatedScan gated(
        scan,
        settings_.min_range > 0 ? settings_.min_range : gate.min_range,
        settings_.max_range > 0 ? settings_.max_range : gate.max_range);
    const auto start = Clock::now();
    std::vector<LocalizedObject> found;
    try {
      found = finder_.find(gated.points, gated.reflectance);
    } catch (const BadArgument& e) {
      throw BadArgument(file.string() + ": " + e.what());
    }
    located.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    ScanObjects& here = located.scans.emplace_back();
    here.file = file;
    here.T_world_scan = T_world_scan;
    for (const auto& object : found) {
      here.observations.push_back(located.observations.size());
      located.observations.push_back(finder_.mapObject(object, T_world_scan, id));
      here.points.emplace_back();
      for (const auto point : object.points)
        here.points.back().push_back(gated.places[point]);
    }
  }

  const LocateSettings& settings_;
  ProgressBar& bar_;
  ObjectFinder finder_;
};
} // namespace

std::optional<Located>
locateScans(const LocateSettings& settings,
            ProgressBar& bar,
            const Interrupt& interrupt)
{
  return Locator(settings, bar).run(interrupt);
}

} // namespace pcl6d::app
