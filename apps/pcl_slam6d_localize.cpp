// SPDX-License-Identifier: BSD-3-Clause
// Poses of further scans in the map of a finished run.
#include "common/app.h"
#include "common/output/folder_job.h"
#include "common/printable.h"
#include "localize/known_map.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/sources/open_source.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>

namespace {
using namespace pcl6d;
using app::LocalizeSettings;
using Json = nlohmann::ordered_json;

/** A scan with the result of its localisation. */
struct Row {
  std::string file;
  int index = 0;
  double stamp = 0; ///< [s]; the index without stamps
  LocalisedScan found;
  Eigen::Isometry3d T_world_scan; ///< of points in the file, full coordinates

  bool
  isPlaced() const
  {
    return found.answer == PlaceAnswer::kUnique;
  }
};

app::OutputRules
rulesOf(const LocalizeSettings& s)
{
  app::OutputRules rules;
  rules.folder = s.out;
  rules.inputs = s.inputs;
  rules.inputs.emplace_back(s.run);
  rules.inputs.push_back(s.folder.poses_file);
  rules.program = app::kLocalize;
  rules.marker = "localization.json";
  rules.files = std::regex("localization\\.json|trajectory\\.tum");
  rules.force = s.force;
  return rules;
}

ScanFolder
openFurther(const LocalizeSettings& s)
{
  std::optional<ScanFolder> folder;
  const bool is_one_scan = s.inputs.size() == 1 && !isSourceFile(s.inputs.front()) &&
                           std::filesystem::is_regular_file(s.inputs.front());
  app::checkOptions(
      [&] {
        folder.emplace(is_one_scan ? openFileList(s.inputs, s.folder)
                                   : openScanFiles(s.inputs, s.folder));
      },
      {{"poses_file", "poses"}});
  return *std::move(folder);
}

/** \return the motion from the previous scan by the odometry, if available */
std::optional<Eigen::Isometry3d>
motionTo(const ScanFolder& folder, std::size_t i)
{
  if (i == 0 || !folder.hasPoses())
    return std::nullopt;
  return folder.initialPose(i - 1).inverse() * folder.initialPose(i);
}

/** A scan with too few points gets no pose; the program continues with the next scan. */
LocalisedScan
localise(const app::KnownMap& map,
         const ScanFolder& folder,
         std::size_t i,
         MapLocaliser& localiser)
{
  const Points points = folder.read(i).points;
  const std::set<std::size_t> copies = map.copiesOf(points);
  LocalisedScan found;
  if (copies.size() == map.scans().size()) {
    found.rejection = Rejection::stated("the map holds no further scan");
    return found;
  }
  try {
    const PreparedScans prepared = map.prepare(points, folder.title(i));
    return localiser.localise(
        PlaceableScan(prepared.scans().front()), motionTo(folder, i), copies);
  } catch (const ComputeFailed& e) {
    found.rejection = Rejection::stated(e.what());
    return found;
  }
}

std::vector<Row>
localiseAll(const LocalizeSettings& s, app::FolderJob& job)
{
  const ScanFolder folder = openFurther(s);
  const auto show = app::watched(job.bar, job.interrupt);
  const app::KnownMap map(s, show);
  MapLocaliserOptions options;
  options.num_threads = s.num_threads;
  MapLocaliser localiser(map.scans(), options);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < folder.size(); ++i) {
    Row& row = rows.emplace_back();
    row.file = folder.name(i);
    row.index = folder.index(i);
    row.stamp = folder.stamps().empty() ? row.index : folder.stamps()[i];
    row.found = localise(map, folder, i, localiser);
    row.T_world_scan = Eigen::Translation3d(map.worldOffset()) * row.found.T_map_scan;
    if (folder.moved())
      row.T_world_scan = folder.moved()->asGiven(row.T_world_scan);
    show({"localising", i + 1, folder.size()});
  }
  return rows;
}

std::size_t
countPlaced(const std::vector<Row>& rows)
{
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const Row& r) { return r.isPlaced(); }));
}

void
write(const LocalizeSettings& s,
      const std::vector<Row>& rows,
      const app::OutputFolder& out)
{
  Trajectory trajectory;
  Json json{{"schema_version", 2},
            {"generator", app::kLocalize},
            {"version", PCL6D_VERSION},
            {"run", s.run}};
  json["totals"] = {{"scans", rows.size()}, {"with_pose", countPlaced(rows)}};
  json["scans"] = Json::array();
  for (const Row& row : rows) {
    Json one{{"file", row.file},
             {"index", row.index},
             {"answer", toString(row.found.answer)},
             {"tracked", row.found.tracked},
             {"overlap", row.found.overlap},
             {"violations", row.found.contradiction},
             {"reason", toWords(row.found.rejection)}};
    one["T_world_scan"] =
        row.isPlaced() ? Json(rowByRow(row.T_world_scan.matrix())) : Json();
    json["scans"].push_back(one);
    if (!row.isPlaced())
      continue;
    trajectory.poses.push_back(row.T_world_scan);
    trajectory.stamps.push_back(row.stamp);
  }
  writeTrajectoryTum(out / "trajectory.tum", trajectory);
  writeJson(out / "localization.json", json);
}

void
printRows(const std::vector<Row>& rows)
{
  std::printf("%zu of %s placed in the map\n",
              countPlaced(rows),
              text::counted(rows.size(), "scan").c_str());
  for (const Row& row : rows) {
    const Eigen::Vector3d at = row.T_world_scan.translation();
    const std::string file = app::printable(row.file);
    if (row.isPlaced())
      std::printf("%s: %.3f %.3f %.3f m, overlap %.2f, %s\n",
                  file.c_str(),
                  at.x(),
                  at.y(),
                  at.z(),
                  row.found.overlap,
                  row.found.tracked ? "tracked" : "searched");
    else
      std::printf("%s: %s: %s\n",
                  file.c_str(),
                  toString(row.found.answer),
                  app::printable(toWords(row.found.rejection)).c_str());
  }
}

int
run(const std::vector<std::string>& arguments)
{
  LocalizeSettings s;
  if (!app::parseLocalizeSettings(arguments, s))
    return app::kDone;
  app::FolderJob job(s.quiet, "", rulesOf(s));
  try {
    const std::vector<Row> rows = localiseAll(s, job);
    write(s, rows, *job.out);
    job.publish([&] { printRows(rows); });
    return countPlaced(rows) == rows.size() ? app::kDone : app::kDoubtful;
  } catch (const app::Interrupted&) {
    job.bar.say("interrupted; nothing is written");
    return app::kInterrupted;
  }
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kLocalize, argc, argv, run);
}
