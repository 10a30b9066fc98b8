// SPDX-License-Identifier: BSD-3-Clause
#include "surfels/remaining_surfels.h"

#include <pcl6d/common/random.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::plane_segmentation {

namespace {
constexpr int kBits = 21; // of a cell's coordinate

/** \return the 21 bits of a number, two zeros after each */
std::uint64_t
spread(std::uint64_t bits)
{
  bits = (bits | bits << 32) & 0x1f00000000ffffull;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffull;
  bits = (bits | bits << 8) & 0x100f00f00f00f00full;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3ull;
  return (bits | bits << 2) & 0x1249249249249249ull;
}

/** \return the cell of a point in Morton's order: the bits of x, y and z in turns
 * \param[in] p [cells] from the corner of the cloud */
std::uint64_t
mortonCode(const Eigen::Vector3f& p)
{
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::uint64_t>(std::max(0.f, p[axis]));
    code |= spread(std::min<std::uint64_t>(cell, (1u << kBits) - 1)) << axis;
  }
  return code;
}

struct CodedSurfel {
  std::uint64_t code;
  std::uint32_t surfel;
};

/** \return the smooth surfels by their cells */
std::vector<CodedSurfel>
smoothInOrder(const Surfels& surfels, const Eigen::AlignedBox3f& box, double finest)
{
  const float extent = surfels.points.empty() ? 0.f : box.sizes().maxCoeff();
  const float edge =
      std::max(static_cast<float>(finest), extent / static_cast<float>(1 << kBits));
  std::vector<CodedSurfel> order;
  for (std::uint32_t i = 0; i < surfels.size(); ++i)
    if (surfels.smooth[i])
      order.push_back({mortonCode((surfels.points[i] - box.min()) / edge), i});
  std::sort(order.begin(), order.end(), [](const CodedSurfel& a, const CodedSurfel& b) {
    return a.code != b.code ? a.code < b.code : a.surfel < b.surfel;
  });
  return order;
}

template <typename T>
void
dropMarked(std::vector<T>& values, const std::vector<char>& marked)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!marked[i])
      values[kept++] = values[i];
  values.resize(kept);
}
} // namespace

void
SurfelColumns::append(const Eigen::Vector3f& point,
                      const Eigen::Vector3f& normal,
                      float distance)
{
  x.push_back(point.x());
  y.push_back(point.y());
  z.push_back(point.z());
  nx.push_back(normal.x());
  ny.push_back(normal.y());
  nz.push_back(normal.z());
  reach.push_back(distance);
}

RemainingSurfels::RemainingSurfels(const PlaneCloud& cloud,
                                   double finest,
                                   const SurfelReach& reach)
: cloud_(cloud)
{
  const Surfels& surfels = cloud.surfels();
  Eigen::AlignedBox3f box;
  for (const auto& point : surfels.points)
    box.extend(point);
  for (const auto& [code, surfel] : smoothInOrder(surfels, box, finest)) {
    codes_.push_back(code);
    surfels_.push_back(surfel);
    columns_.append(
        surfels.points[surfel] - box.min(),
        surfels.normals[surfel],
        static_cast<float>(std::max(
            reach.sigmas * static_cast<double>(surfels.noise[surfel]), reach.least)));
  }
  slots_.assign(surfels.size(), kGone);
  numberSlots();
}

void
RemainingSurfels::numberSlots()
{
  for (std::size_t slot = 0; slot < surfels_.size(); ++slot)
    slots_[surfels_[slot]] = static_cast<std::uint32_t>(slot);
}

RemainingSurfels::Range
RemainingSurfels::cell(std::size_t slot, int level) const
{
  const std::uint64_t width = std::uint64_t{1} << (3 * level);
  const std::uint64_t first = codes_[slot] & ~(width - 1);
  const auto at = codes_.begin() + static_cast<std::ptrdiff_t>(slot);
  const auto begin = std::lower_bound(codes_.begin(), at, first);
  const auto end = std::lower_bound(at, codes_.end(), first + width);
  return {static_cast<std::size_t>(begin - codes_.begin()),
          static_cast<std::size_t>(end - codes_.begin())};
}

SurfelColumns
RemainingSurfels::sample(std::size_t size, std::uint64_t seed) const
{
  SurfelColumns chosen;
  Random random(seed);
  size = std::min(size, this->size());
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t begin = i * this->size() / size;
    const std::size_t end = (i + 1) * this->size() / size;
    const auto slot = begin + static_cast<std::size_t>(
                                  random.uniform() * static_cast<double>(end - begin));
    chosen.append(columns_.point(slot), columns_.normal(slot), columns_.reach[slot]);
  }
  return chosen;
}

std::vector<std::uint32_t>
RemainingSurfels::shuffled(std::uint64_t seed) const
{
  std::vector<std::uint32_t> order = surfels_;
  Random random(seed);
  for (std::size_t left = order.size(); left > 1; --left)
    std::swap(
        order[left - 1],
        order[static_cast<std::size_t>(random.uniform() * static_cast<double>(left))]);
  return order;
}

SurfelColumns
RemainingSurfels::columnsOf(const std::vector<std::uint32_t>& surfels) const
{
  SurfelColumns columns;
  for (const auto surfel : surfels)
    if (const std::uint32_t slot = slots_[surfel]; slot != kGone)
      columns.append(columns_.point(slot), columns_.normal(slot), columns_.reach[slot]);
  return columns;
}

std::vector<std::uint32_t>
RemainingSurfels::pointsOf(const std::vector<std::uint32_t>& slots) const
{
  const Surfels& all = cloud_.surfels();
  std::vector<std::uint32_t> points;
  for (const auto slot : slots)
    points.insert(points.end(),
                  all.members.begin() + all.begin[surfels_[slot]],
                  all.members.begin() + all.begin[surfels_[slot] + 1]);
  std::sort(points.begin(), points.end());
  return points;
}

void
RemainingSurfels::remove(const std::vector<std::uint32_t>& slots)
{
  std::vector<char> marked(size(), 0);
  for (const auto slot : slots) {
    marked[slot] = 1;
    slots_[surfels_[slot]] = kGone;
  }
  dropMarked(codes_, marked);
  dropMarked(surfels_, marked);
  for (auto* column : {&columns_.x,
                       &columns_.y,
                       &columns_.z,
                       &columns_.nx,
                       &columns_.ny,
                       &columns_.nz,
                       &columns_.reach})
    dropMarked(*column, marked);
  numberSlots();
}

} // namespace pcl6d::plane_segmentation
