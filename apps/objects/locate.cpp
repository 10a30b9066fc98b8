// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/output/folder_job.h"
#include "objects/locate_settings.h"
#include "objects/verbs.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/semantic_map/object_fusion.h>
#include <pcl6d/semantic_map/object_observations.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <cstdio>
#include <functional>
#include <memory>

namespace pcl6d::app {
namespace {
namespace fs = std::filesystem;

/** Reads the i-th scan of the search. */
using ReadCloud = std::function<ScanCloud(std::size_t)>;

/** \param[out] read reads the searched scans once more \throws Interrupted */
ObjectObservations
observe(const LocateSettings& s, FolderJob& job, ReadCloud& read)
{
  const ObjectFinder finder(readModels(s.models, s.store, s.file), s.finder);
  const ObservationRange given{s.min_range, s.max_range};
  if (fs::is_directory(s.input)) {
    const auto scans =
        std::make_shared<RegisteredScans>(openScans(s.input, s.folder, job.bar));
    read = [scans](std::size_t i) { return scans->folder().readCloud(i); };
    return observeObjects(finder, *scans, given, watched(job.bar, job.interrupt));
  }
  const NearScan scan = readNearScan(s.input, s.folder.format);
  if (!scan.description.empty())
    job.bar.warn(scan.description);
  read = [&s](std::size_t) { return readNearScan(s.input, s.folder.format); };
  ObservationRange range;
  range.min_range = given.min_range;
  if (given.max_range > 0)
    range.max_range = given.max_range;
  ObjectObservations found;
  observeObjects(finder,
                 scan,
                 s.input,
                 Eigen::Isometry3d(Eigen::Translation3d(scan.offset)),
                 0,
                 range,
                 found);
  return found;
}

/** The objects of the input, and the object of each observation. */
struct Joined {
  std::vector<MapObject> objects;
  std::vector<std::uint32_t> id_of_observation;
};

Joined
join(const ObjectObservations& located, bool fuse)
{
  Joined joined;
  joined.id_of_observation.resize(located.observations.size());
  if (!fuse) {
    joined.objects = located.observations;
    for (std::size_t i = 0; i < joined.objects.size(); ++i)
      joined.id_of_observation[i] = static_cast<std::uint32_t>(i + 1);
    return joined;
  }
  for (const auto& fused : fuseObjects(located.observations)) {
    joined.objects.push_back(fused.object);
    for (const auto observation : fused.observations)
      joined.id_of_observation[observation] =
          static_cast<std::uint32_t>(joined.objects.size());
  }
  return joined;
}

/** Writes each scan unchanged, with the field object_id. */
void
writeLabelledScans(const OutputFolder& out,
                   const LocateSettings& s,
                   const ReadCloud& read,
                   const ObjectObservations& located,
                   const Joined& joined)
{
  const bool is_folder = fs::is_directory(s.input);
  for (std::size_t k = 0; k < located.scans.size(); ++k) {
    const ScanObjects& here = located.scans[k];
    pcl::PCLPointCloud2 cloud = read(k).cloud;
    std::vector<double> ids(std::size_t{cloud.width} * cloud.height, 0);
    for (std::size_t i = 0; i < here.points.size(); ++i)
      for (const auto place : here.points[i])
        ids[place] = joined.id_of_observation[here.observations[i]];
    const std::string field =
        fieldValues(cloud, "object_id") ? "located_id" : "object_id";
    addField(cloud, field, pcl::PCLPointField::UINT32, ids);
    const std::string name =
        is_folder ? "scans/" + here.file.stem().string() + ".pcd" : "objects.pcd";
    writeScan(out / name, cloud, here.T_world_scan);
  }
}

void
printTable(const ObjectObservations& located, const std::vector<MapObject>& objects)
{
  std::printf("%zu objects in %zu scans, %.3f s\n",
              objects.size(),
              located.scans.size(),
              located.seconds);
  if (!objects.empty())
    std::puts("   id  class          x [m]    y [m]    z [m]  score  visible  rms [m]  "
              "scans");
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const MapObject& o = objects[i];
    const Eigen::Vector3d t = o.pose.T_world_object.translation();
    std::printf("%5zu  %-10s %9.3f %8.3f %8.3f  %5.2f  %7.2f  %7.4f  %5zu\n",
                i + 1,
                o.pose.object_class.c_str(),
                t.x(),
                t.y(),
                t.z(),
                o.score,
                o.visible_fraction,
                o.rms,
                o.scans.size());
  }
}

OutputRules
outputRules(const LocateSettings& s)
{
  OutputRules rules;
  rules.folder = s.out;
  rules.inputs = {s.input, s.folder.poses_file, s.store};
  rules.inputs.insert(rules.inputs.end(), s.models.begin(), s.models.end());
  rules.program = kObjects;
  rules.marker = "objects.json";
  rules.files = std::regex("objects\\.(json|pcd)|scans/[^/]+\\.pcd");
  rules.force = s.force;
  return rules;
}
} // namespace

int
runLocate(const std::vector<std::string>& arguments)
{
  LocateSettings s;
  if (!parseLocate(arguments, s))
    return kDone;
  FolderJob job(s.quiet, s.without_effect, outputRules(s));
  try {
    ReadCloud read;
    const ObjectObservations located = observe(s, job, read);
    const Joined joined = join(located, s.fuse);
    writeMapObjects(
        *job.out / "objects.json", joined.objects, {located.seconds, kObjects});
    writeLabelledScans(*job.out, s, read, located, joined);
    job.publish([&] { printTable(located, joined.objects); });
  } catch (const Interrupted&) {
    job.bar.say("interrupted; nothing is written");
    return kInterrupted;
  }
  return s.quiet || std::fflush(stdout) == 0 ? kDone : kFailed;
}

} // namespace pcl6d::app
