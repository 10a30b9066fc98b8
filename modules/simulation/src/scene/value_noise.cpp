// SPDX-License-Identifier: BSD-3-Clause
#include "scene/value_noise.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/common/random.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::simulation {
namespace {
double
latticeValue(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed)
{
  std::uint64_t key = mixBits(seed);
  for (const auto coordinate : {x, y, z})
    key = mixBits(key ^ static_cast<std::uint64_t>(coordinate));
  return static_cast<double>(key >> 11) * 0x1.0p-52 - 1;
}

double
blend(double a, double b, double t)
{
  return a + (b - a) * (t * t * (3 - 2 * t));
}
} // namespace

double
valueNoise(const Eigen::Vector3d& p, std::uint64_t seed)
{
  const Eigen::Vector3d cell(std::floor(p.x()), std::floor(p.y()), std::floor(p.z()));
  const Eigen::Vector3d t = p - cell;
  const auto place = [](double c) {
    constexpr double kFarthest = 1e18; // the next cell is still a number
    return clampedTo<std::int64_t>(std::clamp(c, -kFarthest, kFarthest));
  };
  const auto x = place(cell.x());
  const auto y = place(cell.y());
  const auto z = place(cell.z());
  const auto along_x = [&](std::int64_t j, std::int64_t k) {
    return blend(latticeValue(x, y + j, z + k, seed),
                 latticeValue(x + 1, y + j, z + k, seed),
                 t.x());
  };
  return blend(blend(along_x(0, 0), along_x(1, 0), t.y()),
               blend(along_x(0, 1), along_x(1, 1), t.y()),
               t.z());
}

double
fractalNoise(const Eigen::Vector3d& p, std::uint64_t seed)
{
  const double sum = valueNoise(p, seed) + valueNoise(2 * p, seed + 1) / 2 +
                     valueNoise(4 * p, seed + 2) / 4;
  return sum / 1.75;
}

} // namespace pcl6d::simulation
