// SPDX-License-Identifier: BSD-3-Clause
#include "label_scores.h"

#include <algorithm>
#include <cstdio>

namespace pcl6d::test {
namespace {
constexpr std::size_t kSeen = 1000; // points on a door that was seen

bool
isStructure(const std::string& label)
{
  return label == "floor" || label == "ceiling" || label == "wall";
}

std::string
labelOf(const LabelledMap& map, std::uint32_t id)
{
  return id == 0 ? "none" : map.truth[id - 1].label;
}

// The first face of the door that a face belongs to.
std::uint32_t
doorOf(const LabelledMap& map, std::uint32_t id)
{
  constexpr double kThick = 0.2; // [m]
  const auto centre = [&](std::uint32_t i) {
    return pcl6d::levelledPlane(
               map.truth[i - 1], Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero())
        .centre;
  };
  for (std::uint32_t other = 1; other < id; ++other)
    if (labelOf(map, other) == "door" && map.truth[other - 1].area > 1 &&
        (centre(other) - centre(id)).norm() < kThick)
      return other;
  return id;
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
} // namespace

std::map<std::uint32_t, double>
sharesOf(const LabelledMap& map, const pcl6d::PlaneSegment& segment)
{
  std::map<std::uint32_t, double> shares;
  for (const auto i : segment.points)
    shares[map.plane_id[i]] += 1.0 / static_cast<double>(segment.points.size());
  return shares;
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
    ++scores.faces;
    const std::uint32_t door = doorOf(map, static_cast<std::uint32_t>(id));
    scores.doors.insert(door);
    const bool is_found = doors_found.count(static_cast<std::uint32_t>(id)) > 0;
    scores.faces_found += is_found ? 1 : 0;
    if (is_found)
      scores.doors_found.insert(door);
    if (is_verbose && !is_found)
      printMissed(map, segments, labels, static_cast<std::uint32_t>(id));
  }
}

} // namespace pcl6d::test
