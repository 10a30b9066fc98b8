// SPDX-License-Identifier: BSD-3-Clause
#include "common/options/option_table.h"
#include "common/printable.h"
#include "evaluate/map/map_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl6d::app {

namespace {
/** A number in its column; a dash for a missing measure. */
std::string
cell(double value, int width, int digits)
{
  char text[64];
  if (std::isnan(value))
    std::snprintf(text, sizeof text, "%*s", width, "-");
  else
    std::snprintf(text, sizeof text, "%*.*f", width, digits, value);
  return text;
}

void
printValue(const char* name, double value, int digits, const char* note)
{
  std::printf("  %-28s%s  %s\n", name, cell(value, 10, digits).c_str(), note);
}

void
printDistances(const char* name, const SurfaceDistances& distances)
{
  const auto row = [&](const std::string& kind, const DistanceStatistics& s) {
    std::printf("  %-28s%s%s%s%s%s\n",
                kind.c_str(),
                cell(s.rms, 10, 4).c_str(),
                cell(s.mean, 10, 4).c_str(),
                cell(s.median, 10, 4).c_str(),
                cell(s.percentile_95, 10, 4).c_str(),
                cell(s.share_within, 10, 3).c_str());
  };
  if (distances.point.count == 0)
    return;
  row(std::string(name) + ", points", distances.point);
  row(std::string(name) + ", planes", distances.plane);
}

void
printMap(const MapQuality& quality)
{
  printValue("agreement", quality.agreement, 4, "share of points, larger is better");
  printValue("mean map entropy", quality.entropy, 4, "nat, smaller is better");
  printValue("plane spread [m]",
             std::sqrt(quality.plane_variance),
             4,
             "root of the mean plane variance");
  printValue("plane thickness [m]", quality.thickness.rms, 4, "rms of all planes");
  printValue("median thickness [m]", quality.thickness.median, 4, "of the planes");
  printValue("blur of revisits",
             quality.revisit_blur,
             3,
             "distance over the distance of successive scans");
  std::printf(
      "\ndistances [m]                      rms      mean    median      95 %%  "
      "share near\n");
  printDistances("overlapping scans", quality.others);
  printDistances("successive scans", quality.steps);
  printDistances("revisits", quality.revisits);
  printDistances("to the reference", quality.reference);
}

void
printScans(const MapReport& report, std::size_t rows)
{
  const MapQuality& quality = report.quality;
  const bool reference = quality.reference.point.count > 0;
  std::printf("\n%-20s%9s%11s%10s%10s%10s%s\n",
              "worst scans",
              "score",
              "agreement",
              "entropy",
              "thick [m]",
              "others",
              reference ? " reference" : "");
  const std::vector<std::size_t> order = quality.worstFirst();
  for (std::size_t k = 0; k < std::min(rows, order.size()); ++k) {
    const ScanQuality& scan = quality.scans[order[k]];
    std::printf("  %-18s%s%s%s%s%s%s  %s\n",
                printable(report.names[order[k]]).c_str(),
                cell(scan.worst_score, 9, 1).c_str(),
                cell(scan.agreement, 11, 4).c_str(),
                cell(scan.entropy, 10, 3).c_str(),
                cell(scan.thickness, 10, 4).c_str(),
                cell(scan.others.plane.rms, 10, 4).c_str(),
                reference ? cell(scan.reference.plane.rms, 10, 4).c_str() : "",
                joined(scan.stands_out, ", ").c_str());
  }
}
} // namespace

void
printTable(const MapReport& report, std::size_t rows)
{
  const MapQuality& quality = report.quality;
  std::printf("%s: %zu scans (poses: %s), voxel %.3g m\n"
              "%zu pairs of scans overlap, %zu of them revisits; %zu planes\n\n",
              printable(report.source.folder).c_str(),
              quality.scans.size(),
              printable(report.pose_source).c_str(),
              report.voxel,
              quality.pairs,
              quality.revisit_pairs,
              quality.thickness.planes.size());
  printMap(quality);
  printScans(report, rows);
  std::printf("\n%s\n", printableLines(quality.verdict(report.names)).c_str());
}

} // namespace pcl6d::app
