// SPDX-License-Identifier: BSD-3-Clause
#include "proposals/cavities.h"

#include <pcl6d/common/components.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace pcl6d::object_localization {

namespace {
constexpr std::size_t kLeastSurfels = 20; // surfels of a tested set
constexpr double kInwards =
    -0.3;                      // mean cosine, in plan, of normals and the way outwards
constexpr double kReach = 0.4; // [of a cavity's width] from its inside to its outside
constexpr double kSameWidth = 0.7; // least ratio of both widths
constexpr double kSameTop = 0.2;   // [of the width] difference in height of both tops

/** Outline of a set of surfels. */
struct Shell {
  Points points;
  Eigen::AlignedBox3f box;
  float width = 0; // [m] in plan
  float top = 0;   // [m]
  bool faces_inwards = false;
};

Shell
shellOf(const Surfels& surfels,
        const SurfelGraph& graph,
        const Eigen::Vector3f& up,
        const std::vector<std::uint32_t>& set)
{
  Shell shell;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto i : set) {
    const Eigen::Vector3f& point = surfels.points[graph.surfels[i]];
    shell.points.push_back(point);
    shell.box.extend(point);
    sum += point.cast<double>();
  }
  const Eigen::Vector3f middle = (sum / static_cast<double>(set.size())).cast<float>();
  shell.top = -INFINITY;
  double cosines = 0;
  for (const auto i : set) {
    const auto s = graph.surfels[i];
    shell.top = std::max(shell.top, up.dot(surfels.points[s]));
    Eigen::Vector3f out = surfels.points[s] - middle;
    out -= up.dot(out) * up;
    shell.width = std::max(shell.width, 2 * out.norm());
    if (out.squaredNorm() > 0)
      cosines += surfels.normals[s].dot(out.normalized());
  }
  shell.faces_inwards = set.size() >= kLeastSurfels &&
                        cosines < kInwards * static_cast<double>(set.size());
  return shell;
}

/** Whether two shells may have a rim in common. */
bool
shareRim(const Shell& a, const Shell& b)
{
  return std::min(a.width, b.width) > kSameWidth * std::max(a.width, b.width) &&
         std::abs(a.top - b.top) < kSameTop * a.width;
}

/** \return the squared distance of two shells, at most a limit */
float
distanceSq(const Shell& a, const Shell& b, float limit)
{
  float least = limit;
  for (const auto& p : a.points)
    if (b.box.squaredExteriorDistance(p) < least)
      for (const auto& q : b.points)
        least = std::min(least, (p - q).squaredNorm());
  return least;
}
} // namespace

void
joinCavities(const PlaneCloud& cloud,
             const SurfelGraph& graph,
             const Eigen::Vector3d& up,
             SurfelSets& sets)
{
  std::vector<Shell> shells;
  for (const auto& set : sets)
    shells.push_back(shellOf(cloud.surfels(), graph, up.cast<float>(), set));
  Components components(sets.size());
  for (std::size_t inside = 0; inside < sets.size(); ++inside) {
    if (!shells[inside].faces_inwards)
      continue;
    const auto reach = static_cast<float>(kReach) * shells[inside].width;
    float least = reach * reach;
    std::size_t nearest = inside;
    for (std::size_t k = 0; k < sets.size(); ++k) {
      if (k == inside || sets[k].size() < kLeastSurfels ||
          !shareRim(shells[inside], shells[k]))
        continue;
      const float distance = distanceSq(shells[inside], shells[k], least);
      if (distance < least) {
        least = distance;
        nearest = k;
      }
    }
    components.join(inside, nearest);
  }
  std::map<std::size_t, std::vector<std::uint32_t>> joined;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    auto& all = joined[components.firstOf(k)];
    all.insert(all.end(), sets[k].begin(), sets[k].end());
  }
  sets.clear();
  for (auto& [first, set] : joined) {
    std::sort(set.begin(), set.end());
    sets.push_back(std::move(set));
  }
}

} // namespace pcl6d::object_localization
