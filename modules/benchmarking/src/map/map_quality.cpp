// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_measuring.h"

#include <pcl6d/benchmarking/map_quality.h>
#include <pcl6d/benchmarking/outliers.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <sstream>

namespace pcl6d {
using namespace benchmarking;

namespace {
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
/** Least number of scans for outliers: fewer scans have no meaningful median. */
constexpr std::size_t kCrowd = 5;

/** A measure of single scans for the search of outliers. */
struct Measure {
  const char* name;
  double least_spread;                               ///< see robustScores()
  std::function<double(const ScanQuality&)> badness; ///< larger is worse
};

const std::array<Measure, 5>&
measures()
{
  static const std::array<Measure, 5> all{{
      {"agreement", 0.01, [](const ScanQuality& scan) { return -scan.agreement; }},
      {"entropy", 0.1, [](const ScanQuality& scan) { return scan.entropy; }},
      {"thickness", 0.001, [](const ScanQuality& scan) { return scan.thickness; }},
      {"distance to others",
       0.001,
       [](const ScanQuality& scan) { return scan.others.plane.rms; }},
      {"distance to reference",
       0.001,
       [](const ScanQuality& scan) { return scan.reference.plane.rms; }},
  }};
  return all;
}

void
nameOutliers(MapQuality& quality, double limit)
{
  std::vector<std::vector<std::pair<double, std::string>>> found(quality.scans.size());
  for (const Measure& measure : measures()) {
    std::vector<double> values;
    for (const ScanQuality& scan : quality.scans)
      values.push_back(measure.badness(scan));
    const std::vector<double> scores = robustScores(values, measure.least_spread);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      double& worst = quality.scans[i].worst_score;
      if (std::isnan(worst) || scores[i] > worst)
        worst = scores[i];
      if (scores[i] > limit && quality.scans.size() >= kCrowd)
        found[i].emplace_back(scores[i], measure.name);
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::stable_sort(found[i].begin(),
                     found[i].end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [score, name] : found[i])
      quality.scans[i].stands_out.push_back(name);
  }
}

SurfaceDistances
nothingMeasured()
{
  SurfaceDistances distances;
  distances.point = distances.plane = distanceStatistics({}, 0);
  distances.matched = kNothing;
  return distances;
}

void
checkInput(const std::vector<Points>& scans,
           const std::vector<Eigen::Isometry3d>& poses,
           const MapQualityOptions& options)
{
  options.validate();
  require(scans.size() >= 2, "number of scans", scans.size(), ">= 2");
  require(
      poses.size() == scans.size(), "number of poses", poses.size(), "one per scan");
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!isRigid(poses[i]))
      throw BadArgument("pose " + std::to_string(i) + " is no rigid motion");
}
} // namespace

void
MapQualityOptions::validate() const
{
  const auto positive = [](const char* name, double value) {
    require(std::isfinite(value) && value > 0, name, value, "finite and > 0");
  };
  positive("voxel", voxel);
  positive("radius", radius.value_or(1));
  positive("max_distance", max_distance.value_or(1));
  positive("within", within.value_or(1));
  positive("outlier", outlier);
  require(revisit_gap.value_or(2) >= 2, "revisit_gap", revisit_gap.value_or(2), ">= 2");
}

std::vector<std::size_t>
MapQuality::worstFirst() const
{
  std::vector<std::size_t> order(scans.size());
  std::iota(order.begin(), order.end(), 0);
  const auto score = [&](std::size_t i) {
    return std::isnan(scans[i].worst_score) ? -HUGE_VAL : scans[i].worst_score;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return score(a) > score(b);
  });
  return order;
}

std::string
MapQuality::verdict(const std::vector<std::string>& names) const
{
  require(names.size() == scans.size(), "names", names.size(), "one per scan");
  if (scans.size() < kCrowd)
    return "too few scans for one to stand out";
  std::ostringstream text;
  std::size_t count = 0;
  for (const std::size_t i : worstFirst()) {
    if (scans[i].stands_out.empty())
      continue;
    text << (count++ > 0 ? "; " : "") << names[i] << " (";
    for (std::size_t k = 0; k < scans[i].stands_out.size(); ++k)
      text << (k > 0 ? ", " : "") << scans[i].stands_out[k];
    text << ')';
  }
  if (count == 0)
    return "no scan stands out";
  return std::to_string(count) + " of " + std::to_string(scans.size()) +
         (count == 1 ? " scans stands out: " : " scans stand out: ") + text.str();
}

MapQuality
measureMap(const std::vector<Points>& scans,
           const std::vector<Eigen::Isometry3d>& poses,
           const MapQualityOptions& options,
           const Points& reference)
{
  checkInput(scans, poses, options);
  std::size_t done = 0;
  const auto report = [&](const char* stage) {
    if (options.progress)
      options.progress({stage, done++, 5});
  };
  report("preparing scans");
  MapMeasuring measuring(scans, poses, options);
  MapQuality quality;
  quality.scans.resize(scans.size());
  for (ScanQuality& scan : quality.scans) {
    scan.thickness = scan.worst_score = kNothing;
    scan.reference = nothingMeasured();
  }
  quality.reference = nothingMeasured();
  quality.thickness.rms = quality.thickness.median = kNothing;
  report("agreement");
  measuring.measureAgreement(quality);
  report("distances");
  measuring.measureDistances(quality);
  if (!reference.empty())
    measuring.measureReference(reference, quality);
  report("entropy");
  measuring.measureSpread(quality);
  report("planes");
  if (options.planes)
    measuring.measurePlanes(quality);
  nameOutliers(quality, options.outlier);
  return quality;
}

} // namespace pcl6d
