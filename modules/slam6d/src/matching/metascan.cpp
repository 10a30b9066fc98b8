// SPDX-License-Identifier: BSD-3-Clause
#include "matching/metascan.h"

#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <limits>

namespace pcl6d::slam6d {

namespace {
/** Points and normals, thinned to the first point of each voxel. */
class Union {
public:
  explicit Union(double voxel) : voxel_(voxel) {}

  void
  add(const IcpModel& scan, const Eigen::Isometry3d& T)
  {
    const bool has_normals = !scan.normals().empty();
    for (std::size_t i = 0; i < scan.points().size(); ++i) {
      const Eigen::Vector3f p = (T * scan.points()[i].cast<double>()).cast<float>();
      const bool in_grid = p.cwiseAbs().maxCoeff() < kGridCells * voxel_;
      if (in_grid && !occupied_.add(voxelKey(p, voxel_)).second)
        continue;
      points.push_back(p);
      if (has_normals)
        normals.push_back(
            (T.linear() * scan.normals()[i].cast<double>()).cast<float>());
    }
  }

  Points points;
  Normals normals;

private:
  static constexpr double kGridCells = (1 << 20) - 1; // limit of voxelKey(), less a
                                                      // cell for rounding
  double voxel_;
  VoxelNumbers occupied_;
};
} // namespace

Metascan::Metascan(double voxel, int max_scans, const IcpModel::Options& options)
: voxel_(voxel)
, max_scans_(max_scans > 0 ? max_scans : std::numeric_limits<std::size_t>::max())
, options_(options)
{}

void
Metascan::add(const IcpModel& scan, const Eigen::Isometry3d& T_world_scan)
{
  members_.push_back({&scan, T_world_scan});
}

IcpTarget
Metascan::around(const Eigen::Vector3d& origin)
{
  IcpTarget target;
  std::size_t end = members_.size();
  const std::size_t begin = end - std::min(end, max_scans_);
  while (end > begin) { // the largest node with this end
    int level = 0;
    while (end % (std::size_t{2} << level) == 0 && end - begin >= std::size_t{2}
                                                                      << level)
      ++level;
    const std::size_t size = std::size_t{1} << level;
    if (level == 0) {
      const Member& member = members_[end - 1];
      Eigen::Isometry3d T = member.T_world_scan;
      T.translation() -= origin;
      target.push_back(member.scan->part(T));
    }
    else {
      const Node& part = node({level, end / size - 1});
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.translation() = part.origin - origin;
      target.push_back(part.model.part(T));
    }
    end -= size;
  }
  return target;
}

const Metascan::Node&
Metascan::node(const Place& place)
{
  const auto known = nodes_.find(place);
  if (known != nodes_.end())
    return known->second;
  const std::size_t size = std::size_t{1} << place.first;
  const std::size_t begin = place.second * size;
  // Whole metres from the first scan: the voxels do not depend on the world's origin.
  const Eigen::Vector3d first = members_.front().T_world_scan.translation();
  const Eigen::Vector3d origin =
      first.array() +
      (members_[begin].T_world_scan.translation() - first).array().round();
  Union all(voxel_);
  for (std::size_t i = begin; i < begin + size; ++i) {
    Eigen::Isometry3d T = members_[i].T_world_scan;
    T.translation() -= origin;
    all.add(*members_[i].scan, T);
  }
  IcpModel model = all.normals.size() == all.points.size() && !all.points.empty()
                       ? IcpModel(all.points, all.normals, options_)
                       : IcpModel(all.points, options_);
  // The node's parts are not needed again, unless the target is limited to the last scans.
  if (max_scans_ == std::numeric_limits<std::size_t>::max())
    for (int level = place.first - 1; level > 0; --level) {
      const std::size_t parts = std::size_t{1} << (place.first - level);
      nodes_.erase(nodes_.lower_bound({level, place.second * parts}),
                   nodes_.lower_bound({level, (place.second + 1) * parts}));
    }
  return nodes_.emplace(place, Node{origin, std::move(model)}).first->second;
}

} // namespace pcl6d::slam6d
