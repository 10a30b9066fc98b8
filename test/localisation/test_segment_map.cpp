// SPDX-License-Identifier: BSD-3-Clause
#include "localisation/plan.h"
#include "support/points.h"

#include <pcl6d/common/error.h>
#include <pcl6d/localisation/segment_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using pcl6d::SegmentMap;
using pcl6d::Segments;
using pcl6d::test::badArgumentOf;

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double
distanceByBruteForce(const Segments& segments,
                     const Eigen::Vector2d& place,
                     double most)
{
  double nearest = most;
  for (const auto& segment : segments)
    nearest = std::min(nearest, std::sqrt(squaredDistance(place, segment)));
  return nearest;
}

void
expectExact(const SegmentMap& map, int trials)
{
  pcl6d::Random random(3);
  for (int i = 0; i < trials; ++i) {
    const Eigen::Vector2d place(random.uniform(map.low().x() - 5, map.high().x() + 5),
                                random.uniform(map.low().y() - 5, map.high().y() + 5));
    ASSERT_EQ(map.distance(place),
              distanceByBruteForce(map.segments(), place, map.maxDistance()))
        << place.transpose();
  }
}
} // namespace

TEST(SegmentMap, KnowsTheDistanceToASegment)
{
  const SegmentMap map({{{0, 0}, {4, 0}}});
  EXPECT_DOUBLE_EQ(map.distance({2, 1.5}), 1.5) << "beside it";
  EXPECT_DOUBLE_EQ(map.distance({2, -1.5}), 1.5);
  EXPECT_DOUBLE_EQ(map.distance({5, 1}), M_SQRT2) << "beyond its end";
  EXPECT_EQ(map.distance({1, 0}), 0);
  EXPECT_EQ(map.distance({2, 3.5}), 3) << "no more than max_distance";
  EXPECT_EQ(map.distance({1000, 0}), 3) << "outside the grid";
  EXPECT_EQ(map.distance({std::nan(""), 0}), 3);
}

TEST(SegmentMap, IsExactWhateverTheCell)
{
  for (const double cell : {0.1, 0.5, 7.0}) {
    pcl6d::SegmentMapOptions options;
    options.cell = cell;
    expectExact(SegmentMap(pcl6d::test::street(), options), 20000);
  }
}

TEST(SegmentMap, StaysExactWithinABoundOfMemory)
{
  pcl6d::SegmentMapOptions options;
  options.max_cells = 100;
  const SegmentMap map(pcl6d::test::street(), options);
  EXPECT_GT(map.cell(), options.cell);
  const Eigen::Vector2d size = (map.high() - map.low()).array() + 2 * map.maxDistance();
  EXPECT_LE(std::floor(size.x() / map.cell() + 1) *
                std::floor(size.y() / map.cell() + 1),
            100);
  expectExact(map, 20000);
}

TEST(SegmentMap, KeepsNationalCoordinatesApart)
{
  Segments far = pcl6d::test::street();
  for (auto& wall : far) {
    wall.a += Eigen::Vector2d(434812, 5792541);
    wall.b += Eigen::Vector2d(434812, 5792541);
  }
  const SegmentMap near_map(pcl6d::test::street()), far_map(far);
  EXPECT_EQ(near_map.offset(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(far_map.offset(), far.front().a.array().round().matrix());
  const Eigen::Vector2d place(30.25, 1.75);
  EXPECT_NEAR(
      far_map.distance(place + Eigen::Vector2d(434812, 5792541) - far_map.offset()),
      near_map.distance(place),
      1e-8);
}

TEST(SegmentMap, RefusesWhatIsNoMap)
{
  using pcl6d::SegmentMapOptions;
  EXPECT_NE(badArgumentOf([] { SegmentMap({}); }).find("no line segment"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([] {
              SegmentMap({{{1, 1}, {1, 1}}});
            }).find("no line segment"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([] {
              SegmentMap({{{0, 0}, {1, 0}}, {{0, kInfinity}, {1, 0}}});
            }).find("segment 1"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([] {
              SegmentMap({{{0, 0}, {4.3e9, 0}}});
            }).find("segment 0"),
            std::string::npos);
  for (const auto& spoil :
       std::vector<void (*)(SegmentMapOptions&)>{[](auto& o) { o.max_distance = 0; },
                                                 [](auto& o) { o.cell = -1; },
                                                 [](auto& o) { o.cell = kInfinity; },
                                                 [](auto& o) { o.max_cells = 0; }}) {
    SegmentMapOptions options;
    spoil(options);
    EXPECT_THROW(SegmentMap({{{0, 0}, {1, 0}}}, options), pcl6d::BadArgument);
  }
}

TEST(SegmentMap, HoldsEachSegmentOnce)
{
  const Segments once = {{{0, 0}, {4, 0}}, {{0, 0}, {0, 3}}};
  Segments often = once;
  for (int i = 0; i < 50000; ++i) // each would be asked for in each of its cells
    often.push_back(i % 2 == 0 ? once[0] : pcl6d::Segment{once[0].b, once[0].a});
  const SegmentMap map(often), same(once);
  EXPECT_EQ(map.segments().size(), 2U);
  EXPECT_EQ(map.distance({2, 1}), same.distance({2, 1}));
}
