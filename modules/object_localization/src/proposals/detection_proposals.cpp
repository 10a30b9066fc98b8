// SPDX-License-Identifier: BSD-3-Clause
#include "proposals/footprint_box.h"
#include "proposals/support_planes.h"

#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/detection_proposals.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace object_localization;

namespace {
constexpr std::size_t kFewest = 10; // points of an object
constexpr double kBelow = 0.05;     // [m] largest depth of its points below the support

/** In the box of a detection, the points of the nearest surface, up to the depth of the
 * object; points behind are background. */
std::vector<std::uint32_t>
foreground(const Points& points,
           const std::vector<std::size_t>& places,
           const std::vector<char>& is_background,
           double depth)
{
  std::vector<std::pair<float, std::uint32_t>> by_range;
  for (const auto place : places)
    if (!is_background[place])
      by_range.emplace_back(points[place].norm(), static_cast<std::uint32_t>(place));
  std::sort(by_range.begin(), by_range.end());
  const auto reach = static_cast<float>(depth);
  std::vector<std::uint32_t> best;
  for (std::size_t begin = 0, end = 0; begin < by_range.size(); ++begin) {
    while (end < by_range.size() && by_range[end].first < by_range[begin].first + reach)
      ++end;
    if (end - begin < kFewest)
      continue;
    for (std::size_t i = begin; i < end; ++i)
      best.push_back(by_range[i].second);
    break;
  }
  std::sort(best.begin(), best.end());
  return best;
}

/** \return which points are on supporting planes or on walls */
std::vector<char>
backgroundOf(const PlaneCloud& cloud,
             const PlaneSegments& planes,
             const SceneSupports& supports)
{
  std::vector<char> is_background(cloud.points().size(), 0);
  std::vector<std::uint32_t> finite(
      cloud.places().empty() ? 0 : cloud.places().back() + 1, 0);
  for (std::uint32_t i = 0; i < cloud.places().size(); ++i)
    finite[cloud.places()[i]] = i;
  for (std::size_t k = 0; k < planes.planes.size(); ++k)
    if (supports.roles[k] == PlaneRole::kBase ||
        supports.roles[k] == PlaneRole::kStructure)
      for (const auto place : planes.planes[k].points)
        is_background[finite[place]] = 1;
  return is_background;
}

/** \return the next level plane below the points; nullopt without one */
std::optional<std::size_t>
supportBelow(const SceneSupports& supports, const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points)
    sum += p.cast<double>();
  const Eigen::Vector3f middle =
      (sum / static_cast<double>(points.size())).cast<float>();
  std::optional<std::size_t> best;
  double nearest = INFINITY;
  for (std::size_t k = 0; k < supports.prisms.size(); ++k) {
    const PlaneRole role = supports.roles[k];
    if ((role != PlaneRole::kBase && role != PlaneRole::kRaised) ||
        !supports.prisms[k].covers(middle, ProposalOptions().overhang))
      continue;
    double low = INFINITY;
    for (const auto& p : points)
      low = std::min(low, supports.prisms[k].height(p));
    if (low > -kBelow && low < nearest) {
      nearest = low;
      best = k;
    }
  }
  return best;
}
} // namespace

std::vector<ObjectProposal>
proposeDetections(const PlaneCloud& cloud,
                  const PlaneSegments& planes,
                  const std::vector<DetectedObject>& detections,
                  double depth)
{
  require(depth > 0 && std::isfinite(depth), "depth", depth, "> 0");
  const SceneSupports supports = findSupports(cloud, planes, {});
  const auto is_background = backgroundOf(cloud, planes, supports);
  std::vector<ObjectProposal> proposals;
  for (const auto& detection : detections) {
    const auto places =
        foreground(cloud.points(), detection.points, is_background, depth);
    if (places.size() < kFewest)
      continue;
    Points points;
    for (const auto place : places)
      points.push_back(cloud.points()[place]);
    const auto support = supportBelow(supports, points);
    if (!support)
      continue;
    const double height = supports.up.dot(points.front().cast<double>()) -
                          supports.prisms[*support].height(points.front());
    const FootprintBox box = footprintBox(points, supports.up, height);
    ObjectProposal proposal;
    proposal.points = places;
    proposal.T_scene_box = box.T_scene_box;
    proposal.size = box.size;
    proposal.support = *support;
    proposals.push_back(std::move(proposal));
  }
  return proposals;
}

} // namespace pcl6d
