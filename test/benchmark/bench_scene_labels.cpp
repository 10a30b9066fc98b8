// SPDX-License-Identifier: BSD-3-Clause
/* Labels and refined models of simulated scenes, measured against the truth: a table,
 * one line per seed. Arguments: scene, first seed, last seed. */
#include "support/labelled_map.h"

#include <pcl6d/plane_segmentation/segment_planes.h>
#include <pcl6d/scene_interpretation/interpretation.h>
#include <pcl6d/scene_interpretation/model_refinement.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>

namespace {
using pcl6d::test::LabelledMap;

constexpr double kDegree = 0.017453292519943295; // [rad]
constexpr std::size_t kSeen = 1000;              // points on a door that was seen

struct Scores {
  double labelled = 0, right = 0; // [m^2] floor, ceiling, wall as found
  double truth = 0, covered = 0;  // [m^2] on planes found, by the label of its points
  std::size_t doors = 0, found = 0, claimed = 0, confirmed = 0;
};

bool
isStructure(const std::string& label)
{
  return label == "floor" || label == "ceiling" || label == "wall";
}

// Truth of a segment: the share of its points per id.
std::map<std::uint32_t, double>
sharesOf(const LabelledMap& map, const pcl6d::PlaneSegment& segment)
{
  std::map<std::uint32_t, double> shares;
  for (const auto i : segment.points)
    shares[map.plane_id[i]] += 1.0 / static_cast<double>(segment.points.size());
  return shares;
}

std::string
labelOf(const LabelledMap& map, std::uint32_t id)
{
  return id == 0 ? "none" : map.truth[id - 1].label;
}

std::uint32_t
largestOf(const std::map<std::uint32_t, double>& shares)
{
  return std::max_element(shares.begin(),
                          shares.end(),
                          [](auto& a, auto& b) { return a.second < b.second; })
      ->first;
}

void
printMissed(const LabelledMap& map,
            const std::vector<pcl6d::PlaneSegment>& segments,
            const pcl6d::Interpretation& labels,
            std::uint32_t id)
{
  const auto door = pcl6d::levelledPlane(
      map.truth[id - 1], Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  const auto seen = std::count(map.plane_id.begin(), map.plane_id.end(), id);
  std::printf("  missed door id %u, %zd points, centre %.2f %.2f normal %.2f %.2f:\n",
              id,
              seen,
              door.centre.x(),
              door.centre.y(),
              door.normal.x(),
              door.normal.y());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto shares = sharesOf(map, segments[i]);
    const auto size = static_cast<double>(segments[i].points.size());
    if (shares.count(id) > 0 && shares.at(id) * size > 0.05 * seen)
      std::printf("    %.0f points of area %.2f in %s",
                  shares.at(id) * size,
                  segments[i].plane.area,
                  explanationText(labels, i).c_str());
  }
}

void
scoreSegments(const LabelledMap& map,
              const std::vector<pcl6d::PlaneSegment>& segments,
              const pcl6d::Interpretation& labels,
              bool is_verbose,
              Scores& scores)
{
  std::set<std::uint32_t> doors_found;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const std::string& label = labels.labels[i];
    const auto shares = sharesOf(map, segments[i]);
    const std::string truth = labelOf(map, largestOf(shares));
    const double area = segments[i].plane.area;
    for (const auto& [id, share] : shares)
      if (isStructure(labelOf(map, id))) {
        scores.truth += area * share;
        scores.covered += labelOf(map, id) == label ? area * share : 0;
      }
    if (isStructure(label)) {
      scores.labelled += area;
      scores.right += label == truth ? area : 0;
    }
    if (label == "door") {
      ++scores.claimed;
      scores.confirmed += truth == "door" ? 1 : 0;
      if (truth == "door")
        doors_found.insert(largestOf(shares));
    }
    if (is_verbose && label != truth) {
      const auto p = levelledPlane(
          segments[i].plane, Eigen::Matrix3d::Identity(), segments[i].seen_from);
      std::printf(
          "  truth %s (id %u, %.2f), area %.2f width %.2f length %.2f z %.3f..%.3f "
          "centre %.2f %.2f normal %.2f %.2f: %s",
          truth.c_str(),
          largestOf(shares),
          shares.at(largestOf(shares)),
          area,
          p.width,
          p.length,
          p.bottom,
          p.top,
          p.centre.x(),
          p.centre.y(),
          p.normal.x(),
          p.normal.y(),
          explanationText(labels, i).c_str());
    }
  }
  std::vector<std::size_t> seen(map.truth.size() + 1, 0);
  for (const auto id : map.plane_id)
    ++seen[id];
  for (std::size_t id = 1; id <= map.truth.size(); ++id) {
    if (labelOf(map, static_cast<std::uint32_t>(id)) != "door" || seen[id] < kSeen ||
        map.truth[id - 1].area < 1)
      continue;
    ++scores.doors;
    const bool is_found = doors_found.count(static_cast<std::uint32_t>(id)) > 0;
    scores.found += is_found ? 1 : 0;
    if (is_verbose && !is_found)
      printMissed(map, segments, labels, static_cast<std::uint32_t>(id));
  }
}

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
      "labels %s %2llu planes %3zu right %.4f recall %.4f doors %zu/%zu claimed "
      "%zu/%zu storeys %zu nodes %zu seconds %.3f segmentation %.2f status %s\n",
      scene.c_str(),
      static_cast<unsigned long long>(seed),
      found.planes.size(),
      s.right / s.labelled,
      s.covered / s.truth,
      s.found,
      s.doors,
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
