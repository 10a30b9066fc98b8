// SPDX-License-Identifier: BSD-3-Clause
/* Labels and refined models of simulated scenes, measured against the truth: a table,
 * one line per seed. Arguments: scene, first seed, last seed. */
#include "label_scores.h"

#include <pcl6d/plane_segmentation/segment_planes.h>
#include <pcl6d/scene_interpretation/interpretation.h>
#include <pcl6d/scene_interpretation/model_refinement.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace {
using pcl6d::test::LabelledMap;
using pcl6d::test::largestOf;
using pcl6d::test::Scores;
using pcl6d::test::sharesOf;

constexpr double kDegree = 0.017453292519943295; // [rad]

// Root mean square distance [m] of structural points to their true planes.
double
distanceToTruth(const LabelledMap& map,
                const pcl6d::Points& points,
                const std::vector<pcl6d::PlaneSegment>& segments)
{
  double sum = 0, count = 0;
  for (const auto& segment : segments)
    for (const auto i : segment.points) {
      if (map.plane_id[i] == 0 || segment.plane.label == "none")
        continue;
      const pcl6d::Plane& plane = map.truth[map.plane_id[i] - 1];
      const double d = plane.normal.dot(points[i].cast<double>()) - plane.offset;
      sum += d * d;
      ++count;
    }
  return std::sqrt(sum / std::max(count, 1.0));
}

// Mean angle [rad] of planes to the true ones that most of their points lie on, weighted
// by area.
double
angleToTruth(const LabelledMap& map,
             const std::vector<pcl6d::PlaneSegment>& segments,
             const std::vector<pcl6d::PlaneSegment>& planes)
{
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto id = largestOf(sharesOf(map, segments[i]));
    if (id == 0 || segments[i].plane.label == "none")
      continue;
    const double cosine =
        std::abs(planes[i].plane.normal.dot(map.truth[id - 1].normal));
    sum += segments[i].plane.area * std::acos(std::min(cosine, 1.0));
    area += segments[i].plane.area;
  }
  return sum / std::max(area, 1e-9);
}

// The points put onto the planes that were fitted to them.
pcl6d::Points
ontoFits(const LabelledMap& map, const std::vector<pcl6d::PlaneSegment>& segments)
{
  pcl6d::Points points = map.points;
  for (const auto& [plane, places, seen_from, outline] : segments)
    for (const auto i : places) {
      const Eigen::Vector3d p = points[i].cast<double>();
      points[i] =
          (p - (plane.normal.dot(p) - plane.offset) * plane.normal).cast<float>();
    }
  return points;
}

double
secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
}

pcl6d::PlaneSegments
segmentsOf(const LabelledMap& map)
{
  pcl6d::PlaneCloudOptions options;
  options.viewpoints = map.viewpoints;
  return segmentPlanes(pcl6d::PlaneCloud(map.points, options));
}

void
printLabels(const std::string& scene, std::uint64_t seed, bool is_verbose)
{
  const LabelledMap map = pcl6d::test::makeLabelledMap(scene, seed, 0.01);
  auto start = std::chrono::steady_clock::now();
  const pcl6d::PlaneSegments found = segmentsOf(map);
  const double segmentation = secondsSince(start);
  start = std::chrono::steady_clock::now();
  const auto labels = interpretScene(found.planes);
  const double seconds = secondsSince(start);
  Scores s;
  scoreSegments(map, found.planes, labels, is_verbose, s);
  std::printf(
      "labels %s %2llu planes %3zu right %.4f recall %.4f doors %zu/%zu faces %zu/%zu "
      "claimed "
      "%zu/%zu storeys %zu nodes %zu seconds %.3f segmentation %.2f status %s\n",
      scene.c_str(),
      static_cast<unsigned long long>(seed),
      found.planes.size(),
      s.right / s.labelled,
      s.covered / s.truth,
      s.doors_found.size(),
      s.doors.size(),
      s.faces_found,
      s.faces,
      s.confirmed,
      s.claimed,
      labels.storeys.size(),
      labels.nodes,
      seconds,
      segmentation,
      toString(labels.status));
  std::fflush(stdout);
}

void
printRefinement(const std::string& scene, std::uint64_t seed, bool is_verbose)
{
  const LabelledMap map =
      pcl6d::test::makeLabelledMap(scene, seed, 0.01, {0.2 * kDegree, 0.003});
  pcl6d::PlaneSegments found = segmentsOf(map);
  applyLabels(interpretScene(found.planes), found.planes);
  const auto start = std::chrono::steady_clock::now();
  const auto model = refineModel(found.planes, map.points);
  const double seconds = secondsSince(start);
  pcl6d::RefinementOptions options;
  options.project = false;
  const auto turned = refineModel(found.planes, map.points, options);
  std::size_t refused = 0, changed = 0;
  for (std::size_t i = 0; i < model.changes.size(); ++i) {
    refused += model.changes[i].refusal.empty() ? 0 : 1;
    changed += model.changes[i].kind == pcl6d::RefinedKind::kUnchanged ? 0 : 1;
    if (is_verbose && !model.changes[i].refusal.empty())
      std::printf("  %s %.2f m^2: %s\n",
                  found.planes[i].plane.label.c_str(),
                  found.planes[i].plane.area,
                  model.changes[i].refusal.c_str());
  }
  std::printf("refinement %s %2llu changed %zu refused %zu frames %zu rms [mm] points "
              "%.3f turned %.3f fits %.3f refined %.3f angle [deg] before %.4f after "
              "%.4f seconds %.3f\n",
              scene.c_str(),
              static_cast<unsigned long long>(seed),
              changed,
              refused,
              model.headings.size(),
              1e3 * distanceToTruth(map, map.points, found.planes),
              1e3 * distanceToTruth(map, turned.points, found.planes),
              1e3 * distanceToTruth(map, ontoFits(map, found.planes), found.planes),
              1e3 * distanceToTruth(map, model.points, found.planes),
              angleToTruth(map, found.planes, found.planes) / kDegree,
              angleToTruth(map, found.planes, model.planes) / kDegree,
              seconds);
  std::fflush(stdout);
}
} // namespace

int
main(int argc, char** argv)
{
  const std::string scene = argc > 1 ? argv[1] : "rooms";
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const std::uint64_t last = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : first;
  const std::string words = argc > 4 ? argv[4] : "";
  const bool is_verbose = words.find("v") != std::string::npos;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    printLabels(scene, seed, is_verbose);
    if (words.find("r") != std::string::npos)
      printRefinement(scene, seed, is_verbose);
  }
}
