// SPDX-License-Identifier: BSD-3-Clause
#include "range_image_peer.h"

#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pcl6d::bench {

namespace {
constexpr std::size_t kRemoving = 3, kAll = 5;
constexpr std::array<double, kAll> kPixels{2.5, 2.0, 1.5, 1.0, 0.7}; // per degree
constexpr float kMargin = 0.05F;   // of the range that the scan measured
constexpr double kMapVoxel = 0.05; // [m]
constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr float kNothing = std::numeric_limits<float>::infinity();

/** A direction [deg], azimuth in [0, 360), elevation in [0, 180), and a range [m]. */
struct Sphere {
  double azimuth, elevation;
  float range;

  explicit Sphere(const Eigen::Vector3d& p)
  : azimuth(std::atan2(p.y(), p.x()) / kDegree + 180)
  , elevation(std::atan2(p.z(), std::hypot(p.x(), p.y())) / kDegree + 90)
  , range(static_cast<float>(p.norm()))
  {}
};

/** The nearest range in each pixel. */
class Image {
public:
  explicit Image(double pixels)
  : pixels_(pixels)
  , columns_(static_cast<std::size_t>(std::ceil(360 * pixels)) + 1)
  , ranges_(columns_ * (static_cast<std::size_t>(std::ceil(180 * pixels)) + 1),
            kNothing)
  {}
  void
  add(const Sphere& p)
  {
    float& range = ranges_[placeOf(p)];
    range = std::min(range, p.range);
  }
  float
  at(const Sphere& p) const
  {
    return ranges_[placeOf(p)];
  }

private:
  std::size_t
  placeOf(const Sphere& p) const
  {
    return static_cast<std::size_t>(p.elevation * pixels_) * columns_ +
           static_cast<std::size_t>(p.azimuth * pixels_);
  }

  double pixels_;
  std::size_t columns_;
  std::vector<float> ranges_;
};

/** A point of the map, and how often it was seen through less how often it was seen. */
struct MapPoint {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(); // [m] of its points
  double count = 0;
  std::array<int, kAll> through{};

  bool
  isRemoved(bool reverts) const
  {
    const auto moved = [](int balance) { return balance > 0; };
    return std::any_of(through.begin(), through.begin() + kRemoving, moved) &&
           (!reverts || std::all_of(through.begin() + kRemoving, through.end(), moved));
  }
};

/** The union of all scans, and where each of their points is in it. */
struct Map {
  std::vector<MapPoint> points;
  std::vector<std::vector<std::uint32_t>> of_scan;

  Map(const std::vector<Points>& scans,
      const std::vector<Eigen::Isometry3d>& T_first_scan)
  : of_scan(scans.size())
  {
    VoxelNumbers numbers;
    for (std::size_t i = 0; i < scans.size(); ++i)
      for (const auto& p : scans[i]) {
        const Eigen::Vector3d placed = T_first_scan[i] * p.cast<double>();
        const auto [number, is_new] =
            numbers.add(voxelKey(placed.cast<float>(), kMapVoxel));
        if (is_new)
          points.emplace_back();
        points[number].sum += placed;
        points[number].count += 1;
        of_scan[i].push_back(static_cast<std::uint32_t>(number));
      }
  }
};

void
look(const Points& scan, const Eigen::Isometry3d& T_first_scan, Map& map)
{
  std::vector<Image> images;
  for (const double pixels : kPixels)
    images.emplace_back(pixels);
  for (const auto& p : scan) {
    const Sphere seen(p.cast<double>());
    for (Image& image : images)
      image.add(seen);
  }
  const Eigen::Isometry3d T_scan_first = T_first_scan.inverse();
  for (MapPoint& point : map.points) {
    const Sphere place(T_scan_first * (point.sum / point.count));
    for (std::size_t r = 0; r < kAll; ++r) {
      const float range = images[r].at(place);
      if (range == kNothing)
        continue;
      const float beyond = range - place.range;
      if (beyond > kMargin * range)
        ++point.through[r];
      else if (beyond >= -kMargin * range)
        --point.through[r];
    }
  }
}

std::vector<std::vector<PointMotion>>
evaluate(const std::vector<Points>& scans,
         const std::vector<Eigen::Isometry3d>& T_world_scan,
         bool reverts)
{
  std::vector<Eigen::Isometry3d> T_first_scan;
  for (const auto& T : T_world_scan)
    T_first_scan.push_back(T_world_scan.front().inverse() * T);
  Map map(scans, T_first_scan);
  for (std::size_t i = 0; i < scans.size(); ++i)
    look(scans[i], T_first_scan[i], map);
  std::vector<std::vector<PointMotion>> motion(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (const std::uint32_t number : map.of_scan[i])
      motion[i].push_back(map.points[number].isRemoved(reverts) ? PointMotion::kDynamic
                                                                : PointMotion::kStatic);
  return motion;
}
} // namespace

std::vector<std::vector<PointMotion>>
removeAndRevert(const std::vector<Points>& scans,
                const std::vector<Eigen::Isometry3d>& T_world_scan)
{
  return evaluate(scans, T_world_scan, true);
}

std::vector<std::vector<PointMotion>>
removeByImages(const std::vector<Points>& scans,
               const std::vector<Eigen::Isometry3d>& T_world_scan)
{
  return evaluate(scans, T_world_scan, false);
}

} // namespace pcl6d::bench
