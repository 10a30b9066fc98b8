// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/mcl/mcl_report.h"
#include "evaluate/result_json.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/visualization/top_view.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>

namespace pcl6d::app {

namespace {

void
printErrors(const char* title, const ErrorStatistics& errors, double unit)
{
  std::printf("  %-18s%12.4f%12.4f%12.4f%12.4f\n",
              title,
              unit * errors.rms,
              unit * errors.mean,
              unit * errors.median,
              unit * errors.max);
}

void
printErrors(const std::string& title, const MclErrors& errors)
{
  if (errors.compared == 0)
    return;
  std::printf("\n%-20s%12s%12s%12s%12s\n",
              (title + " (" + std::to_string(errors.compared) + ")").c_str(),
              "rms",
              "mean",
              "median",
              "max");
  printErrors("2D position [m]", errors.position_2d, 1);
  printErrors("yaw [deg]", errors.yaw, degrees(1));
  printErrors("position [m]", errors.position, 1);
  printErrors("orientation [deg]", errors.orientation, degrees(1));
}

void
printJustification(const std::vector<JustificationRow>& rows)
{
  std::printf("\n%-20s%8s%8s%12s%12s%14s%12s\n",
              "ICP against the map",
              "scans",
              "failed",
              "sigma [m]",
              "max [m]",
              "sigma [deg]",
              "max [deg]");
  for (const JustificationRow& row : rows)
    std::printf("  %-18s%8zu%8zu%12.4f%12.4f%14.4f%12.4f\n",
                row.method.c_str(),
                row.position.count,
                row.failed,
                row.position.rms,
                row.position.max,
                degrees(row.yaw.rms),
                degrees(row.yaw.max));
}

/** \return the localised poses in the world of the given poses */
Trajectory
referenceOf(const MclEvaluation& e, bool only_trusted)
{
  const Eigen::Isometry3d T_world_map = e.drive.T_map_world.inverse();
  Trajectory reference;
  for (std::size_t i = 0; i < e.scans.size(); ++i) {
    if (only_trusted && !e.drive.estimates[i].trusted())
      continue;
    reference.poses.push_back(T_world_map * e.drive.T_map_scan[i]);
    reference.stamps.push_back(e.stamps.empty() ? e.indices[i] : e.stamps[i]);
  }
  return reference;
}

void
writeRows(std::ostream& stream, const MclEvaluation& e)
{
  stream << "scan,x,y,yaw,sigma_x,sigma_y,sigma_yaw,walls,agreement,particles,trusted,"
            "reason\n"
         << std::setprecision(17);
  for (std::size_t i = 0; i < e.scans.size(); ++i) {
    const MclEstimate& m = e.drive.estimates[i];
    stream << e.indices[i] << ',' << m.pose.x() + e.map.offset().x() << ','
           << m.pose.y() + e.map.offset().y() << ',' << m.pose.z() << ','
           << std::sqrt(m.covariance(0, 0)) << ',' << std::sqrt(m.covariance(1, 1))
           << ',' << std::sqrt(m.covariance(2, 2)) << ',' << m.walls << ','
           << m.agreement << ',' << m.particles << ',' << m.trusted() << ','
           << toString(m.doubt) << '\n';
  }
}

Json
toJson(const MclErrors& errors)
{
  return {{"scans", errors.compared},
          {"position_2d", statisticsJson(errors.position_2d)},
          {"yaw", statisticsJson(errors.yaw)},
          {"position", statisticsJson(errors.position)},
          {"orientation", statisticsJson(errors.orientation)}};
}

Json
scansToJson(const MclEvaluation& e)
{
  Json scans = Json::array();
  for (std::size_t i = 0; i < e.scans.size(); ++i) {
    Eigen::Isometry3d T_map_scan = e.drive.T_map_scan[i];
    T_map_scan.translation().head<2>() += e.map.offset();
    scans.push_back({{"index", e.indices[i]},
                     {"file", e.names[i]},
                     {"T_map_scan", rowByRow(T_map_scan.matrix())},
                     {"covariance", rowByRow(e.drive.estimates[i].covariance)},
                     {"trusted", e.drive.estimates[i].trusted()}});
  }
  return scans;
}

Json
toJson(const MclSettings& s, const MclEvaluation& e)
{
  Eigen::Isometry3d T_map_world = e.drive.T_map_world;
  T_map_world.translation().head<2>() += e.map.offset();
  Json json = {{"schema_version", 1},
               {"generator", kEvaluate},
               {"version", PCL6D_VERSION},
               {"folder", s.folder},
               {"poses", e.pose_source},
               {"map",
                {{"file", s.map},
                 {"source", e.map_source},
                 {"segments", e.map.segments().size()}}},
               {"T_map_world", rowByRow(T_map_world.matrix())},
               {"particles", s.mcl.num_particles},
               {"hit_sigma", s.mcl.hit_sigma},
               {"seed", s.mcl.seed},
               {"scans", e.scans.size()},
               {"trusted", e.drive.numTrusted()},
               {"doubtful", Json::array()}};
  for (const DoubtfulStretch& stretch : e.drive.doubtfulStretches())
    json["doubtful"].push_back({{"first", e.indices[stretch.first]},
                                {"last", e.indices[stretch.last]},
                                {"reason", toString(stretch.doubt)}});
  if (e.all)
    json["errors"] = {{"reference", s.reference},
                      {"all", toJson(*e.all)},
                      {"trusted", toJson(*e.trusted)}};
  for (const JustificationRow& row : e.justification)
    json["justification"].push_back({{"method", row.method},
                                     {"scans", row.position.count},
                                     {"failed", row.failed},
                                     {"position", statisticsJson(row.position)},
                                     {"yaw", statisticsJson(row.yaw)}});
  json["poses_in_map"] = scansToJson(e);
  return json;
}

/** \return the walls as points, dense enough to look like lines */
Points
drawnWalls(const SegmentMap& map)
{
  constexpr double kSpacing = 0.2, kMostPoints = 1e6; // [m]; far more than pixels
  double length = 0;
  for (const Segment& wall : map.segments())
    length += (wall.b - wall.a).norm();
  const double spacing = std::max(kSpacing, length / kMostPoints);
  Points points;
  for (const Segment& wall : map.segments()) {
    const long count = std::lround((wall.b - wall.a).norm() / spacing) + 1;
    for (long i = 0; i <= count; ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(count);
      const Eigen::Vector2d place = wall.a + s * (wall.b - wall.a);
      points.push_back(
          {static_cast<float>(place.x()), static_cast<float>(place.y()), 0});
    }
  }
  return points;
}
} // namespace

OutputRules
mclFolderRules(const MclSettings& settings)
{
  OutputRules rules;
  rules.folder = settings.out;
  rules.inputs = {
      settings.folder, settings.map, settings.reference, settings.scans.poses_file};
  rules.program = kEvaluate;
  rules.marker = "mcl.json";
  rules.files = std::regex("reference\\.(kitti|tum)|mcl\\.(csv|json|png)");
  rules.force = settings.force;
  return rules;
}

void
printMcl(const MclSettings& s, const MclEvaluation& e)
{
  if (!s.quiet)
    std::printf("%s: %zu scans, poses from %s\nmap %s: %zu segments (%s)\n",
                s.folder.c_str(),
                e.scans.size(),
                e.pose_source.c_str(),
                s.map.c_str(),
                e.map.segments().size(),
                e.map_source.c_str());
  std::printf(
      "%zu of %zu scans are to be trusted\n", e.drive.numTrusted(), e.scans.size());
  for (const DoubtfulStretch& stretch : e.drive.doubtfulStretches())
    std::printf("  not scans %d to %d: %s\n",
                e.indices[stretch.first],
                e.indices[stretch.last],
                toString(stretch.doubt));
  if (e.all && e.all->compared > e.trusted->compared)
    printErrors("all", *e.all);
  if (e.trusted)
    printErrors("trusted", *e.trusted);
  if (!e.justification.empty())
    printJustification(e.justification);
}

void
writeMclFiles(const OutputFolder& out, const MclSettings& s, const MclEvaluation& e)
{
  writeTrajectoryKitti(out / "reference.kitti", referenceOf(e, false));
  if (e.drive.numTrusted() > 0)
    writeTrajectoryTum(out / "reference.tum", referenceOf(e, true));
  writeFileAtomically(out / "mcl.csv",
                      [&](std::ostream& stream) { writeRows(stream, e); });
  writeJson(out / "mcl.json", toJson(s, e));
}

bool
drawMcl(FolderJob& job, const MclEvaluation& e)
{
  TopViewOptions options;
  options.title = "Monte Carlo localisation";
  options.final_label = "localised";
  options.initial_label = "odometry";
  TopViewScene scene;
  scene.points = drawnWalls(e.map);
  scene.trajectory.poses = e.drive.T_map_scan;
  for (const DriveScan& scan : e.scans)
    scene.initial.poses.push_back(e.drive.T_map_world * scan.odometry);
  return job.draw("mcl.png", [&](const std::filesystem::path& picture) {
    TopView(options).write(picture, scene);
  });
}

} // namespace pcl6d::app
