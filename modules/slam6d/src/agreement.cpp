// SPDX-License-Identifier: BSD-3-Clause
#include "agreement.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <vector>

namespace pcl6d::slam6d {

namespace {
constexpr std::size_t kBlockSize = 512; // points
constexpr std::size_t kSample = 10000;  ///< points that are enough

struct Count {
  std::size_t finite = 0;
  std::size_t near = 0;
};
} // namespace

double
agreementOf(const IcpTarget& target,
            const Points& points,
            const Eigen::Isometry3d& T_target_points,
            double distance,
            unsigned int num_threads)
{
  std::vector<Eigen::Isometry3d> T_part_points;
  for (const auto& part : target)
    T_part_points.push_back(part.T_target_part.inverse() * T_target_points);
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSample);
  const auto limit_sq = static_cast<float>(distance * distance);
  const auto isNear = [&](const Eigen::Vector3d& p) {
    for (std::size_t k = 0; k < target.size(); ++k) {
      const Eigen::Vector3f q = (T_part_points[k] * p).cast<float>();
      if (target[k].tree->nearest(q, limit_sq).index >= 0)
        return true;
    }
    return false;
  };
  std::vector<Count> counts((points.size() + kBlockSize - 1) / kBlockSize);
  parallelBlocks(points.size(), kBlockSize, num_threads, [&](const Block& block) {
    Count& count = counts[block.index];
    for (std::size_t i = block.begin; i < block.end; ++i) {
      if (i % stride != 0 || !points[i].allFinite())
        continue;
      ++count.finite;
      count.near += isNear(points[i].cast<double>());
    }
  });
  Count all;
  for (const Count& count : counts) {
    all.finite += count.finite;
    all.near += count.near;
  }
  return all.finite > 0 ? static_cast<double>(all.near) / all.finite : 0;
}

const PointTree&
MeasuredScan::tree(unsigned int num_threads) const
{
  if (!tree_)
    tree_.emplace(points_, num_threads);
  return *tree_;
}

double
agreementOf(const MeasuredScan& a,
            const MeasuredScan& b,
            const Eigen::Isometry3d& T_a_b,
            double distance,
            unsigned int num_threads)
{
  const auto oneWay =
      [&](const MeasuredScan& to, const MeasuredScan& of, const Eigen::Isometry3d& T) {
        IcpTargetPart part;
        part.tree = &to.tree(num_threads);
        part.points = &to.points();
        return agreementOf({part}, of.points(), T, distance, num_threads);
      };
  return 0.5 * (oneWay(a, b, T_a_b) + oneWay(b, a, T_a_b.inverse()));
}

} // namespace pcl6d::slam6d
