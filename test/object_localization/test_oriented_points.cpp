// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/localization_cases.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl6d {
namespace {
/** A level sheet of 0.2 m x 0.2 m, seen from above (side 1) or below (-1). */
test::Patch
sheet(double height, int side)
{
  const Eigen::Vector3d x = 0.2 * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = 0.2 * Eigen::Vector3d::UnitY();
  const Eigen::Vector3d corner(0.01, 0.01, height);
  return side > 0 ? test::Patch{corner, x, y} : test::Patch{corner, y, x};
}

std::ptrdiff_t
countUp(const OrientedPoints& surface)
{
  return std::count_if(surface.normals.begin(),
                       surface.normals.end(),
                       [](const Eigen::Vector3f& n) { return n.z() > 0.999F; });
}
} // namespace

TEST(ReduceOriented, MakesOneElementOfEachVoxelOfASurface)
{
  OrientedPoints surface;
  test::addPatch(surface, sheet(0.012, 1), 0.004);
  const OrientedPoints reduced = reduceOriented(surface, 0.05);
  ASSERT_EQ(reduced.normals.size(), reduced.size());
  EXPECT_EQ(countUp(reduced), static_cast<std::ptrdiff_t>(reduced.size()));
  EXPECT_GE(reduced.size(), 16u);
  EXPECT_LE(reduced.size(), 36u);
  for (const auto& p : reduced.points)
    EXPECT_NEAR(p.z(), 0.012F, 1e-6F);
}

TEST(ReduceOriented, KeepsBothFacesOfAThinSheet)
{
  OrientedPoints surface;
  test::addPatch(surface, sheet(0.012, 1), 0.004);
  const auto one_face = reduceOriented(surface, 0.05).size();
  test::addPatch(surface, sheet(0.010, -1), 0.004);
  const OrientedPoints reduced = reduceOriented(surface, 0.05);
  EXPECT_EQ(reduced.size(), 2 * one_face);
  EXPECT_EQ(countUp(reduced), static_cast<std::ptrdiff_t>(one_face));
  for (std::size_t i = 0; i < reduced.size(); ++i)
    EXPECT_NEAR(
        reduced.points[i].z(), reduced.normals[i].z() > 0 ? 0.012F : 0.010F, 1e-6F);
}

TEST(ReduceOriented, LeavesOutAFaceOfFewPointsAndPointsWithoutNormal)
{
  OrientedPoints surface;
  for (int i = 0; i < 10; ++i) {
    surface.points.emplace_back(0.01F * static_cast<float>(i % 4), 0.01F, 0.01F);
    surface.normals.push_back(Eigen::Vector3f::UnitZ());
  }
  for (int i = 0; i < 3; ++i) { // less than a third
    surface.points.emplace_back(0.02F, 0.02F, 0.01F);
    surface.normals.emplace_back(-Eigen::Vector3f::UnitZ());
  }
  surface.points.emplace_back(3.0F, 0.0F, 0.0F);
  surface.normals.push_back(Eigen::Vector3f::Zero());
  const OrientedPoints reduced = reduceOriented(surface, 1);
  ASSERT_EQ(reduced.size(), 1u);
  EXPECT_EQ(reduced.normals[0], Eigen::Vector3f(0, 0, 1));
}

TEST(ReduceOriented, RefusesWhatIsNoSurface)
{
  OrientedPoints surface;
  EXPECT_EQ(reduceOriented(surface, 0.1).size(), 0u);
  surface.points.emplace_back(0.0F, 0.0F, 0.0F);
  EXPECT_THROW(reduceOriented(surface, 0.1), BadArgument);
  surface.normals.emplace_back(0.0F, 0.0F, 1.0F);
  EXPECT_THROW(reduceOriented(surface, 0), BadArgument);
}

} // namespace pcl6d
