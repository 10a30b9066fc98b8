// SPDX-License-Identifier: BSD-3-Clause
#include "remaining_points.h"

#include <pcl6d/common/random.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d {

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

struct CodedPlace {
  std::uint64_t code;
  std::uint32_t place;
};

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
PointColumns::append(const Eigen::Vector3f& point, const Eigen::Vector3f& normal)
{
  x.push_back(point.x());
  y.push_back(point.y());
  z.push_back(point.z());
  nx.push_back(normal.x());
  ny.push_back(normal.y());
  nz.push_back(normal.z());
}

RemainingPoints::RemainingPoints(const PlaneCloud& cloud, double finest)
{
  const Points& points = cloud.points();
  Eigen::AlignedBox3f box;
  for (const auto& point : points)
    box.extend(point);
  const float extent = points.empty() ? 0.f : box.sizes().maxCoeff();
  const float edge =
      std::max(static_cast<float>(finest), extent / static_cast<float>(1 << kBits));
  std::vector<CodedPlace> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (cloud.normals()[i].squaredNorm() > 0)
      order.push_back(
          {mortonCode((points[i] - box.min()) / edge), static_cast<std::uint32_t>(i)});
  std::sort(order.begin(), order.end(), [](const CodedPlace& a, const CodedPlace& b) {
    return a.code != b.code ? a.code < b.code : a.place < b.place;
  });
  for (const auto& [code, place] : order) {
    codes_.push_back(code);
    places_.push_back(place);
    columns_.append(points[place] - box.min(), cloud.normals()[place]);
  }
}

std::vector<std::uint32_t>
RemainingPoints::places(const std::vector<std::uint32_t>& slots) const
{
  std::vector<std::uint32_t> places;
  places.reserve(slots.size());
  for (const auto slot : slots)
    places.push_back(places_[slot]);
  std::sort(places.begin(), places.end());
  return places;
}

RemainingPoints::Range
RemainingPoints::cell(std::size_t slot, int level) const
{
  const std::uint64_t width = std::uint64_t{1} << (3 * level);
  const std::uint64_t first = codes_[slot] & ~(width - 1);
  const auto at = codes_.begin() + static_cast<std::ptrdiff_t>(slot);
  const auto begin = std::lower_bound(codes_.begin(), at, first);
  const auto end = std::lower_bound(at, codes_.end(), first + width);
  return {static_cast<std::size_t>(begin - codes_.begin()),
          static_cast<std::size_t>(end - codes_.begin())};
}

PointColumns
RemainingPoints::sample(std::size_t size, std::uint64_t seed) const
{
  PointColumns chosen;
  Random random(seed);
  size = std::min(size, this->size());
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t begin = i * this->size() / size;
    const std::size_t end = (i + 1) * this->size() / size;
    const auto slot = begin + static_cast<std::size_t>(
                                  random.uniform() * static_cast<double>(end - begin));
    chosen.append(columns_.point(slot), columns_.normal(slot));
  }
  return chosen;
}

void
RemainingPoints::remove(const std::vector<std::uint32_t>& slots)
{
  std::vector<char> marked(size(), 0);
  for (const auto slot : slots)
    marked[slot] = 1;
  dropMarked(codes_, marked);
  dropMarked(places_, marked);
  for (auto* column : {&columns_.x,
                       &columns_.y,
                       &columns_.z,
                       &columns_.nx,
                       &columns_.ny,
                       &columns_.nz})
    dropMarked(*column, marked);
}

} // namespace pcl6d
