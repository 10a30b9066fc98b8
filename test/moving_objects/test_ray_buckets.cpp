// SPDX-License-Identifier: BSD-3-Clause
#include "ray_buckets.h"
#include "support/points.h"

#include <pcl6d/common/random.h>

#include <map>
#include <set>

namespace pcl6d::moving_objects {
namespace {

using test::kInfinity;
using test::kNan;

constexpr double kCell = 0.02;  // [rad]
constexpr double kNoise = 0.01; // [m]
const Eigen::Vector3f kOrigin(1, -2, 0.5);

/** In the middle of a cell, as the number of cells of a face is odd: 79. */
Eigen::Vector3f
ahead(float range, float aside = 0)
{
  return kOrigin + Eigen::Vector3f(range, range * aside, 0);
}

RayBuckets
bucketsAt(const Points& points)
{
  return bucketsOf(points, kOrigin, kCell, kNoise);
}

TEST(RayBuckets, PutPointsTogetherThatAreNearInDirectionAndRange)
{
  // Ranges are of one thing up to 3 sigma and the width of the cell: 0.03 + 0.02 x 5 m.
  const RayBuckets found = bucketsAt({ahead(5), ahead(5.1F), ahead(5.02F, 0.002F)});
  EXPECT_EQ(found.bucket, (std::vector<std::uint32_t>{0, 0, 0}));
  ASSERT_EQ(found.places.size(), 1u);
  EXPECT_EQ(found.places[0], ahead(5.02F, 0.002F)) << "the one in the middle";
}

TEST(RayBuckets, TellThingsBehindEachOtherApart)
{
  const RayBuckets found = bucketsAt({ahead(5.3F), ahead(5)});
  EXPECT_EQ(found.bucket, (std::vector<std::uint32_t>{1, 0})) << "by range";
  EXPECT_EQ(found.places, (Points{ahead(5), ahead(5.3F)}));
}

TEST(RayBuckets, TellThingsBesideEachOtherApart)
{
  const RayBuckets found =
      bucketsAt({ahead(5), ahead(5, static_cast<float>(2 * kCell))});
  EXPECT_NE(found.bucket[0], found.bucket[1]);
}

TEST(RayBuckets, FollowASurfaceThatRunsAlongTheRay)
{
  Points along;
  for (int i = 0; i < 50; ++i)
    along.push_back(ahead(5 + 0.1F * static_cast<float>(i)));
  EXPECT_EQ(bucketsAt(along).places.size(), 1u) << "no gap is wider than the tolerance";
}

TEST(RayBuckets, LeaveOutWhatHasNoDirection)
{
  const RayBuckets found =
      bucketsAt({{kNan, 0, 0}, kOrigin, {0, kInfinity, 0}, ahead(5)});
  constexpr std::uint32_t kNone = RayBuckets::kNone;
  EXPECT_EQ(found.bucket, (std::vector<std::uint32_t>{kNone, kNone, kNone, 0}));
  EXPECT_TRUE(bucketsAt({}).places.empty());
  EXPECT_TRUE(bucketsAt({kOrigin}).places.empty());
}

TEST(RayBuckets, DoNotDependOnTheOrderOfPoints)
{
  Random random(3);
  Points points;
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(static_cast<float>(random.normal()),
                        static_cast<float>(random.normal()),
                        static_cast<float>(random.normal()));
  Points turned(points.rbegin(), points.rend());
  const RayBuckets found = bucketsAt(points), again = bucketsAt(turned);
  EXPECT_EQ(found.places, again.places);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(found.bucket[i], again.bucket[points.size() - 1 - i]) << i;
}

TEST(RayBuckets, HoldEachPointOnceAndOneOfThemIsThePlace)
{
  Random random(4);
  Points points;
  for (int i = 0; i < 3000; ++i)
    points.push_back(ahead(static_cast<float>(random.uniform(1, 9)),
                           static_cast<float>(random.uniform(-0.5, 0.5))));
  const RayBuckets found = bucketsAt(points);
  std::map<std::uint32_t, Points> members;
  for (std::size_t i = 0; i < points.size(); ++i)
    members[found.bucket[i]].push_back(points[i]);
  ASSERT_EQ(members.size(), found.places.size()) << "none is empty";
  for (const auto& [bucket, inside] : members)
    EXPECT_EQ(std::count(inside.begin(), inside.end(), found.places.at(bucket)), 1);
}

} // namespace
} // namespace pcl6d::moving_objects
