// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/fpfh.h"

#include <pcl6d/common/parallel.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl6d::registration {

namespace {
constexpr std::size_t kPointBlock = 128;
constexpr std::size_t kBins = kFpfhSize / 3; // of an angle

using Neighbours = std::vector<Neighbour>;

bool
hasNormal(const FeatureScan& scan, std::size_t i)
{
  return !scan.normals[i].isZero(0);
}

std::vector<Neighbours>
findNeighbours(const FeatureScan& scan, double radius, unsigned int num_threads)
{
  std::vector<Neighbours> all(scan.points.size());
  const auto radius_sq = static_cast<float>(radius * radius);
  parallelBlocks(all.size(), kPointBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      if (!hasNormal(scan, i))
        continue;
      for (const auto& n : scan.tree.withinRadius(scan.points[i], radius_sq))
        if (hasNormal(scan, static_cast<std::size_t>(n.index)))
          all[i].push_back(n);
    }
  });
  return all;
}

/** \return the bin of a cosine in [-1, 1] */
std::size_t
binOfCosine(float cosine)
{
  const float bin = std::floor(static_cast<float>(kBins) * 0.5f * (cosine + 1));
  return static_cast<std::size_t>(std::clamp(bin, 0.f, kBins - 1.f));
}

/** \return the bin of the angle of (x, y) in [-pi, pi]; by comparison with the limits of the bins,
 * without an arc tangent: bit-identical on any machine */
std::size_t
binOfAngle(float x, float y)
{
  static constexpr float kLimits[][2] = {// cosine and sine of pi / 11, 3 pi / 11, ...
                                         {0.959492974f, 0.281732557f},
                                         {0.654860734f, 0.755749574f},
                                         {0.142314838f, 0.989821442f},
                                         {-0.415415013f, 0.909631995f},
                                         {-0.841253533f, 0.540640817f}};
  static_assert(std::size(kLimits) == kBins / 2);
  std::size_t beyond = 0;
  for (const auto& limit : kLimits)
    beyond += limit[0] * std::abs(y) - limit[1] * x > 0 ? 1 : 0;
  return y < 0 ? kBins / 2 - beyond : kBins / 2 + beyond;
}

/** The bins of a pair of points, for the three angles. */
struct PairBins {
  std::size_t theta, alpha, phi;
};

/** \return the angles between the normals of two points in the Darboux frame of the point with
 * the normal leaning more along the line between both; empty for equal places or a normal
 * along the line */
std::optional<PairBins>
binsOf(const FeatureScan& scan, std::size_t i, std::size_t k)
{
  Eigen::Vector3f line = scan.points[k] - scan.points[i];
  const float length = line.norm();
  if (length == 0)
    return std::nullopt;
  Eigen::Vector3f u = scan.normals[i], other = scan.normals[k];
  float along = u.dot(line) / length;
  const float along_other = other.dot(line) / length;
  if (std::abs(along) < std::abs(along_other)) {
    std::swap(u, other);
    line = -line;
    along = -along_other;
  }
  Eigen::Vector3f v = line.cross(u);
  const float sine = v.norm();
  if (sine == 0)
    return std::nullopt;
  v /= sine;
  const Eigen::Vector3f w = u.cross(v);
  return PairBins{binOfAngle(u.dot(other), w.dot(other)),
                  binOfCosine(v.dot(other)),
                  binOfCosine(along)};
}

/** \return the histograms of each point with its neighbours: each third sums up to 100 */
std::vector<Fpfh>
simpleHistograms(const FeatureScan& scan,
                 const std::vector<Neighbours>& near,
                 unsigned int num_threads)
{
  std::vector<Fpfh> all(scan.points.size(), Fpfh{});
  parallelBlocks(all.size(), kPointBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const float share = 100.f / (static_cast<float>(near[i].size()) - 1);
      for (const Neighbour& n : near[i]) {
        const auto bins = binsOf(scan, i, static_cast<std::size_t>(n.index));
        if (!bins)
          continue;
        all[i][bins->theta] += share;
        all[i][kBins + bins->alpha] += share;
        all[i][2 * kBins + bins->phi] += share;
      }
    }
  });
  return all;
}

/** \return the sum of the neighbours' histograms, the nearer the heavier */
Fpfh
weighted(const std::vector<Fpfh>& simple, const Neighbours& near)
{
  Fpfh sum{};
  for (const Neighbour& n : near) {
    if (n.distance_sq == 0)
      continue; // the point itself
    const Fpfh& one = simple[static_cast<std::size_t>(n.index)];
    for (std::size_t bin = 0; bin < kFpfhSize; ++bin)
      sum[bin] += one[bin] / n.distance_sq;
  }
  for (std::size_t begin = 0; begin < kFpfhSize; begin += kBins) {
    float total = 0;
    for (std::size_t bin = begin; bin < begin + kBins; ++bin)
      total += sum[bin];
    for (std::size_t bin = begin; bin < begin + kBins && total != 0; ++bin)
      sum[bin] *= 100 / total;
  }
  return sum;
}
} // namespace

std::vector<Fpfh>
computeFpfh(const FeatureScan& scan, double radius, unsigned int num_threads)
{
  const auto near = findNeighbours(scan, radius, num_threads);
  const auto simple = simpleHistograms(scan, near, num_threads);
  std::vector<Fpfh> features(scan.points.size());
  parallelBlocks(features.size(), kPointBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      features[i] = weighted(simple, near[i]);
  });
  return features;
}

} // namespace pcl6d::registration
