// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/filters/point_normals.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using pcl6d::estimateNormals;
using pcl6d::normalAt;
using pcl6d::Normals;
using pcl6d::Points;
using pcl6d::PointTree;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::sameBits;

namespace {
Normals
normalsOf(const Points& points, std::size_t k = 20, unsigned int threads = 0)
{
  return estimateNormals(points, PointTree(points), k, threads);
}

/** The definition: all points sorted by distance, then index; their covariance. */
struct Oracle {
  Eigen::Vector3d normal; ///< towards the origin
  double gap = 0; ///< between the two smallest values over the largest: how sharp it is
};

Oracle
oracleAt(const Eigen::Vector3f& place, const Points& points, std::size_t k)
{
  std::vector<pcl6d::Neighbour> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    order.push_back({static_cast<int>(i), pcl6d::distanceSq(place, points[i])});
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), k));
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& n : order)
    mean += points[n.index].cast<double>() / static_cast<double>(order.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& n : order) {
    const Eigen::Vector3d d = points[n.index].cast<double>() - mean;
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  Oracle found;
  found.normal = solver.eigenvectors().col(0);
  if (found.normal.dot(place.cast<double>()) > 0)
    found.normal = -found.normal;
  found.gap =
      (solver.eigenvalues()(1) - solver.eigenvalues()(0)) / solver.eigenvalues()(2);
  return found;
}

Points
onPlane(Random& random, const Eigen::Isometry3d& pose, int count = 400)
{
  Points points;
  for (int i = 0; i < count; ++i)
    points.push_back(
        (pose * Eigen::Vector3d(random.uniform(-2, 2), random.uniform(-2, 2), 0))
            .cast<float>());
  return points;
}

void
expectUnitOrZero(const Normals& normals)
{
  for (const auto& n : normals)
    EXPECT_TRUE(n.isZero(0) || std::abs(n.norm() - 1) < 1e-6) << n.transpose();
}
} // namespace

TEST(PointNormals, OfAPlaneAreItsNormal)
{
  Random random(1);
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Isometry3d pose = pcl6d::test::randomPose(random, 10, 3);
    const Points points = onPlane(random, pose);
    const Eigen::Vector3d n = pose.linear().col(2);
    const double side = n.dot(pose.translation()) > 0 ? -1 : 1;
    for (const std::size_t k : {10u, 20u, 64u}) {
      double worst = 1;
      for (const auto& found : normalsOf(points, k))
        worst = std::min(worst, found.cast<double>().dot(n) * side);
      // Points are rounded by 1e-6 m over a patch of 20 cm.
      EXPECT_GT(worst, 1 - 1e-6) << k;
    }
  }
}

TEST(PointNormals, OfASpherePointToItsMiddle)
{
  Random random(2);
  Points points;
  for (int i = 0; i < 5000; ++i)
    points.push_back(Eigen::Vector3d(random.normal(), random.normal(), random.normal())
                         .normalized()
                         .cast<float>() *
                     3);
  // About the origin, inside: all normals point to it.
  const Normals inside = normalsOf(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT(inside[i].dot(points[i].normalized()), -0.98f);
  // Seen from outside they point outwards, on the near side.
  for (auto& p : points)
    p.x() += 10;
  const Normals normals = normalsOf(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LE(normals[i].dot(points[i]), 1e-5f);
}

TEST(PointNormals, EqualTheDefinition)
{
  Random random(3);
  const Points points = pcl6d::test::randomCube(random, 500, 4);
  const PointTree tree(points);
  for (const std::size_t k : {3u, 7u, 20u, 64u})
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Oracle expected = oracleAt(points[i], points, k);
      const Eigen::Vector3d found = normalAt(points[i], tree, points, k).cast<double>();
      // Float distances and the rounding of the normal to float, over the gap.
      EXPECT_LT(1 - std::abs(found.dot(expected.normal)), 1e-6 / expected.gap);
      EXPECT_LE(found.dot(points[i].cast<double>()), 1e-6);
    }
}

TEST(PointNormals, MayBeAskedForElsewhere)
{
  Random random(4);
  const Points points = onPlane(random, pcl6d::poseFromEuler({0, 0, 3}, {}));
  const PointTree tree(points);
  EXPECT_LT(normalAt({0.1f, 0.2f, 2}, tree, points, 20).z(), -0.999f);
  EXPECT_LT(normalAt({0.1f, 0.2f, 4}, tree, points, 20).z(), -0.999f);
  for (const float bad : {kNan, kInfinity})
    EXPECT_TRUE(normalAt({0, bad, 0}, tree, points, 20).isZero(0));
}

TEST(PointNormals, AreZeroWhereThereAreNone)
{
  EXPECT_TRUE(normalsOf({}).empty());
  for (const Points& few : {Points{{1, 2, 3}}, Points{{1, 2, 3}, {2, 3, 4}}})
    for (const auto& n : normalsOf(few))
      EXPECT_TRUE(n.isZero(0));
  const Points same(50, {1, 2, 3});
  for (const auto& n : normalsOf(same))
    EXPECT_TRUE(n.isZero(0)) << "duplicates only";
  Points two = same;
  for (int i = 0; i < 50; i += 2)
    two[i] = {1.3f, 2.1f, 2.7f};
  for (const auto& n : normalsOf(two))
    EXPECT_TRUE(n.isZero(0)) << "two places";
  const Points bad(30, {kNan, 0, 0});
  for (const auto& n : normalsOf(bad))
    EXPECT_TRUE(n.isZero(0));
}

TEST(PointNormals, AreZeroOnLines)
{
  // Also where rounding to float makes the line uneven: 30 m off, points 5 mm apart.
  for (const Eigen::Vector3d& along :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.3, -0.1, 0.7)})
    for (const double offset : {0.0, 3.0, 30.0})
      for (const double step : {0.1, 0.005}) {
        Points line;
        for (int i = 0; i < 60; ++i)
          line.push_back(
              (Eigen::Vector3d(offset, offset, 1) + step * i * along).cast<float>());
        int given = 0;
        for (const auto& n : normalsOf(line))
          given += !n.isZero(0);
        EXPECT_EQ(given, 0) << "at " << offset << " m, every " << step << " m along "
                            << along.transpose();
      }
}

