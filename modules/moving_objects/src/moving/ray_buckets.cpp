// SPDX-License-Identifier: BSD-3-Clause
#include "ray_buckets.h"

#include <pcl6d/visibility/cube_faces.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::moving_objects {

namespace {
constexpr double kFace = 1.5707963267948966; // [rad] width of a face of the cube

/** Ranges farther apart than this number of standard deviations, plus the width of the cell,
 * belong to two surfaces: the tolerance of RayImage. */
constexpr float kSameSigmas = 3;

struct Ray {
  float range;
  std::uint32_t point;
};

/** The rays sorted by cells (counting sort): the first ray of each cell. */
struct SortedRays {
  std::vector<Ray> rays;
  std::vector<std::uint32_t> begin; // of each cell, and the end of the last
};

SortedRays
sortedByCell(const Points& points, const Eigen::Vector3f& origin, int side)
{
  const auto cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  SortedRays sorted;
  sorted.begin.assign(6 * cells + 1, 0);
  std::vector<std::uint32_t> cell_of(points.size(), RayBuckets::kNone);
  std::vector<float> ranges(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f ray = points[i] - origin;
    ranges[i] = ray.norm();
    if (!(ranges[i] > 0) || !std::isfinite(ranges[i]))
      continue;
    const visibility::OnCube at = visibility::onCube(ray);
    cell_of[i] =
        static_cast<std::uint32_t>(at.face * cells + visibility::cellOf(at, side));
    ++sorted.begin[cell_of[i] + 1];
  }
  for (std::size_t c = 1; c < sorted.begin.size(); ++c)
    sorted.begin[c] += sorted.begin[c - 1];
  sorted.rays.resize(sorted.begin.back());
  std::vector<std::uint32_t> next(sorted.begin.begin(), sorted.begin.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (cell_of[i] != RayBuckets::kNone)
      sorted.rays[next[cell_of[i]]++] = {ranges[i], static_cast<std::uint32_t>(i)};
  return sorted;
}
} // namespace

RayBuckets
bucketsOf(const Points& points,
          const Eigen::Vector3f& origin,
          double cell,
          double noise)
{
  const int side = std::max(1, static_cast<int>(std::lround(kFace / cell)));
  auto [rays, begin] = sortedByCell(points, origin, side);
  RayBuckets buckets;
  buckets.bucket.assign(points.size(), RayBuckets::kNone);
  const auto width = static_cast<float>(kFace / side);
  const float slack = kSameSigmas * static_cast<float>(noise);
  for (std::size_t c = 0; c + 1 < begin.size(); ++c) {
    if (begin[c] == begin[c + 1])
      continue;
    std::sort(rays.begin() + begin[c],
              rays.begin() + begin[c + 1],
              [](const Ray& a, const Ray& b) {
                return a.range < b.range || (a.range == b.range && a.point < b.point);
              });
    for (std::size_t first = begin[c]; first < begin[c + 1];) {
      std::size_t last = first + 1;
      while (last < begin[c + 1] && rays[last].range - rays[last - 1].range <=
                                        slack + width * rays[last].range)
        ++last;
      for (std::size_t k = first; k < last; ++k)
        buckets.bucket[rays[k].point] =
            static_cast<std::uint32_t>(buckets.places.size());
      buckets.places.push_back(points[rays[(first + last) / 2].point]);
      first = last;
    }
  }
  return buckets;
}

} // namespace pcl6d::moving_objects
