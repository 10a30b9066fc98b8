// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/changes/changes_report.h"
#include "evaluate/result_json.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/median.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/visualization/top_view.h>

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <regex>

namespace pcl6d::app {

namespace {
constexpr Colour kGreen{60, 200, 80}, kRed{230, 40, 40}, kBlue{70, 130, 255},
    kOrange{255, 160, 40};

Colour
colourOf(ChangeKind kind)
{
  switch (kind) {
  case ChangeKind::kAppeared:
    return kGreen;
  case ChangeKind::kVanished:
    return kRed;
  case ChangeKind::kMoved:
    return kBlue;
  case ChangeKind::kSurface:
    break;
  }
  return kOrange;
}

Json
boxJson(const ChangeBox& box, const Eigen::Vector3d& offset)
{
  const Eigen::Isometry3d T = Eigen::Translation3d(offset) * box.T_world_box;
  return {{"centre", rowByRow(T.translation())},
          {"size", rowByRow(box.size)},
          {"volume", box.volume()},
          {"T_world_box", rowByRow(T.matrix())}};
}

Json
changeJson(const Change& one, const Eigen::Vector3d& offset)
{
  Json json = {{"kind", toString(one.kind)},
               {"box", boxJson(one.box, offset)},
               {"voxels", one.points.size()},
               {"confidence", one.confidence}};
  if (one.kind == ChangeKind::kSurface) {
    json["distance"] = one.distance;
    json["lod95"] = one.lod;
    return json;
  }
  json["observers"] = one.num_observers;
  if (one.before) {
    const Eigen::Isometry3d motion =
        Eigen::Translation3d(offset) * one.motion * Eigen::Translation3d(-offset);
    json["before"] = boxJson(*one.before, offset);
    json["motion"] = rowByRow(motion.matrix());
    json["agreement"] = one.agreement;
  }
  return json;
}

Json
tallyJson(const std::string& run, const RunTally& tally)
{
  return {{"run", run},
          {"points", tally.points},
          {"on_surface", tally.there},
          {"shifted", tally.shifted},
          {"violated", tally.seen_through},
          {"changed", tally.changed},
          {"dynamic", tally.restless},
          {"unknown", tally.unknown}};
}

Json
distancesJson(const std::vector<SurfaceDistance>& distances)
{
  std::vector<double> sizes, lods;
  std::size_t significant = 0;
  for (const SurfaceDistance& one : distances) {
    sizes.push_back(std::abs(one.distance));
    lods.push_back(one.lod);
    significant += one.isSignificant() ? 1 : 0;
  }
  return {{"core_points", distances.size()},
          {"significant", significant},
          {"median_distance", upperMedian(std::move(sizes))},
          {"median_lod95", upperMedian(std::move(lods))}};
}

Json
worldJson(const CommonWorld& world)
{
  return {{"source", world.source},
          {"T_a_b", rowByRow(world.T_a_b.matrix())},
          {"overlap", world.alignment.overlap},
          {"residual", world.alignment.residual},
          {"deformation", world.alignment.bending},
          {"links",
           {{"good", world.count(LinkTrust::kGood)},
            {"weak", world.count(LinkTrust::kWeak)},
            {"unverified", world.count(LinkTrust::kUnverified)},
            {"wrong", world.count(LinkTrust::kWrong)}}}};
}

/** The points of A in the world, one per voxel and scan. */
Points
mapOf(const ComparedRun& run)
{
  Points all;
  for (const ComparedScan& scan : run) {
    const Points moved = transformed(*scan.points, scan.T_world_scan);
    all.insert(all.end(), moved.begin(), moved.end());
  }
  return all;
}

/** Adds the points of a change with colours; of moved objects also the points before, paler. */
template <typename Add>
void
forEachPoint(const RunChanges& found, const Add& add)
{
  std::size_t number = 0;
  for (const Change& one : found.changes) {
    ++number;
    Colour pale = colourOf(one.kind);
    for (auto& part : pale)
      part = static_cast<std::uint8_t>((part + 150) / 2);
    for (const auto& p : one.points_before)
      add(p, pale, number);
    for (const auto& p : one.points)
      add(p, colourOf(one.kind), number);
  }
}

pcl::PCLPointCloud2
cloudOf(const ChangesReport& report)
{
  pcl::PointCloud<pcl::PointXYZRGB> coloured;
  std::vector<double> numbers;
  const auto add =
      [&](const Eigen::Vector3f& place, Colour colour, std::size_t number) {
        coloured.emplace_back(colour[0], colour[1], colour[2]).getVector3fMap() = place;
        numbers.push_back(static_cast<double>(number));
      };
  constexpr Colour kGrey{150, 150, 150};
  for (const auto& p : mapOf(report.world.a))
    add(p, kGrey, 0);
  forEachPoint(report.found, add);
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(coloured, cloud);
  addField(cloud, "change", pcl::PCLPointField::UINT32, numbers);
  return cloud;
}

/** Adds the outline of a box from above. */
void
drawBox(const ChangeBox& box, Colour colour, Overlay& overlay)
{
  Overlay::Line line;
  line.colour = colour;
  for (const auto& [x, y] : {std::pair(1, 1),
                             std::pair(-1, 1),
                             std::pair(-1, -1),
                             std::pair(1, -1),
                             std::pair(1, 1)})
    line.points.push_back(box.T_world_box * Eigen::Vector3d(x * box.size.x() / 2,
                                                            y * box.size.y() / 2,
                                                            box.size.z() / 2));
  overlay.lines.push_back(line);
}

void
draw(const std::filesystem::path& path, const ChangesReport& report)
{
  TopViewOptions options;
  options.title = "Changes";
  options.final_label = "scanner of A";
  options.colour = PointColour::kPlain;
  TopViewScene scene;
  scene.points = mapOf(report.world.a);
  for (const ComparedScan& scan : report.world.a)
    scene.trajectory.poses.push_back(scan.T_world_scan);
  forEachPoint(report.found, [&](const Eigen::Vector3f& p, Colour colour, std::size_t) {
    scene.overlay.marks.push_back({p.cast<double>(), colour, 4});
  });
  for (const Change& one : report.found.changes) {
    const Colour colour = colourOf(one.kind);
    drawBox(one.box, colour, scene.overlay);
    if (!one.before)
      continue;
    drawBox(*one.before, colour, scene.overlay);
    scene.overlay.lines.push_back(
        {{one.before->T_world_box.translation(), one.box.T_world_box.translation()},
         colour});
  }
  scene.overlay.keys = {{"appeared", kGreen},
                        {"vanished", kRed},
                        {"moved", kBlue},
                        {"surface shifted", kOrange}};
  TopView(options).write(path, scene);
}
} // namespace

OutputRules
changesFolderRules(const ChangesSettings& s)
{
  OutputRules rules;
  rules.folder = s.out;
  rules.inputs = {s.run_a, s.run_b};
  rules.program = kEvaluate;
  rules.marker = "changes.json";
  rules.files = std::regex("changes\\.(json|ply|png)");
  rules.force = s.force;
  return rules;
}

void
writeChangesJson(const std::filesystem::path& path, const ChangesReport& report)
{
  Json changes = Json::array();
  for (const Change& one : report.found.changes)
    changes.push_back(changeJson(one, report.runs.worldOffset()));
  const Json json = {{"schema_version", 2},
                     {"generator", kEvaluate},
                     {"world_offset", rowByRow(report.runs.worldOffset())},
                     {"voxel", report.runs.voxel()},
                     {"world", worldJson(report.world)},
                     {"first", tallyJson(report.settings.run_a, report.found.first)},
                     {"second", tallyJson(report.settings.run_b, report.found.second)},
                     {"background", report.found.background},
                     {"surfaces", distancesJson(report.found.distances)},
                     {"changes", changes}};
  writeJson(path, json);
}

bool
publishChanges(FolderJob& job, const ChangesReport& report)
{
  writeChangesJson(*job.out / "changes.json", report);
  writeScan(*job.out / "changes.ply", cloudOf(report));
  job.publish();
  return job.draw("changes.png",
                  [&](const std::filesystem::path& picture) { draw(picture, report); });
}

} // namespace pcl6d::app