TEST(PointNormals, AreGivenOnNarrowStrips)
{
  // Five scan lines 2 cm apart of a wall at 20 m are no line.
  Points strip;
  for (int row = 0; row < 5; ++row)
    for (int i = 0; i < 100; ++i)
      strip.push_back(
          {20, 0.02f * static_cast<float>(i), 0.001f * static_cast<float>(row)});
  for (const auto& n : normalsOf(strip))
    EXPECT_LT(n.x(), -0.99f);
}

TEST(PointNormals, PassOverPointsThatAreNotFinite)
{
  Random random(5);
  const Eigen::Isometry3d pose = pcl6d::poseFromEuler({1, 2, 5}, {0.3, 0.2, 0});
  const Points good = onPlane(random, pose);
  Points mixed;
  for (const auto& p : good) {
    mixed.push_back(p);
    mixed.push_back({p.x(), kNan, p.z()});
    mixed.push_back({-kInfinity, p.y(), p.z()});
  }
  const Normals expected = normalsOf(good), found = normalsOf(mixed);
  ASSERT_EQ(found.size(), 3 * expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_TRUE(sameBits(found[3 * i], expected[i]));
    EXPECT_TRUE(found[3 * i + 1].isZero(0));
    EXPECT_TRUE(found[3 * i + 2].isZero(0));
  }
}

TEST(PointNormals, CountDuplicatesAsTheyCome)
{
  // Twice the points and twice the neighbours: the same patches.
  Random random(6);
  const Points once = pcl6d::test::randomCube(random, 300, 4);
  Points twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  const Normals a = normalsOf(once, 20), b = normalsOf(twice, 40);
  for (std::size_t i = 0; i < once.size(); ++i)
    EXPECT_GT(std::abs(a[i].dot(b[i])), 0.9999f);
}

TEST(PointNormals, AreUnitOrZeroOnHugeAndTinyCoordinates)
{
  Random random(7);
  for (const float scale : {1e-20f, 1e-6f, 1e6f, 1e15f, 1e18f, 1e30f}) {
    Points points = pcl6d::test::randomCube(random, 200, 2);
    for (auto& p : points)
      p *= scale;
    SCOPED_TRACE(scale);
    expectUnitOrZero(normalsOf(points));
  }
}

TEST(PointNormals, HaveTheSameBitsForEveryNumberOfThreads)
{
  Random random(8);
  const Points points = pcl6d::test::randomCube(random, 3000, 4);
  const Normals first = normalsOf(points, 20, 1);
  for (const unsigned int threads : {2u, 3u, 8u}) {
    const Normals normals = normalsOf(points, 20, threads);
    int different = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      different += !sameBits(normals[i], first[i]);
    EXPECT_EQ(different, 0) << threads;
  }
}

TEST(PointNormals, OfManyPlacesAreThoseOfEachAlone)
{
  // Several are made at once; places without a normal among them must not touch the others.
  Random random(9);
  Points points;
  for (int i = 0; i < 600; ++i)
    points.push_back(10 *
                     Eigen::Vector3f(random.normal(), random.normal(), random.normal())
                         .normalized());
  Points places = points;
  for (std::size_t i = 5; i < places.size(); i += 37)
    places[i].y() = kNan;
  const PointTree tree(points);
  for (const std::size_t k : {3, 7, 20, 33}) {
    const Normals together = estimateNormals(places, points, tree, k, 2);
    for (std::size_t i = 0; i < places.size(); ++i)
      ASSERT_TRUE(sameBits(together[i], normalAt(places[i], tree, points, k)))
          << k << ", " << i;
  }
}

