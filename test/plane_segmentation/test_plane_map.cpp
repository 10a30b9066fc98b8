// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces.h"

#include <pcl6d/common/error.h>
#include <pcl6d/plane_segmentation/plane_map.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace pcl6d;

Eigen::Isometry3d
poseAt(double x, double y, double z)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::Quaterniond(0.9, 0.02, -0.03, 0.4).normalized().toRotationMatrix();
  pose.translation() << x, y, z;
  return pose;
}
} // namespace

TEST(PlaneMap, JoinsThePlanesOfScansFromSeveralPlaces)
{
  PlaneMap map;
  std::size_t first = 0;
  for (int i = 0; i < 4; ++i) {
    const auto pose = poseAt(0.5 * i - 1, 0.3 * i, 0);
    const auto numbers = map.addScan(
        transformed(test::room(0.01, 0.06, 1 + static_cast<std::uint64_t>(i)),
                    pose.inverse()),
        pose);
    ASSERT_EQ(numbers.size(), 6u);
    if (i == 0)
      first = numbers.size();
  }
  const auto found = map.planes();
  ASSERT_EQ(found.planes.size(), 6u);
  EXPECT_EQ(first, 6u);
  EXPECT_EQ(found.place_of.size(), 24u);
  std::size_t inliers = 0;
  for (const auto& segment : found.planes) {
    EXPECT_NEAR(segment.plane.normal.cwiseAbs().maxCoeff(), 1, 1e-6);
    EXPECT_NEAR(segment.plane.rms, 0.01, 0.001);
    const double truth = std::abs(segment.plane.normal.z()) > 0.9 ? 16 : 12;
    EXPECT_NEAR(segment.plane.area, truth, 0.05 * truth);
    inliers += segment.plane.inliers;
  }
  EXPECT_EQ(inliers, map.numPoints());
}

TEST(PlaneMap, APoseThatIsOffMakesPlanesThicker)
{
  PlaneMap map;
  const auto points = test::room(0.005, 0.06);
  for (const double shift : {0.0, 0.02}) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().z() = shift;
    map.addScan(points, pose);
  }
  const auto found = map.planes();
  ASSERT_EQ(found.planes.size(), 6u);
  for (const auto& segment : found.planes)
    if (std::abs(segment.plane.normal.z()) > 0.9)
      EXPECT_NEAR(segment.plane.rms, std::sqrt(0.005 * 0.005 + 0.01 * 0.01), 0.001);
    else
      EXPECT_NEAR(segment.plane.rms, 0.005, 0.0005);
}

TEST(PlaneMap, TheFacesOfAWallStayTwoPlanes)
{
  test::Surfaces here(0.005), there(0.005, 2);
  here.add({2, -1, -1}, {0, 2, 0}, {0, 0, 2}, 0.04);
  there.add({-1.99, -1, -1}, {0, 2, 0}, {0, 0, 2}, 0.04); // 1 cm behind it
  PlaneMap map;
  map.addScan(here.points(), Eigen::Isometry3d::Identity());
  Eigen::Isometry3d behind = Eigen::Isometry3d::Identity();
  behind.translation().x() = 4;
  map.addScan(there.points(), behind);
  const auto found = map.planes();
  ASSERT_EQ(found.planes.size(), 2u);
  EXPECT_LT(found.planes[0].seen_from.dot(found.planes[1].seen_from), -0.99);
}

TEST(PlaneMap, RefusesWhatBreaksARule)
{
  PlaneMapOptions options;
  options.cell = 0;
  EXPECT_THROW(PlaneMap{options}, BadArgument);
  PlaneMap map;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = std::nan("");
  EXPECT_THROW(map.addScan(test::room(0, 0.2), pose), BadArgument);
  EXPECT_TRUE(map.addScan({}, Eigen::Isometry3d::Identity()).empty());
  EXPECT_TRUE(map.planes().planes.empty());
}
