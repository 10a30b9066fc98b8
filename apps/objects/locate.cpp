// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/output_folder.h"
#include "objects/locate_scans.h"
#include "objects/verbs.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/semantic_map/object_fusion.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <cstdio>

namespace pcl6d::app {
namespace {
namespace fs = std::filesystem;

/** The objects of the input, and of each observation which one it is of. */
struct Joined {
  std::vector<MapObject> objects;
  std::vector<std::uint32_t> id_of_observation;
};

Joined
join(const Located& located, bool fuse)
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

/** Writes each scan as it was read, with the field object_id. */
void
writeLabelledScans(const OutputFolder& out,
                   const LocateSettings& s,
                   const Located& located,
                   const Joined& joined)
{
  const bool is_folder = fs::is_directory(s.input);
  for (const auto& here : located.scans) {
    const Scan scan = readScan(here.file, s.folder.format);
    std::vector<double> ids(scan.points.size(), 0);
    for (std::size_t i = 0; i < here.points.size(); ++i)
      for (const auto place : here.points[i])
        ids[place] = joined.id_of_observation[here.observations[i]];
    pcl::PCLPointCloud2 cloud = scan.cloud;
    const std::string field =
        fieldValues(cloud, "object_id") ? "located_id" : "object_id";
    addField(cloud, field, pcl::PCLPointField::UINT32, ids);
    const std::string name =
        is_folder ? "scans/" + here.file.stem().string() + ".pcd" : "objects.pcd";
    writeScan(out / name, cloud, here.T_world_scan);
  }
}

void
printTable(const Located& located, const std::vector<MapObject>& objects)
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
  const Interrupt interrupt;
  ProgressBar bar(s.quiet);
  if (!s.without_effect.empty())
    bar.warn(s.without_effect);
  OutputFolder out(outputRules(s));
  const auto located = locateScans(s, bar, interrupt);
  if (!located) {
    bar.say("interrupted; nothing is written");
    return kInterrupted;
  }
  const Joined joined = join(*located, s.fuse);
  writeMapObjects(out / "objects.json", joined.objects, {located->seconds, kObjects});
  writeLabelledScans(out, s, *located, joined);
  const auto written = out.publish();
  if (s.quiet)
    return kDone;
  printTable(*located, joined.objects);
  for (const auto& path : written)
    std::printf("  %s\n", path.c_str());
  return std::fflush(stdout) == 0 ? kDone : kFailed;
}

} // namespace pcl6d::app
