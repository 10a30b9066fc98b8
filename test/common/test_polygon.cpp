// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/polygon.h>
#include <pcl6d/common/random.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {
using Ring = std::vector<Eigen::Vector3d>;

// A star about a centre, on the plane through the origin across the normal.
Ring
star(pcl6d::Random& random,
     const Eigen::Vector3d& normal,
     const Eigen::Vector2d& centre,
     double least,
     double most,
     std::size_t corners)
{
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  Ring ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle =
        2 * M_PI * static_cast<double>(i) / static_cast<double>(corners);
    const double radius = random.uniform(least, most);
    ring.push_back((centre.x() + radius * std::cos(angle)) * u +
                   (centre.y() + radius * std::sin(angle)) * v);
  }
  return ring;
}

double
signedArea(const Ring& ring, const Eigen::Vector3d& normal)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += ring[i].cross(ring[(i + 1) % ring.size()]) / 2;
  return sum.dot(normal);
}

// Checks that the triangles turn left, and returns their area.
double
areaOf(const std::vector<Ring>& rings, const Eigen::Vector3d& normal)
{
  Ring corners;
  for (const auto& ring : rings)
    corners.insert(corners.end(), ring.begin(), ring.end());
  double sum = 0;
  for (const auto& [a, b, c] : pcl6d::triangulate(rings, normal)) {
    const double area =
        (corners[b] - corners[a]).cross(corners[c] - corners[a]).dot(normal) / 2;
    EXPECT_GE(area, -1e-9);
    sum += area;
  }
  return sum;
}
} // namespace

TEST(Triangulate, FillsStarsWithHolesOnce)
{
  pcl6d::Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(trial);
    const Eigen::Vector3d normal =
        Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    std::vector<Ring> rings = {star(random, normal, {0, 0}, 6, 10, 60)};
    double expected = signedArea(rings[0], normal);
    std::size_t triangles = 58;
    for (int i = 0; i < trial % 6; ++i) { // holes do not touch each other
      const double angle = 2 * M_PI * i / 6;
      Ring hole = star(
          random, normal, {3 * std::cos(angle), 3 * std::sin(angle)}, 0.3, 1.4, 12);
      expected -= signedArea(hole, normal);
      std::reverse(hole.begin(), hole.end());
      rings.push_back(hole);
      triangles += 14;
    }
    EXPECT_EQ(pcl6d::triangulate(rings, normal).size(), triangles);
    EXPECT_NEAR(areaOf(rings, normal), expected, 1e-9);
  }
}

TEST(Triangulate, TakesSeveralOuterRings)
{
  pcl6d::Random random(6);
  const Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  std::vector<Ring> rings;
  double expected = 0;
  for (const double x : {0.0, 5.0}) {
    rings.push_back(star(random, normal, {x, 0}, 1.5, 2, 20));
    expected += signedArea(rings.back(), normal);
    rings.push_back(star(random, normal, {x, 0}, 0.5, 1, 9));
    expected -= signedArea(rings.back(), normal);
    std::reverse(rings.back().begin(), rings.back().end());
  }
  EXPECT_NEAR(areaOf(rings, normal), expected, 1e-9);
}

TEST(Triangulate, LeavesOutWhatIsNoRing)
{
  const Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(pcl6d::triangulate({}, normal).empty());
  EXPECT_TRUE(pcl6d::triangulate({{{0, 0, 0}, {1, 0, 0}}}, normal).empty());
  const Ring clockwise = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  EXPECT_TRUE(pcl6d::triangulate({clockwise}, normal).empty());
  const Ring square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(pcl6d::triangulate({{{5, 5, 0}}, square}, normal)[0][0], 4u);
}

TEST(Triangulate, EndsOnRingsThatCrossThemselves)
{
  pcl6d::Random random(7);
  Ring ring;
  for (int i = 0; i < 200; ++i)
    ring.emplace_back(random.uniform(), random.uniform(), 0);
  EXPECT_LE(pcl6d::triangulate({ring}, Eigen::Vector3d::UnitZ()).size(), 198u);
}

TEST(Polygon, AreaAndInside)
{
  const std::vector<Eigen::Vector2d> island{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  const std::vector<Eigen::Vector2d> lake{{1, 0.5}, {1, 1}, {2, 0.5}};
  EXPECT_DOUBLE_EQ(pcl6d::signedArea(island), 10);
  EXPECT_DOUBLE_EQ(pcl6d::signedArea(lake), -0.25);
  EXPECT_TRUE(pcl6d::isInside(island, {0.5, 2}));
  EXPECT_FALSE(pcl6d::isInside(island, {2, 2})) << "between the horns";
  EXPECT_TRUE(pcl6d::isInside(island, {1.2, 0.7}));
  EXPECT_FALSE(pcl6d::isInside({island, lake}, {1.2, 0.7})) << "in the lake";
  EXPECT_TRUE(pcl6d::isInside({island, lake}, {3, 0.5}));
  EXPECT_GT(pcl6d::leftTurn({0, 0}, {1, 0}, {1, 1}), 0);
}

TEST(Polygon, ConvexOneInSpaceGrownByAMargin)
{
  const std::vector<Eigen::Vector3d> square{{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(pcl6d::isInside(square, up, {1, 1, 7}, 0));
  EXPECT_FALSE(pcl6d::isInside(square, up, {2.1, 1, 1}, 0));
  EXPECT_TRUE(pcl6d::isInside(square, up, {2.1, 1, 1}, 0.2));
  EXPECT_EQ(pcl6d::centreOfArea(square), Eigen::Vector3d(1, 1, 1));
  EXPECT_DOUBLE_EQ(pcl6d::extentAlong(square, Eigen::Vector3d::UnitX()), 2);
  const std::vector<Eigen::Vector3d> over{{3, 0, 2}, {4, 0, 2}, {4, 1, 2}};
  EXPECT_DOUBLE_EQ(pcl6d::hullToHull(square, up, over), std::sqrt(2.0));
  EXPECT_TRUE(pcl6d::apartAcrossEdgesOf(square, over, 0.9));
  EXPECT_FALSE(pcl6d::apartAcrossEdgesOf(square, over, 1.1));
}
