// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/pairs.h"

#include <pcl6d/registration/plane_minimiser.h>

#include <vector>

namespace pcl6d::test {

inline constexpr std::size_t kPairs = 300;
inline constexpr double kHalf = 10; // [m] half side of the cube that holds the points

/** Points and the planes that they belong to. */
struct Planes {
  std::vector<Eigen::Vector3d> source, target, normal;

  PlaneSums
  sums(std::size_t begin, std::size_t end) const
  {
    PlaneAccumulator accumulator;
    for (std::size_t i = begin; i < end; ++i)
      accumulator.add(source[i], target[i], normal[i]);
    return accumulator.sums();
  }
  PlaneSums
  sums() const
  {
    return sums(0, source.size());
  }

  Planes
  moved(const Eigen::Isometry3d& T) const
  {
    Planes result = *this;
    for (auto& d : result.source)
      d = T * d;
    return result;
  }
};

/** Pairs whose source was moved by truth^-1 and then slid along the planes, which the
 * distance to a plane does not feel; noise along the normals.
 * \param[in] normal_of gives the normal of a point */
template <typename NormalOf>
Planes
makePlanes(Random& random,
           const Eigen::Isometry3d& truth,
           double sigma,
           NormalOf normal_of,
           const Eigen::Vector3d& centre = Eigen::Vector3d::Zero())
{
  Planes planes;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Eigen::Vector3d m = centre + randomVector(random, kHalf);
    const Eigen::Vector3d n = normal_of(m).normalized();
    const Eigen::Vector3d slide = n.cross(randomVector(random, 0.5));
    planes.target.push_back(m);
    planes.normal.push_back(n);
    planes.source.push_back(truth.inverse() *
                            (m + slide + sigma * random.normal() * n));
  }
  return planes;
}

inline Planes
roomPlanes(Random& random, const Eigen::Isometry3d& truth, double sigma = 0)
{
  return makePlanes(random, truth, sigma, [&](const Eigen::Vector3d&) {
    return randomVector(random, 1);
  });
}

} // namespace pcl6d::test
