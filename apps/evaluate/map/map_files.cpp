// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/map/map_report.h"
#include "evaluate/result_json.h"

#include <pcl6d/io/json_numbers.h>

#include <cmath>
#include <ostream>

namespace pcl6d::app {

namespace {

Json
toJson(const DistanceStatistics& s)
{
  return {{"count", s.count},
          {"rms", s.rms},
          {"mean", s.mean},
          {"median", s.median},
          {"percentile_95", s.percentile_95},
          {"share_within", s.share_within}};
}

Json
toJson(const SurfaceDistances& distances)
{
  return {{"matched", distances.matched},
          {"point", toJson(distances.point)},
          {"plane", toJson(distances.plane)}};
}

Json
toJson(const std::string& name, const ScanQuality& scan, bool reference)
{
  Json json = {{"file", name},
               {"neighbours", scan.neighbours},
               {"agreement", scan.agreement},
               {"entropy", scan.entropy},
               {"plane_variance", scan.plane_variance},
               {"thickness", scan.thickness},
               {"others", toJson(scan.others)}};
  if (reference)
    json["reference"] = toJson(scan.reference);
  json["worst_score"] = scan.worst_score;
  json["stands_out"] = scan.stands_out;
  return json;
}

Json
toJson(const ThickPlane& thick)
{
  const Plane& plane = thick.plane;
  return {{"normal", {plane.normal.x(), plane.normal.y(), plane.normal.z()}},
          {"offset", plane.offset},
          {"area", plane.area},
          {"points", plane.inliers},
          {"scans", thick.scans},
          {"thickness", thick.thickness}};
}
} // namespace

std::string
toJson(const MapReport& report)
{
  const MapQuality& quality = report.quality;
  const bool reference = quality.reference.point.count > 0;
  Json json = {{"schema_version", 1},
               {"map", report.source.folder},
               {"pose_source", report.pose_source},
               {"voxel", report.voxel},
               {"pairs", quality.pairs},
               {"revisit_pairs", quality.revisit_pairs},
               {"agreement", quality.agreement},
               {"entropy", quality.entropy},
               {"plane_variance", quality.plane_variance},
               {"spread_points", quality.spread_points},
               {"thickness", quality.thickness.rms},
               {"median_thickness", quality.thickness.median},
               {"revisit_blur", quality.revisit_blur}};
  json["others"] = toJson(quality.others);
  json["steps"] = toJson(quality.steps);
  json["revisits"] = toJson(quality.revisits);
  if (reference) {
    json["reference_cloud"] = report.source.reference;
    json["reference"] = toJson(quality.reference);
  }
  json["verdict"] = quality.verdict(report.names);
  Json planes = Json::array(), scans = Json::array();
  for (const ThickPlane& plane : quality.thickness.planes)
    planes.push_back(toJson(plane));
  for (std::size_t i = 0; i < quality.scans.size(); ++i)
    scans.push_back(toJson(report.names[i], quality.scans[i], reference));
  json["planes"] = std::move(planes);
  json["scans"] = std::move(scans);
  // File names need not be UTF-8, but JSON must be.
  return jsonFileText(json, 2);
}

void
writeCsv(std::ostream& stream, const MapReport& report)
{
  stream.precision(17);
  stream << "file,neighbours,agreement,entropy,plane_variance,thickness,others_rms,"
            "others_median,others_95,reference_rms,worst_score,stands_out\n";
  const auto put = [&](double value) {
    if (!std::isnan(value))
      stream << value;
    stream << ',';
  };
  for (std::size_t i = 0; i < report.quality.scans.size(); ++i) {
    const ScanQuality& scan = report.quality.scans[i];
    stream << report.names[i] << ',' << scan.neighbours << ',';
    for (const double value : {scan.agreement,
                               scan.entropy,
                               scan.plane_variance,
                               scan.thickness,
                               scan.others.plane.rms,
                               scan.others.plane.median,
                               scan.others.plane.percentile_95,
                               scan.reference.plane.rms,
                               scan.worst_score})
      put(value);
    for (std::size_t k = 0; k < scan.stands_out.size(); ++k)
      stream << (k > 0 ? "; " : "") << scan.stands_out[k];
    stream << '\n';
  }
}

} // namespace pcl6d::app
