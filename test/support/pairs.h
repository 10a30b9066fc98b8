// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/fit_oracles.h"
#include "support/poses.h"

#include <pcl6d/registration/pair_sums.h>

#include <Eigen/Geometry>

#include <vector>

namespace pcl6d::test {

/** \brief Matched points in double. */
struct Pairs {
  std::vector<Eigen::Vector3d> source; ///< d [m]
  std::vector<Eigen::Vector3d> target; ///< m [m]

  PairSums
  sums() const
  {
    PairAccumulator accumulator;
    for (std::size_t i = 0; i < source.size(); ++i)
      accumulator.add(source[i], target[i]);
    return accumulator.sums();
  }
};

/** \return a vector uniform in a cube of side 2 half [m] */
inline Eigen::Vector3d
randomVector(Random& random, double half)
{
  const double x = random.uniform(-half, half), y = random.uniform(-half, half);
  return {x, y, random.uniform(-half, half)};
}

inline Eigen::Vector3d
normalVector(Random& random, double sigma)
{
  const double x = random.normal(), y = random.normal();
  return sigma * Eigen::Vector3d(x, y, random.normal());
}

/** \return target = truth * source + noise for these source points */
inline Pairs
movedPairs(const std::vector<Eigen::Vector3d>& source,
           const Eigen::Isometry3d& truth,
           Random& random,
           double sigma = 0)
{
  Pairs pairs;
  pairs.source = source;
  for (const auto& d : source)
    pairs.target.push_back(truth * d + normalVector(random, sigma));
  return pairs;
}

/** \return points uniform in a cube of side 2 half [m] about a centre */
inline std::vector<Eigen::Vector3d>
randomPoints(Random& random,
             std::size_t count,
             double half,
             const Eigen::Vector3d& centre = Eigen::Vector3d::Zero())
{
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(centre + randomVector(random, half));
  return points;
}

/** \return the rigid fit of the pairs by Umeyama's closed form, from Eigen: an independent
 * oracle for our minimisers */
inline Eigen::Isometry3d
umeyamaOracle(const Pairs& pairs)
{
  Eigen::Matrix3Xd d(3, pairs.source.size()), m(3, pairs.source.size());
  for (std::size_t i = 0; i < pairs.source.size(); ++i) {
    d.col(i) = pairs.source[i];
    m.col(i) = pairs.target[i];
  }
  return Eigen::Isometry3d(umeyama(d, m, false));
}

} // namespace pcl6d::test
