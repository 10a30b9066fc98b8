// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/verbs.h"
#include "evaluate/verify/verify_report.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/verification_io.h>
#include <pcl6d/verification/link_evidence.h>
#include <pcl6d/visualization/top_view.h>

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <regex>
#include <vector>

namespace pcl6d::app {

namespace {
/** A contradicted point in the world, relative to the world offset. */
struct ContradictedPoint {
  Eigen::Vector3f place;
  float beyond; ///< [m] distance from the point to the end of the ray behind
  bool clear;   ///< in a contradicted patch
  std::size_t scan, seen_from; ///< indices of the scan and of its observer
};

/** Adds the points of a scan contradicted by rays of another scan. */
void
addContradictions(const VerifySource& source,
                  std::size_t from,
                  std::size_t at,
                  std::vector<ContradictedPoint>& points)
{
  const auto& scans = source.scans.scans();
  const Eigen::Isometry3d& T_world_at = source.poses[at];
  for (const Contradiction& one : contradictedPoints(
           scans[from], scans[at], source.poses[from].inverse() * T_world_at))
    points.push_back({(T_world_at * one.place.cast<double>()).cast<float>(),
                      one.beyond,
                      one.clear,
                      at,
                      from});
}

std::vector<ContradictedPoint>
contradictionsOf(const VerifySettings& s,
                 const VerifySource& source,
                 const MapVerification& map)
{
  std::vector<std::vector<ContradictedPoint>> of_link(map.links.size());
  parallelFor(map.links.size(), s.num_threads, [&](std::size_t k) {
    const LinkCheck& link = map.links[k];
    addContradictions(source, link.from, link.to, of_link[k]);
    addContradictions(source, link.to, link.from, of_link[k]);
  });
  std::vector<ContradictedPoint> all;
  for (const auto& points : of_link)
    all.insert(all.end(), points.begin(), points.end());
  return all;
}

pcl::PCLPointCloud2
cloudOf(const std::vector<ContradictedPoint>& points, const VerifySource& source)
{
  pcl::PointCloud<pcl::PointXYZRGB> coloured;
  std::vector<double> beyond, scans, seen_from;
  for (const ContradictedPoint& point : points) {
    pcl::PointXYZRGB& p = coloured.emplace_back(std::uint8_t(150), 150, 150);
    if (point.clear)
      p.r = 255, p.g = 0, p.b = 0;
    p.getVector3fMap() = point.place;
    beyond.push_back(point.beyond);
    scans.push_back(static_cast<double>(source.indices[point.scan]));
    seen_from.push_back(static_cast<double>(source.indices[point.seen_from]));
  }
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(coloured, cloud);
  addField(cloud, "scan", pcl::PCLPointField::UINT32, scans);
  addField(cloud, "seen_from", pcl::PCLPointField::UINT32, seen_from);
  addField(cloud, "beyond", pcl::PCLPointField::FLOAT32, beyond);
  return cloud;
}

/** The map from above in grey, contradicted patches in red. */
void
draw(const std::filesystem::path& path,
     const VerifySource& source,
     const std::vector<ContradictedPoint>& points)
{
  constexpr std::size_t kMostMarks = 20000;
  constexpr Colour kRed{230, 40, 40};
  TopViewOptions options;
  options.title = "Contradicted points";
  options.final_label = "scanner";
  options.colour = PointColour::kPlain;
  TopViewScene scene;
  for (std::size_t i = 0; i < source.poses.size(); ++i) {
    const Points moved =
        transformed(source.scans.scans()[i].surfaces().points(), source.poses[i]);
    scene.points.insert(scene.points.end(), moved.begin(), moved.end());
  }
  scene.trajectory.poses = source.poses;
  std::vector<Eigen::Vector3f> red;
  for (const ContradictedPoint& point : points)
    if (point.clear)
      red.push_back(point.place);
  const std::size_t stride = std::max<std::size_t>(1, red.size() / kMostMarks);
  for (std::size_t i = 0; i < red.size(); i += stride)
    scene.overlay.marks.push_back({red[i].cast<double>(), kRed, 4});
  scene.overlay.keys.push_back({"contradicted", kRed});
  TopView(options).write(path, scene);
}
} // namespace

OutputRules
verifyFolderRules(const VerifySettings& s)
{
  OutputRules rules;
  rules.folder = s.out;
  rules.inputs = {s.poses};
  rules.inputs.insert(rules.inputs.end(), s.inputs.begin(), s.inputs.end());
  rules.program = kEvaluate;
  rules.marker = "verification.json";
  rules.files = std::regex("verification\\.(csv|json)|contradictions\\.(ply|png)");
  rules.force = s.force;
  return rules;
}

bool
publishVerification(FolderJob& job,
                    const VerifySettings& s,
                    const VerifySource& source,
                    const MapVerification& map)
{
  const OutputFolder& out = *job.out;
  std::vector<LinkCheck> links = map.links;
  for (LinkCheck& link : links) {
    link.from = source.indices[link.from];
    link.to = source.indices[link.to];
  }
  writeLinkChecks(out / "verification.csv", links);
  VerifiedMap of;
  of.generator = kEvaluate;
  of.map = s.inputs.front() + (s.isPair() ? " " + s.inputs.back() : "");
  of.pose_source = source.pose_source;
  of.voxel = source.scans.parameters().voxel.value;
  of.world_offset = source.world_offset;
  of.files = source.names;
  writeVerification(out / "verification.json", map, of);
  const auto points = contradictionsOf(s, source, map);
  writeScan(out / "contradictions.ply", cloudOf(points, source));
  job.publish();
  return job.draw("contradictions.png", [&](const std::filesystem::path& picture) {
    draw(picture, source, points);
  });
}

} // namespace pcl6d::app
