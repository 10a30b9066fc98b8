// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/random.h>

#include <cstddef>

namespace pcl6d::test {

/** \brief Points on rectangles, seen from the origin, with seeded noise. */
class Surfaces {
public:
  explicit Surfaces(double sigma = 0, std::uint64_t seed = 1)
  : sigma_(sigma), random_(seed)
  {}

  /** \brief A grid of points on corner + a u + b v with a, b in [0, 1], at spacing [m];
   * points move along the normal by noise. \return their places in points() */
  std::vector<std::uint32_t>
  add(const Eigen::Vector3d& corner,
      const Eigen::Vector3d& u,
      const Eigen::Vector3d& v,
      double spacing)
  {
    const Eigen::Vector3d normal = u.cross(v).normalized();
    const auto columns = static_cast<int>(u.norm() / spacing + 0.5);
    const auto rows = static_cast<int>(v.norm() / spacing + 0.5);
    std::vector<std::uint32_t> places;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const Eigen::Vector3d p = corner + u * ((x + 0.5) / columns) +
                                  v * ((y + 0.5) / rows) +
                                  sigma_ * random_.normal() * normal;
        places.push_back(static_cast<std::uint32_t>(points_.size()));
        points_.push_back(p.cast<float>());
      }
    return places;
  }

  const Points&
  points() const
  {
    return points_;
  }

private:
  double sigma_;
  Random random_;
  Points points_;
};

/** \brief The six faces of a room of 4 x 4 x 3 m, the origin inside. */
inline Points
room(double sigma = 0, double spacing = 0.04, std::uint64_t seed = 1)
{
  const Eigen::Vector3d low(-2, -1.5, -1), x(4, 0, 0), y(0, 4, 0), z(0, 0, 3);
  Surfaces surfaces(sigma, seed);
  for (const auto& corner : {low, Eigen::Vector3d(low + z)})
    surfaces.add(corner, x, y, spacing);
  for (const auto& corner : {low, Eigen::Vector3d(low + y)})
    surfaces.add(corner, x, z, spacing);
  for (const auto& corner : {low, Eigen::Vector3d(low + x)})
    surfaces.add(corner, y, z, spacing);
  return surfaces.points();
}

} // namespace pcl6d::test
