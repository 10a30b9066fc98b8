// SPDX-License-Identifier: BSD-3-Clause
#include "control/control_start.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/random.h>
#include <pcl6d/registration/rigid_minimiser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl6d::graph_relaxation {

namespace {
/** Largest number of tested triples: every triple of 40 points. With a third of the points
 * wrong, each triple is right with probability 0.3. */
constexpr std::size_t kMostTriples = 9880;

/** Concentration steps: the sum falls in each, and rests after few. */
constexpr int kConcentrations = 10;

using Pairs = std::vector<std::size_t>;
using Positions = std::vector<Eigen::Vector3d>;

std::vector<std::array<std::size_t, 3>>
triplesOf(std::size_t count)
{
  std::vector<std::array<std::size_t, 3>> triples;
  if (count * (count - 1) * (count - 2) / 6 <= kMostTriples) {
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 1; b < count; ++b)
        for (std::size_t c = b + 1; c < count; ++c)
          triples.push_back({a, b, c});
    return triples;
  }
  Random random(1);
  while (triples.size() < kMostTriples) {
    std::array<std::size_t, 3> one{};
    for (std::size_t& i : one)
      i = static_cast<std::size_t>(random.uniform(0, static_cast<double>(count)));
    if (one[0] != one[1] && one[1] != one[2] && one[0] != one[2])
      triples.push_back(one);
  }
  return triples;
}

template <typename Indices>
RigidEstimate
motionOf(const Positions& source, const Positions& target, const Indices& pairs)
{
  PairAccumulator sums;
  for (const std::size_t i : pairs)
    sums.add(source[i], target[i]);
  return minimiseByQuaternion(sums.sums());
}

/** \param[out] best the pairs with the smallest distances
 * \return the sum of their squares */
double
bestPairs(const Positions& source,
          const Positions& target,
          const Eigen::Isometry3d& T,
          Pairs& best)
{
  std::vector<std::pair<double, std::size_t>> distances;
  for (std::size_t i = 0; i < source.size(); ++i)
    distances.emplace_back((T * source[i] - target[i]).squaredNorm(), i);
  std::sort(distances.begin(), distances.end());
  double sum = 0;
  for (std::size_t k = 0; k < best.size(); ++k) {
    sum += distances[k].first;
    best[k] = distances[k].second;
  }
  return sum;
}
} // namespace

ControlStart
startOfControl(const Positions& source, const Positions& target)
{
  ControlStart start;
  double least = std::numeric_limits<double>::infinity();
  Pairs pairs(std::max<std::size_t>(3, source.size() / 2 + 1));
  for (const auto& triple : triplesOf(source.size())) {
    const RigidEstimate first = motionOf(source, target, triple);
    if (first.status != Status::kOk)
      continue;
    const double sum = bestPairs(source, target, first.transform, pairs);
    if (sum < least) {
      least = sum;
      start = {first.transform, pairs};
    }
  }
  for (int i = 0; i < kConcentrations && !start.pairs.empty(); ++i) {
    const RigidEstimate next = motionOf(source, target, start.pairs);
    if (next.status != Status::kOk)
      break;
    start.T = next.transform;
    bestPairs(source, target, start.T, start.pairs);
  }
  std::sort(start.pairs.begin(), start.pairs.end());
  return start;
}

double
spreadAcrossLine(const Positions& points)
{
  const auto count = static_cast<double>(points.size());
  const Eigen::Vector3d mean =
      std::accumulate(
          points.begin(), points.end(), Eigen::Vector3d(Eigen::Vector3d::Zero())) /
      count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points)
    scatter += (point - mean) * (point - mean).transpose() / count;
  const auto values = symmetricEigenvalues<3>(scatter);
  return std::sqrt(std::max(0.0, values(0)) + std::max(0.0, values(1)));
}

} // namespace pcl6d::graph_relaxation
