// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/angle.h>
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/localisation/levelling.h>
#include <pcl6d/search/point_tree.h>

#include <cmath>

namespace pcl6d {

namespace {
/** One step of the weighted least squares: how up moves in its horizontal plane. */
struct TiltSums {
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  double weight = 0;

  void
  add(const Eigen::Vector3d& n, double w)
  {
    A += w * n.head<2>() * n.head<2>().transpose();
    b -= w * n.z() * n.head<2>();
    weight += w;
  }
};

/** The least-squares tilt, only in directions fixed by the walls. */
Eigen::Vector2d
solve(const TiltSums& sums, double least, bool& is_fixed)
{
  constexpr double kLeastShare = 0.02; // of the weight: least that must
                                       // face a direction
  const auto eigen = symmetricEigen<2>(sums.A);
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();
  is_fixed = true;
  for (int i = 0; i < 2; ++i) {
    const double lambda = eigen.values(i);
    const Eigen::Vector2d axis = eigen.vectors.col(i);
    if (lambda > kLeastShare * sums.weight && lambda > least)
      tilt += axis * (axis.dot(sums.b) / lambda);
    else
      is_fixed = false;
  }
  return tilt;
}
} // namespace

Eigen::Matrix3d
levellingOf(const Eigen::Vector3d& up)
{
  // Up is the last row of Ry(pitch) Rx(roll), built without angles.
  const Eigen::Vector3d z = up.normalized();
  const double flat = std::sqrt(z.y() * z.y() + z.z() * z.z()); // cos pitch
  Eigen::Matrix3d R;
  if (flat < 1e-12)
    R << 0, 0, -z.x(), 0, 1, 0, z.x(), 0, 0;
  else
    R << flat, -z.x() * z.y() / flat, -z.x() * z.z() / flat, //
        0, z.z() / flat, -z.y() / flat,                      //
        z.transpose();
  return R;
}

Levelling
levelByNormals(const std::vector<Eigen::Vector3d>& normals,
               const std::vector<double>& weights,
               const Eigen::Matrix3d& guess,
               double least)
{
  require(weights.empty() || weights.size() == normals.size(),
          "weights",
          weights.size(),
          "one per normal, " + std::to_string(normals.size()));
  Levelling level;
  level.R_level_source = levellingOf(guess.row(2).transpose());
  // The scale of Cauchy's weights shrinks from the largest tilt to the tilt of a wall.
  for (const double scale : {8.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.5, 0.5}) {
    TiltSums sums;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Eigen::Vector3d n = level.R_level_source * normals[i];
      const double ratio = n.z() / (scale * kDegree);
      if (n.squaredNorm() > 0.5 && std::abs(ratio) < 3)
        sums.add(n, (weights.empty() ? 1 : weights[i]) / (1 + ratio * ratio));
    }
    const Eigen::Vector2d tilt = solve(sums, least, level.is_fixed);
    level.walls = sums.weight;
    const Eigen::Vector3d up(tilt.x(), tilt.y(), 1);
    level.R_level_source =
        levellingOf(level.R_level_source.transpose() * up.normalized());
  }
  return level;
}

Levelling
levelByWalls(const Points& points, const Eigen::Matrix3d& guess, double voxel)
{
  constexpr std::size_t kNeighbours = 12;
  constexpr double kLeast = 20; // points
  ReductionOptions reduction;
  reduction.voxel = voxel;
  const Points reduced = reducePoints(points, reduction);
  const PointTree tree(reduced, 1);
  const Normals normals = estimateNormals(reduced, tree, kNeighbours, 1);
  std::vector<Eigen::Vector3d> walls;
  walls.reserve(normals.size());
  for (const auto& normal : normals)
    walls.push_back(normal.cast<double>());
  return levelByNormals(walls, {}, guess, kLeast);
}

} // namespace pcl6d