TEST(PointNormals, NeedThreeToSixtyFourNeighbours)
{
  Random random(9);
  const Points points = pcl6d::test::randomCube(random, 200, 4);
  for (const std::size_t k : {0u, 1u, 2u, 65u, 1000000u})
    EXPECT_EQ(badArgumentOf([&] { normalsOf(points, k); }),
              "neighbours = " + std::to_string(k) + ", but must be in [3, 64]");
  EXPECT_NO_THROW(normalsOf(points, 3));
  EXPECT_NO_THROW(normalsOf(points, 64));
}

TEST(PointNormalsDeathTest, OfOnePlaceNeedThemToo)
{
  // Beyond 64 an array on the stack would be overrun: in a process of its own.
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  Random random(10);
  const Points points = pcl6d::test::randomCube(random, 5000, 4);
  const PointTree tree(points);
  for (const std::size_t k : {2u, 65u, 5000u})
    EXPECT_EXIT(
        {
          const bool refused =
              !badArgumentOf([&] { normalAt(points[0], tree, points, k); }).empty();
          std::exit(refused ? 0 : 1);
        },
        testing::ExitedWithCode(0),
        "")
        << k;
}

namespace {
/** \return rings on a floor 1 m below the scanner, dense along each ring */
Points
ringsOnFloor(const std::vector<double>& radii)
{
  Random random(11);
  Points points;
  for (const double radius : radii)
    for (double angle = 0; angle < 6.28; angle += 0.02 / radius)
      points.push_back({static_cast<float>(radius * std::cos(angle)),
                        static_cast<float>(radius * std::sin(angle)),
                        static_cast<float>(-1 + 0.005 * random.normal())});
  return points;
}

Normals
surfaceNormalsOf(const Points& points, double spacing)
{
  return pcl6d::estimateSurfaceNormals(
      points, PointTree(points), points, {10, spacing, 1});
}
} // namespace

TEST(SurfaceNormals, GrowAcrossLines)
{
  const Points points = ringsOnFloor({1.5, 1.7, 1.9, 2.1});
  const Normals nearest = normalsOf(points, 10);
  const Normals grown = surfaceNormalsOf(points, 0.03);
  std::size_t turned = 0, with_normal = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    turned += nearest[i].z() < 0.9F ? 1 : 0;
    if (grown[i].isZero(0))
      continue;
    ++with_normal;
    EXPECT_GT(grown[i].z(), 0.98F) << points[i].transpose();
  }
  EXPECT_GT(turned, points.size() / 4) << "of the ten nearest, all on one ring";
  EXPECT_GT(with_normal, points.size() * 9 / 10);
}

TEST(SurfaceNormals, ClaimNoPlaneOfASingleLine)
{
  for (const auto& normal : surfaceNormalsOf(ringsOnFloor({1.5}), 0.03))
    EXPECT_TRUE(normal.isZero(0)) << normal.transpose();
}

TEST(SurfaceNormals, OfEvenPointsAreThoseOfTheNearest)
{
  Random random(3);
  Points points;
  for (int i = 0; i < 4000; ++i)
    points.push_back({static_cast<float>(random.uniform(-1, 1)),
                      static_cast<float>(random.uniform(-1, 1)),
                      static_cast<float>(-1 + 0.003 * random.normal())});
  const Normals nearest = normalsOf(points, 10), grown = surfaceNormalsOf(points, 0.03);
  std::size_t equal = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    equal += grown[i] == nearest[i] ? 1 : 0;
  EXPECT_GT(equal, points.size() * 9 / 10);
}

TEST(SurfaceNormals, HaveTheSameBitsForAnyNumberOfThreads)
{
  const Points points = ringsOnFloor({1.5, 1.7, 1.9, 2.1});
  const PointTree tree(points);
  const Normals one =
      pcl6d::estimateSurfaceNormals(points, tree, points, {10, 0.03, 1});
  for (const unsigned int threads : {2u, 5u})
    EXPECT_TRUE(pcl6d::estimateSurfaceNormals(
                    points, tree, points, {10, 0.03, threads}) == one);
}

TEST(SurfaceNormals, OfWhatIsNoSurfaceAreZero)
{
  EXPECT_TRUE(surfaceNormalsOf({}, 0.1).empty());
  const Points odd = {
      {static_cast<float>(kNan), 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  for (const auto& normal : surfaceNormalsOf(odd, 0.1))
    EXPECT_TRUE(normal.isZero(0));
  EXPECT_NE(badArgumentOf([] {
              pcl6d::estimateSurfaceNormals({}, PointTree(), {}, {2, 0.1, 1});
            }).find("neighbours"),
            std::string::npos);
}
