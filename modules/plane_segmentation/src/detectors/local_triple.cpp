// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/local_triple.h"

#include <Eigen/Geometry>

#include <array>

namespace pcl6d::plane_segmentation {

namespace {
/** \return a number in [begin, end) */
std::size_t
drawFrom(std::size_t begin, std::size_t end, Random& random)
{
  return begin +
         static_cast<std::size_t>(random.uniform() * static_cast<double>(end - begin));
}
} // namespace

std::optional<TriplePlane>
drawTriple(const RemainingSurfels& surfels,
           const TripleOptions& options,
           Random& random)
{
  const SurfelColumns& columns = surfels.columns();
  const std::size_t first = drawFrom(0, surfels.size(), random);
  const auto level = static_cast<int>(
      drawFrom(0, static_cast<std::size_t>(options.num_levels), random));
  const RemainingSurfels::Range cell = surfels.cell(first, level);
  const std::array<std::size_t, 3> slots = {first,
                                            drawFrom(cell.begin, cell.end, random),
                                            drawFrom(cell.begin, cell.end, random)};
  const Eigen::Vector3f facing = columns.normal(first);
  const auto cosine = static_cast<float>(options.min_cosine);
  const Eigen::Vector3f a = columns.point(slots[1]) - columns.point(first);
  const Eigen::Vector3f b = columns.point(slots[2]) - columns.point(first);
  const auto shortest = static_cast<float>(options.min_distance);
  const float sides = a.norm() * b.norm();
  if (std::min({a.norm(), b.norm(), (a - b).norm()}) < shortest || !(sides > 0))
    return std::nullopt;
  Eigen::Vector3f normal = a.cross(b);
  const float length = normal.norm();
  if (length < static_cast<float>(options.min_sine) * sides)
    return std::nullopt;
  normal /= normal.dot(facing) < 0 ? -length : length;
  for (const auto slot : slots)
    if (normal.dot(columns.normal(slot)) < cosine)
      return std::nullopt;
  return TriplePlane{normal, normal.dot(columns.point(first))};
}

} // namespace pcl6d::plane_segmentation
