// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

void
ReductionOptions::validate() const
{
  require(voxel > 0 && std::isfinite(voxel), "voxel", voxel, "finite and > 0");
  require(points_per_voxel >= 1, "points_per_voxel", points_per_voxel, ">= 1");
}

VoxelGroups::VoxelGroups(const Points& points, double voxel)
{
  members_.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite())
      members_.push_back({voxelKey(points[i], voxel), static_cast<int>(i)});
  std::sort(members_.begin(), members_.end(), [](const Member& a, const Member& b) {
    return a.key < b.key || (a.key == b.key && a.index < b.index);
  });
  for (std::size_t i = 0; i < members_.size(); ++i)
    if (i == 0 || members_[i].key != members_[i - 1].key)
      begin_.push_back(i);
  begin_.push_back(members_.size());
}

std::size_t
VoxelGroups::size() const
{
  return begin_.size() - 1;
}

VoxelKey
VoxelGroups::key(std::size_t group) const
{
  return members_[begin_[group]].key;
}

pcl::Indices
VoxelGroups::indices(std::size_t group) const
{
  pcl::Indices indices;
  for (std::size_t i = begin_[group]; i < begin_[group + 1]; ++i)
    indices.push_back(members_[i].index);
  return indices;
}

pcl::Indices
VoxelGroups::chooseRandom(std::size_t group, int count, std::uint64_t seed) const
{
  pcl::Indices indices = this->indices(group);
  const auto wanted = static_cast<std::size_t>(count);
  if (indices.size() <= wanted)
    return indices;
  std::uint64_t bits = mixBits(key(group) ^ mixBits(seed));
  for (std::size_t i = 0; i < wanted; ++i) { // partial shuffle of Fisher and Yates
    bits = mixBits(bits);
    std::swap(indices[i], indices[i + bits % (indices.size() - i)]);
  }
  indices.resize(wanted);
  std::sort(indices.begin(), indices.end());
  return indices;
}

Eigen::Vector3f
meanOf(const Points& points, const pcl::Indices& indices)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto index : indices)
    sum += points[index].cast<double>();
  return (sum / static_cast<double>(indices.size())).cast<float>();
}

Points
reducePoints(const Points& points, const ReductionOptions& options)
{
  options.validate();
  const VoxelGroups groups(points, options.voxel);
  Points reduced;
  reduced.reserve(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    switch (options.method) {
    case ReductionMethod::kCentre:
      reduced.push_back(voxelCentre(groups.key(g), options.voxel));
      break;
    case ReductionMethod::kMean:
      reduced.push_back(meanOf(points, groups.indices(g)));
      break;
    case ReductionMethod::kRandom:
      for (const auto i :
           groups.chooseRandom(g, options.points_per_voxel, options.seed))
        reduced.push_back(points[i]);
      break;
    }
  return reduced;
}

} // namespace pcl6d
