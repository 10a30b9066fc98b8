// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/registration/pcl/joint_icp6d.h>

#include <limits>
#include <utility>

namespace pcl6d {
namespace registration {

void
JointTarget::make(std::vector<Points> targets, unsigned int num_threads)
{
  for (const auto& target : targets)
    points.insert(points.end(), target.begin(), target.end());
  const Eigen::Vector3f place = localOrigin(points);
  origin = place.cast<double>();
  for (auto& p : points)
    p -= place;
  parts = std::move(targets);
  std::size_t first = 0;
  for (auto& part : parts) {
    for (auto& p : part)
      p -= place;
    trees.push_back(std::make_shared<const PointTree>(part, num_threads));
    begin.push_back(first);
    first += part.size();
  }
}

std::vector<Neighbour>
JointTarget::nearestOfItsTarget(const Eigen::Vector3f& point, std::size_t k) const
{
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const float itself = std::numeric_limits<float>::min();
    if (trees[i]->nearest(point, itself).index < 0)
      continue;
    auto found = trees[i]->nearestK(point, k);
    for (auto& neighbour : found)
      neighbour.index += static_cast<int>(begin[i]);
    return found;
  }
  return {};
}

FindPairs
pairFinder(const Points& source,
           const PointTree& tree,
           const Points& target,
           bool is_reciprocal,
           unsigned int num_threads)
{
  const auto found =
      std::make_shared<std::vector<Neighbour>>(); // of the last iteration
  const Rejector reject =
      is_reciprocal ? reciprocal(source, target, num_threads) : Rejector();
  return [&source, &tree, &target, num_threads, found, reject](
             const Eigen::Isometry3d& T, double limit) {
    findClosest(
        tree, target, transformed(source, T), squaredLimit(limit), num_threads, *found);
    std::vector<IcpPair> pairs;
    for (std::size_t i = 0; i < found->size(); ++i)
      if ((*found)[i].index >= 0)
        pairs.push_back(
            {static_cast<int>(i), (*found)[i].index, (*found)[i].distance_sq});
    return reject ? reject(T, std::move(pairs)) : pairs;
  };
}

FindPairs
jointFinder(std::vector<FindPairs> finders,
            std::vector<std::size_t> source_begin,
            const JointTarget& target)
{
  return [finders = std::move(finders),
          source_begin = std::move(source_begin),
          &target](const Eigen::Isometry3d& T, double limit) {
    std::vector<IcpPair> pairs;
    for (std::size_t i = 0; i < finders.size(); ++i)
      for (IcpPair pair : finders[i](T, limit)) {
        pair.source += static_cast<int>(source_begin[i]);
        pair.target += static_cast<int>(target.begin[i]);
        pairs.push_back(pair);
      }
    return pairs;
  };
}

} // namespace registration

PCL6D_DEFINE_PAIR_INSTANCES(JointICP6D)
} // namespace pcl6d
