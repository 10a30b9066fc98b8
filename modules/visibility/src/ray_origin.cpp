// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/search/point_tree.h>
#include <pcl6d/visibility/ray_origin.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d {

namespace {
/** Points in use: directions of a whole sphere are then 0.8 deg apart. */
constexpr std::size_t kMostRays = 60000;
/** Number of tested rays: a share of a tenth is estimated to 1 %. */
constexpr std::size_t kTestedRays = 1000;
/** Neighbours of a ray: eight for each quadrant, or four if two surfaces share the quadrants. */
constexpr std::size_t kBeside = 32;
/** Ranges of a surface differ by less than this number of widths of a neighbourhood: tan 72 deg. */
constexpr float kSteepest = 3;
/** A crossed surface has at least half as many points as the surface behind. Glass that returns one
 * ray in five has fewer. */
constexpr std::size_t kDensest = 2;
/** The largest share of a true origin. More than 20 recorded and simulated sets have less than
 * 0.06 (parts of street the most), closed rooms seen from 5 m to 6 km outside 0.1 to 0.34. */
constexpr double kMostCrossed = 0.1;

/** Directions of the rays of a scan, as points of the unit sphere, and their ranges [m]. */
struct Directions {
  Points units;
  std::vector<float> ranges;
};

Directions
directionsOf(const Points& measured, const Eigen::Vector3f& origin)
{
  Directions rays;
  const std::size_t stride = (measured.size() + kMostRays - 1) / kMostRays;
  for (std::size_t i = 0; i < measured.size(); i += std::max<std::size_t>(1, stride)) {
    const Eigen::Vector3f ray = measured[i] - origin;
    const float range = ray.norm();
    if (!(range > 0) || !std::isfinite(range))
      continue;
    rays.units.emplace_back(ray / range);
    rays.ranges.push_back(range);
  }
  return rays;
}

/** Quadrants of the plane across a ray with neighbours of a surface. */
class Surround {
public:
  explicit Surround(const Eigen::Vector3f& unit)
  : right_(unit.unitOrthogonal()), up_(unit.cross(right_))
  {}

  void
  add(const Eigen::Vector3f& offset)
  {
    const std::size_t quadrant =
        (right_.dot(offset) > 0 ? 1U : 0U) + (up_.dot(offset) > 0 ? 2U : 0U);
    filled_[quadrant] = true;
    ++count_;
  }
  bool
  isClosed() const
  {
    return std::all_of(filled_.begin(), filled_.end(), [](bool is) { return is; });
  }

  std::size_t
  count() const
  {
    return count_;
  }

private:
  Eigen::Vector3f right_, up_;
  std::array<bool, 4> filled_{};
  std::size_t count_ = 0;
};

enum class Crossing { kNone, kCrossed, kUndecided };

Crossing
crossingOf(std::size_t ray, const Directions& rays, const PointTree& tree)
{
  const Eigen::Vector3f unit = rays.units[ray];
  const std::vector<Neighbour> beside = tree.nearestK(unit, kBeside);
  const float range = rays.ranges[ray];
  const float width = std::sqrt(beside.back().distance_sq) * range;
  std::vector<float> nearer;
  Surround own(unit), crossed(unit);
  const auto offsetOf = [&](const Neighbour& n) -> Eigen::Vector3f {
    return rays.units[static_cast<std::size_t>(n.index)] - unit;
  };
  for (const Neighbour& n : beside) {
    const float other = rays.ranges[static_cast<std::size_t>(n.index)];
    if (n.distance_sq > 0 && std::abs(other - range) <= kSteepest * width)
      own.add(offsetOf(n));
    if (other < range - kSteepest * width)
      nearer.push_back(other);
  }
  if (!own.isClosed())
    return Crossing::kUndecided;
  if (nearer.empty())
    return Crossing::kNone;
  // Only nearer points of a single surface count, not scattered points, e.g. of leaves.
  const auto middle = nearer.begin() + static_cast<long>(nearer.size() / 2);
  std::nth_element(nearer.begin(), middle, nearer.end());
  for (const Neighbour& n : beside) {
    const float other = rays.ranges[static_cast<std::size_t>(n.index)];
    if (other < range - kSteepest * width &&
        std::abs(other - *middle) <= 0.5F * kSteepest * width)
      crossed.add(offsetOf(n));
  }
  const bool is_dense = kDensest * crossed.count() >= own.count();
  return is_dense && crossed.isClosed() ? Crossing::kCrossed : Crossing::kNone;
}
} // namespace

double
crossedShare(const Points& measured, const Eigen::Vector3f& origin)
{
  const Directions rays = directionsOf(measured, origin);
  if (rays.units.size() < kBeside)
    return 0;
  const PointTree tree(rays.units, 1);
  const std::size_t stride = std::max<std::size_t>(1, rays.units.size() / kTestedRays);
  std::size_t crossed = 0, decided = 0;
  for (std::size_t i = 0; i < rays.units.size(); i += stride) {
    const Crossing crossing = crossingOf(i, rays, tree);
    crossed += crossing == Crossing::kCrossed ? 1 : 0;
    decided += crossing == Crossing::kUndecided ? 0 : 1;
  }
  return decided == 0 ? 0 : static_cast<double>(crossed) / static_cast<double>(decided);
}

bool
isPlausibleOrigin(const Points& measured, const Eigen::Vector3f& origin)
{
  return crossedShare(measured, origin) <= kMostCrossed;
}

RayImage
plausibleRays(const Points& measured, const RayImageOptions& options)
{
  options.validate();
  return isPlausibleOrigin(measured, options.origin) ? RayImage(measured, options)
                                                     : RayImage();
}

} // namespace pcl6d
