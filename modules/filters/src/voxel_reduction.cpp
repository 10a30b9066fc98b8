// SPDX-License-Identifier: BSD-3-Clause
#include "random_members.h"
#include "voxel_sort.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <pcl/types.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d {

namespace {
constexpr Named<ReductionMethod> kReductionMethods[] = {
    {ReductionMethod::kMean, "mean"},
    {ReductionMethod::kCentre, "centre"},
    {ReductionMethod::kRandom, "random"}};
} // namespace

ReductionMethod
reductionMethodFromName(const std::string& name)
{
  return fromName(kReductionMethods, "reduction", name);
}

std::vector<std::string>
reductionMethodNames()
{
  return namesOf(kReductionMethods);
}

std::string
toString(ReductionMethod method)
{
  return nameOf(kReductionMethods, method);
}

void
ReductionOptions::validate() const
{
  require(voxel > 0 && std::isfinite(voxel), "voxel", voxel, "finite and > 0");
  require(points_per_voxel >= 1, "points_per_voxel", points_per_voxel, ">= 1");
}

VoxelGroups::VoxelGroups(const Points& points, double voxel)
{
  filters::VoxelOrder order = filters::sortByVoxel(points, voxel);
  indices_.swap(order.indices);
  keys_.swap(order.keys);
  begin_.swap(order.begin);
}

pcl::Indices
VoxelGroups::chooseRandom(int count, std::uint64_t seed) const
{
  pcl::Indices chosen;
  for (std::size_t g = 0; g < size(); ++g)
    filters::appendRandom(indices(g),
                          static_cast<std::size_t>(count),
                          mixBits(key(g) ^ mixBits(seed)),
                          chosen);
  return chosen;
}

Eigen::Vector3f
meanOf(const Points& points, const IndexRange& indices)
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
  if (options.method == ReductionMethod::kMean)
    if (auto means = filters::meansByVoxel(points, options.voxel))
      return std::move(*means);
  const VoxelGroups groups(points, options.voxel);
  Points reduced;
  reduced.reserve(groups.size());
  if (options.method == ReductionMethod::kRandom)
    for (const auto i : groups.chooseRandom(options.points_per_voxel, options.seed))
      reduced.push_back(points[i]);
  else if (options.method == ReductionMethod::kCentre)
    for (std::size_t g = 0; g < groups.size(); ++g)
      reduced.push_back(voxelCentre(groups.key(g), options.voxel));
  else
    for (std::size_t g = 0; g < groups.size(); ++g)
      reduced.push_back(meanOf(points, groups.indices(g)));
  return reduced;
}

} // namespace pcl6d
