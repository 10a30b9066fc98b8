// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/plane.h>
#include <pcl6d/common/random.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace {
// Area of a polygon, positive if it runs counter-clockwise against the normal.
double
areaAgainst(const std::vector<Eigen::Vector3d>& polygon, const Eigen::Vector3d& normal)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += polygon[i].cross(polygon[(i + 1) % polygon.size()]) / 2;
  return sum.dot(normal);
}

const Eigen::Vector3d kNormal = Eigen::Vector3d(1, -2, 3).normalized();

// A place on the plane with offset 5.
Eigen::Vector3d
onPlane(double x, double y)
{
  const Eigen::Vector3d u = kNormal.cross(Eigen::Vector3d::UnitX()).normalized();
  return 5 * kNormal + x * u + y * kNormal.cross(u);
}
} // namespace

TEST(ConvexHull, LeavesOutInnerPointsAndPointsOnEdges)
{
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= 4; ++i)
    for (int k = 0; k <= 2; ++k)
      points.push_back(onPlane(i, k));
  const auto hull = pcl6d::convexHull(points, kNormal);
  EXPECT_EQ(hull.size(), 4u);
  EXPECT_NEAR(areaAgainst(hull, kNormal), 8, 1e-12);
  EXPECT_NEAR(areaAgainst(pcl6d::convexHull(points, -kNormal), -kNormal), 8, 1e-12);
}

TEST(ConvexHull, HoldsAllPoints)
{
  pcl6d::Random random(1);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 500; ++i)
    points.push_back(onPlane(random.normal(), random.normal()));
  const auto hull = pcl6d::convexHull(points, kNormal);
  ASSERT_GE(hull.size(), 3u);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector3d& a = hull[i];
    const Eigen::Vector3d edge = hull[(i + 1) % hull.size()] - a;
    for (const auto& p : points)
      EXPECT_GE(kNormal.dot(edge.cross(p - a)), -1e-9);
  }
}

TEST(ConvexHull, OfFewPointsIsWhatThereIs)
{
  EXPECT_TRUE(pcl6d::convexHull({}, kNormal).empty());
  const auto line =
      pcl6d::convexHull({onPlane(0, 0), onPlane(1, 0), onPlane(2, 0)}, kNormal);
  EXPECT_EQ(line.size(), 2u);
}

TEST(OrientPlane, MakesTheOffsetPositiveAndTurnsTheHull)
{
  pcl6d::Plane plane;
  plane.normal = -kNormal;
  plane.offset = -5;
  plane.hull =
      pcl6d::convexHull({onPlane(0, 0), onPlane(1, 0), onPlane(0, 1)}, -kNormal);
  pcl6d::orientPlane(plane);
  EXPECT_EQ(plane.normal, kNormal);
  EXPECT_EQ(plane.offset, 5);
  EXPECT_NEAR(areaAgainst(plane.hull, kNormal), 0.5, 1e-12);
}

TEST(OrientPlane, ThroughTheOriginGoesByTheFirstComponent)
{
  pcl6d::Plane plane;
  plane.normal = {0, -0.6, 0.8};
  plane.offset = 0;
  pcl6d::orientPlane(plane);
  EXPECT_EQ(plane.normal, Eigen::Vector3d(0, 0.6, -0.8));
  EXPECT_FALSE(std::signbit(plane.offset));
}

TEST(HullPrism, HoldsWhatIsOverOrUnderTheHull)
{
  pcl6d::Plane plane;
  plane.normal = kNormal;
  plane.offset = 5;
  plane.hull =
      pcl6d::convexHull({onPlane(0, 0), onPlane(2, 0), onPlane(0, 1)}, kNormal);
  const pcl6d::HullPrism prism(plane);
  for (const double height : {-7.0, 0.0, 3.0}) {
    const Eigen::Vector3d up = height * kNormal;
    EXPECT_TRUE(prism.covers(onPlane(0.5, 0.5) + up));
    EXPECT_FALSE(prism.covers(onPlane(-0.1, 0.5) + up));
    EXPECT_TRUE(prism.covers(onPlane(-0.1, 0.5) + up, 0.11));
    EXPECT_FALSE(prism.covers(onPlane(-0.1, 0.5) + up, 0.09));
    EXPECT_FALSE(prism.covers(onPlane(1.5, 0.5) + up)) << "beyond the slanted side";
    EXPECT_FALSE(prism.covers(onPlane(0.1, 0.1) + up, -0.11));
  }
  std::reverse(plane.hull.begin(), plane.hull.end());
  plane.normal = -plane.normal; // the other side of the same
  EXPECT_TRUE(pcl6d::HullPrism(plane).covers(onPlane(0.5, 0.5)));
  EXPECT_FALSE(pcl6d::HullPrism(plane).covers(onPlane(-0.1, 0.5)));
}

TEST(PlaneLabel, HasAName)
{
  EXPECT_STREQ(toString(pcl6d::PlaneLabel::kNone), "none");
  EXPECT_STREQ(toString(pcl6d::PlaneLabel::kFloor), "floor");
  EXPECT_STREQ(toString(pcl6d::PlaneLabel::kCeiling), "ceiling");
  EXPECT_STREQ(toString(pcl6d::PlaneLabel::kWall), "wall");
  EXPECT_STREQ(toString(pcl6d::PlaneLabel::kDoor), "door");
}
