// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/object_localization/pose_covariance.h>
#include <pcl6d/semantic_map/object_observations.h>

#include <algorithm>
#include <chrono>

namespace pcl6d {

namespace {
using Clock = std::chrono::steady_clock;

/** The points of a scan within the range gate, and their indices. */
struct GatedScan {
  GatedScan(const Scan& scan, const ObservationRange& range)
  {
    const auto field = fieldValues(scan.cloud, "intensity");
    for (std::size_t i = 0; i < scan.points.size(); ++i)
      if (isWithinRange(scan.points[i], range.min_range, range.max_range)) {
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

/** \return an object of a scan converted to an object of the map */
MapObject
mapObject(const std::vector<StoredModel>& models,
          const LocalizedObject& object,
          const Eigen::Isometry3d& T_world_scan,
          std::size_t scan_id)
{
  const auto stored =
      std::find_if(models.begin(), models.end(), [&](const StoredModel& m) {
        return m.model.objectClass() == object.object_class;
      });
  MapObject made;
  made.pose.object_class = object.object_class;
  made.pose.T_world_object = T_world_scan * object.T_scene_object;
  if (stored != models.end()) {
    made.pose.box = stored->model.box();
    made.symmetry = stored->model.symmetry().turns;
  }
  made.pose.points = object.points.size();
  made.score = object.score;
  made.visible_fraction = object.visible_fraction;
  made.rms = object.rms;
  if (object.covariance)
    made.covariance =
        movedCovariance(*object.covariance, T_world_scan, object.T_scene_object);
  made.scans = {scan_id};
  return made;
}
} // namespace

void
observeObjects(const ObjectFinder& finder,
               const Scan& scan,
               const std::filesystem::path& file,
               const Eigen::Isometry3d& T_world_scan,
               std::size_t id,
               const ObservationRange& range,
               ObjectObservations& found)
{
  const GatedScan gated(scan, range);
  const auto start = Clock::now();
  std::vector<LocalizedObject> objects;
  try {
    objects = finder.find(gated.points, gated.reflectance);
  } catch (const BadArgument& e) {
    throw BadArgument(file.string() + ": " + e.what());
  }
  found.seconds += std::chrono::duration<double>(Clock::now() - start).count();
  ScanObjects& here = found.scans.emplace_back();
  here.file = file;
  here.T_world_scan = T_world_scan;
  for (const auto& object : objects) {
    here.observations.push_back(found.observations.size());
    found.observations.push_back(mapObject(finder.models(), object, T_world_scan, id));
    here.points.emplace_back();
    for (const auto point : object.points)
      here.points.back().push_back(gated.places[point]);
  }
}

ObjectObservations
observeObjects(const ObjectFinder& finder,
               const RegisteredScans& scans,
               const ObservationRange& given,
               const ProgressCallback& progress)
{
  ObservationRange range{scans.minRange(), scans.maxRange()};
  if (given.min_range > 0)
    range.min_range = given.min_range;
  if (given.max_range > 0)
    range.max_range = given.max_range;
  ObjectObservations found;
  const std::size_t count = scans.folder().size();
  for (std::size_t i = 0; i < count; ++i) {
    observeObjects(finder,
                   scans.folder().read(i),
                   scans.folder().file(i),
                   scans.pose(i),
                   scans.index(i),
                   range,
                   found);
    if (progress)
      progress({"scans", i + 1, count});
  }
  return found;
}

} // namespace pcl6d
