// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/object_localization/normal_orientation.h>
#include <pcl6d/object_localization/oriented_points.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl6d {
namespace {
/** A ring: not convex, with normals to the outside. */
OrientedPoints
torus(const Eigen::Vector3d& middle, double radius, double tube)
{
  constexpr int kAround = 80, kAcross = 24;
  OrientedPoints surface;
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k < kAcross; ++k) {
      const double a = 2 * M_PI * i / kAround, b = 2 * M_PI * k / kAcross;
      const Eigen::Vector3d out(std::cos(a), std::sin(a), 0);
      const Eigen::Vector3d normal =
          std::cos(b) * out + std::sin(b) * Eigen::Vector3d::UnitZ();
      surface.points.push_back((middle + radius * out + tube * normal).cast<float>());
      surface.normals.push_back(normal.cast<float>());
    }
  return surface;
}

Normals
flippedAtRandom(Normals normals, std::uint64_t seed)
{
  Random random(seed);
  for (auto& n : normals)
    if (random.uniform() < 0.5)
      n = -n;
  return normals;
}
} // namespace

TEST(OrientNormals, TurnsThoseOfEachSurfaceToTheOutside)
{
  OrientedPoints surface = torus({0, 0, 0}, 1, 0.3);
  const OrientedPoints other = torus({5, 1, 2}, 0.5, 0.2);
  surface.points.insert(surface.points.end(), other.points.begin(), other.points.end());
  surface.normals.insert(
      surface.normals.end(), other.normals.begin(), other.normals.end());
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Normals normals = flippedAtRandom(surface.normals, seed);
    orientNormals(normals, surface.points, PointTree(surface.points));
    EXPECT_EQ(normals, surface.normals);
  }
}

TEST(OrientNormals, LeavesZeroOnesAndGoesAroundThem)
{
  const OrientedPoints surface = torus({0, 0, 0}, 1, 0.3);
  Normals truth = surface.normals;
  for (std::size_t i = 0; i < truth.size(); i += 7)
    truth[i].setZero();
  Normals normals = flippedAtRandom(truth, 4);
  orientNormals(normals, surface.points, PointTree(surface.points));
  EXPECT_EQ(normals, truth);
}

TEST(OrientNormals, RefusesBadArguments)
{
  const OrientedPoints surface = torus({0, 0, 0}, 1, 0.3);
  const PointTree tree(surface.points);
  Normals few(3, Eigen::Vector3f::UnitZ());
  EXPECT_THROW(orientNormals(few, surface.points, tree), BadArgument);
  Normals normals = surface.normals;
  EXPECT_THROW(orientNormals(normals, surface.points, tree, 2), BadArgument);
  EXPECT_THROW(orientNormals(normals, surface.points, tree, 65), BadArgument);
  Normals none;
  EXPECT_NO_THROW(orientNormals(none, {}, PointTree(Points())));
}

} // namespace pcl6d
