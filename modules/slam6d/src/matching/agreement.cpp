// SPDX-License-Identifier: BSD-3-Clause
#include "matching/agreement.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/voxel_key.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace pcl6d::slam6d {

namespace {
constexpr std::size_t kBlockSize = 512; // points
constexpr std::size_t kSample = 10000;  ///< a sufficient number of points

/** For each point of a sample: its index, and whether the target has a point nearby. */
struct Sample {
  std::vector<std::size_t> places;
  std::vector<char> near;
};

/** \return the points of a sample, each with whether a target point lies within a distance */
Sample
sampleOf(const IcpTarget& target,
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
  Sample sample;
  for (std::size_t i = 0; i < points.size(); i += stride)
    if (points[i].allFinite())
      sample.places.push_back(i);
  sample.near.resize(sample.places.size());
  parallelBlocks(
      sample.places.size(), kBlockSize, num_threads, [&](const Block& block) {
        for (std::size_t i = block.begin; i < block.end; ++i) {
          const Eigen::Vector3d p = points[sample.places[i]].cast<double>();
          for (std::size_t k = 0; k < target.size() && !sample.near[i]; ++k) {
            const Eigen::Vector3f q = (T_part_points[k] * p).cast<float>();
            sample.near[i] = target[k].tree->hasNeighbour(q, limit_sq);
          }
        }
      });
  return sample;
}

double
shareOf(const Sample& sample)
{
  const auto near = std::count(sample.near.begin(), sample.near.end(), 1);
  return sample.near.empty()
             ? 0
             : static_cast<double>(near) / static_cast<double>(sample.near.size());
}
} // namespace

double
agreementOf(const IcpTarget& target,
            const Points& points,
            const Eigen::Isometry3d& T_target_points,
            double distance,
            unsigned int num_threads)
{
  return shareOf(sampleOf(target, points, T_target_points, distance, num_threads));
}

AgreementChange
agreementChange(const IcpTarget& target,
                const Points& points,
                const Eigen::Isometry3d& T_target_before,
                const Eigen::Isometry3d& T_target_after,
                double distance,
                double cube,
                unsigned int num_threads)
{
  const Sample before =
      sampleOf(target, points, T_target_before, distance, num_threads);
  const Sample after = sampleOf(target, points, T_target_after, distance, num_threads);
  AgreementChange change{shareOf(before), shareOf(after), 0};
  std::map<VoxelKey, double> cubes; // gain of a cube's points beyond their share
  const double gain = change.after - change.before;
  for (std::size_t i = 0; i < before.places.size(); ++i)
    cubes[voxelKey(points[before.places[i]], cube)] +=
        after.near[i] - before.near[i] - gain;
  double squares = 0;
  for (const auto& [key, sum] : cubes)
    squares += sum * sum;
  if (!before.places.empty())
    change.deviation = std::sqrt(squares) / static_cast<double>(before.places.size());
  return change;
}

const PointTree&
MeasuredScan::tree(unsigned int num_threads) const
{
  if (!tree_)
    tree_.emplace(points_, num_threads);
  return *tree_;
}

AgreementChange
agreementChange(const MeasuredScan& a,
                const MeasuredScan& b,
                const Eigen::Isometry3d& T_a_b_before,
                const Eigen::Isometry3d& T_a_b_after,
                double distance,
                double cube,
                unsigned int num_threads)
{
  const auto oneWay = [&](const MeasuredScan& to,
                          const MeasuredScan& of,
                          const Eigen::Isometry3d& before,
                          const Eigen::Isometry3d& after) {
    IcpTargetPart part;
    part.tree = &to.tree(num_threads);
    part.points = &to.points();
    return agreementChange(
        {part}, of.points(), before, after, distance, cube, num_threads);
  };
  const AgreementChange there = oneWay(a, b, T_a_b_before, T_a_b_after);
  const AgreementChange back =
      oneWay(b, a, T_a_b_before.inverse(), T_a_b_after.inverse());
  return {0.5 * (there.before + back.before),
          0.5 * (there.after + back.after),
          0.5 * std::sqrt(there.deviation * there.deviation +
                          back.deviation * back.deviation)};
}

} // namespace pcl6d::slam6d
