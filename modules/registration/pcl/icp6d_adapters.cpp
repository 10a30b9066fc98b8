// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/registration/pcl/impl/icp6d_adapters.hpp>

#include <pcl/types.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace pcl6d {
namespace registration {

Rejector
inTurn(std::vector<Rejector> rejectors)
{
  return [rejectors = std::move(rejectors)](const Eigen::Isometry3d& T,
                                            std::vector<IcpPair> pairs) {
    for (const auto& rejector : rejectors)
      pairs = rejector(T, std::move(pairs));
    return pairs;
  };
}

Rejector
reciprocal(const Points& source, const Points& target, unsigned int num_threads)
{
  const auto tree = std::make_shared<const PointTree>(source, num_threads);
  return [tree, &target](const Eigen::Isometry3d& T, std::vector<IcpPair> pairs) {
    const Eigen::Isometry3d T_source_target = T.inverse();
    const auto denied = [&](const IcpPair& pair) {
      const Eigen::Vector3d p = T_source_target * target[pair.target].cast<double>();
      return tree->nearest(p.cast<float>(), std::numeric_limits<float>::infinity())
                 .index != pair.source;
    };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), denied), pairs.end());
    return pairs;
  };
}

void
requireMotion(const Eigen::Matrix4d& matrix)
{
  const Eigen::Matrix3d R = matrix.topLeftCorner<3, 3>();
  const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  constexpr double kTolerance = 1e-3; // thousands of float roundings
  if (off > kTolerance || R.determinant() < 0)
    throw BadArgument(
        "ICP6D: the transformation estimation made a matrix that is no motion, with "
        "scale, shear or mirroring; setEstimateScale(true) estimates a scale");
}

std::vector<int>
placesIn(const pcl::IndicesConstPtr& searched, std::size_t cloud_size)
{
  if (!searched)
    return {};
  std::vector<int> places(cloud_size, -1);
  for (std::size_t i = 0; i < searched->size(); ++i)
    places.at((*searched)[i]) = static_cast<int>(i);
  return places;
}

Normals
givenOrEstimated(Normals given,
                 const Points& points,
                 const PointTree* tree,
                 const ScanNormals& settings,
                 const IcpOptions& options)
{
  const bool are_given = std::any_of(given.begin(), given.end(), [](const auto& n) {
    return n.allFinite() && !n.isZero(0);
  });
  if (are_given)
    return given;
  std::optional<PointTree> own;
  if (!tree)
    tree = &own.emplace(points, options.num_threads);
  return estimateScanNormals(points, *tree, settings, options.num_threads);
}

} // namespace registration
} // namespace pcl6d
