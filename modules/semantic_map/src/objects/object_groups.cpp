// SPDX-License-Identifier: BSD-3-Clause
#include "objects/object_groups.h"
#include "objects/object_shape.h"

#include <algorithm>
#include <cmath>

namespace pcl6d::semantic_map {
namespace {
/** \return the share of the box of an object inside the box of another, from a grid of
 * points */
double
shareInside(const ObjectPose& object, const ObjectPose& other)
{
  constexpr int kGrid = 10; // points along each side
  const Eigen::Isometry3d T_other_object =
      other.T_world_object.inverse() * object.T_world_object;
  const Eigen::Vector3d step = object.box.sizes() / kGrid;
  int inside = 0;
  for (int x = 0; x < kGrid; ++x)
    for (int y = 0; y < kGrid; ++y)
      for (int z = 0; z < kGrid; ++z) {
        const Eigen::Vector3d place =
            object.box.min() +
            step.cwiseProduct(Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5));
        inside += other.box.contains(T_other_object * place) ? 1 : 0;
      }
  return static_cast<double>(inside) / (kGrid * kGrid * kGrid);
}

Eigen::Vector3d
centreOf(const MapObject& object)
{
  return object.pose.T_world_object * object.pose.box.center();
}

bool
shareScan(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b)
{
  return std::any_of(a.begin(), a.end(), [&](std::size_t scan) {
    return std::find(b.begin(), b.end(), scan) != b.end();
  });
}

struct Pair {
  std::size_t a;
  std::size_t b;
  double overlap;
};

/** Joins groups by falling overlap. */
class Grouping {
public:
  Grouping(const std::vector<MapObject>& observations, const FusionOptions& options)
  : observations_(observations), options_(options)
  {
    for (std::size_t i = 0; i < observations.size(); ++i) {
      groups_.push_back({i});
      scans_.push_back(observations[i].scans);
      group_of_.push_back(i);
    }
  }

  void
  join(std::size_t i, std::size_t j)
  {
    const std::size_t a = std::min(group_of_[i], group_of_[j]);
    const std::size_t b = std::max(group_of_[i], group_of_[j]);
    if (a == b || shareScan(scans_[a], scans_[b]) ||
        meanOverlap(groups_[a], groups_[b]) < options_.min_overlap)
      return;
    for (const auto member : groups_[b])
      group_of_[member] = a;
    groups_[a].insert(groups_[a].end(), groups_[b].begin(), groups_[b].end());
    scans_[a].insert(scans_[a].end(), scans_[b].begin(), scans_[b].end());
    groups_[b].clear();
  }

  std::vector<std::vector<std::size_t>>
  groups()
  {
    std::vector<std::vector<std::size_t>> all;
    for (auto& group : groups_) {
      std::sort(group.begin(), group.end());
      if (!group.empty())
        all.push_back(group);
    }
    return all;
  }

private:
  double
  meanOverlap(const std::vector<std::size_t>& a,
              const std::vector<std::size_t>& b) const
  {
    double sum = 0;
    for (const auto i : a)
      for (const auto j : b)
        sum += overlapOf(observations_[i], observations_[j], options_.max_distance);
    return sum / static_cast<double>(a.size() * b.size());
  }

  const std::vector<MapObject>& observations_;
  const FusionOptions& options_;
  std::vector<std::vector<std::size_t>> groups_; // by their first member; else empty
  std::vector<std::vector<std::size_t>> scans_;
  std::vector<std::size_t> group_of_;
};
} // namespace

double
overlapOf(const MapObject& a, const MapObject& b, double max_distance)
{
  const double apart = (centreOf(a) - centreOf(b)).norm();
  const double va = a.pose.box.volume(), vb = b.pose.box.volume();
  if (!(va > 0 && vb > 0))
    return std::max(0.0, 1 - apart / max_distance);
  if (apart > (a.pose.box.diagonal().norm() + b.pose.box.diagonal().norm()) / 2)
    return 0;
  // the mean of both sides is independent of their order
  const double common =
      (shareInside(a.pose, b.pose) * va + shareInside(b.pose, a.pose) * vb) / 2;
  return std::min(1.0, common / (va + vb - common));
}

std::vector<std::vector<std::size_t>>
groupObservations(const std::vector<MapObject>& observations,
                  const FusionOptions& options)
{
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < observations.size(); ++i)
    for (std::size_t j = i + 1; j < observations.size(); ++j) {
      if (observations[i].pose.object_class != observations[j].pose.object_class ||
          shareScan(observations[i].scans, observations[j].scans))
        continue;
      const double overlap =
          overlapOf(observations[i], observations[j], options.max_distance);
      if (overlap >= options.min_overlap)
        pairs.push_back({i, j, overlap});
    }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.overlap > b.overlap;
  });
  Grouping grouping(observations, options);
  for (const auto& pair : pairs)
    grouping.join(pair.a, pair.b);
  return grouping.groups();
}

} // namespace pcl6d::semantic_map
