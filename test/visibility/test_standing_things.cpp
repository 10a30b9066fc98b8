// SPDX-License-Identifier: BSD-3-Clause
// Contradicted points that are of things which stand alone, and such that are of walls: sheets of
// points with exact places, and a person in front of a wall.
#include "standing_things.h"
#include "support/points.h"

#include <pcl6d/visibility/sight_evidence.h>

#include <gtest/gtest.h>

#include <algorithm>

using pcl6d::Points;
using pcl6d::RayImage;
using pcl6d::RayImageOptions;
using pcl6d::SightEvidence;
using pcl6d::sightEvidence;
using pcl6d::SightPatch;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::visibility::StandingThings;
using pcl6d::visibility::standingThings;

namespace {
constexpr double kStep = 0.1;  // [m] of points on a sheet
constexpr double kReach = 0.2; // [m]
constexpr double kLargest = 2.5;
constexpr double kPatch = 0.4; // [m]

/** A sheet across the x axis, and its patches: rows of points. */
struct Sheet {
  Points points;
  std::vector<std::vector<std::size_t>> patches;

  void
  add(double x, double y, int wide, int high)
  {
    for (int k = 0; k < high; ++k) {
      patches.emplace_back();
      for (int i = 0; i < wide; ++i) {
        patches.back().push_back(points.size());
        points.push_back(Eigen::Vector3d(x, y + kStep * i, kStep * k).cast<float>());
      }
    }
  }
};

StandingThings
thingsOf(const Sheet& free, const Points& confirmed = {}, double largest = kLargest)
{
  return standingThings(free.points, confirmed, free.patches, kReach, largest);
}

/** \return a person, as far as one side of it is seen, and a wall behind it */
Points
personAt(double y, double wide = 0.5, double high = 1.7)
{
  Points points;
  for (double dy = 0; dy < wide; dy += 0.05)
    for (double z = -1; z < high - 1; z += 0.05)
      points.push_back(Eigen::Vector3d(3, y + dy, z).cast<float>());
  return points;
}

Points
wall()
{
  Points points;
  for (double y = -3; y < 3; y += 0.04)
    for (double z = -3; z < 3; z += 0.04)
      points.push_back(Eigen::Vector3d(5, y, z).cast<float>());
  return points;
}

/** \return what rays that ended at the wall say of points before it and of the wall */
SightEvidence
seenBefore(const Points& people, const SightPatch& patch)
{
  RayImageOptions options;
  options.finest = 0.03;
  Points points = wall();
  points.insert(points.end(), people.begin(), people.end());
  return sightEvidence(
      RayImage(wall(), options), points, Eigen::Isometry3d::Identity(), {}, patch);
}
} // namespace

TEST(StandingThings, AreAsManyAsHangTogether)
{
  Sheet free;
  free.add(3, 0, 5, 10);
  EXPECT_EQ(thingsOf(free).things, 1u);
  EXPECT_EQ(thingsOf(free).patches, 10u);
  free.add(3, 2, 5, 7); // 1.6 m beside it
  EXPECT_EQ(thingsOf(free).things, 2u);
  EXPECT_EQ(thingsOf(free).patches, 17u);
  free.add(3, 0.5, 4, 10); // 0.1 m beside the first one, which becomes broader
  EXPECT_EQ(thingsOf(free).things, 2u);
  EXPECT_EQ(thingsOf(free).patches, 27u);
}

TEST(StandingThings, AreNoLargerThanIsSaid)
{
  Sheet free;
  free.add(3, 0, 4, 5); // 0.3 x 0.4 m: its diagonal is 0.5 m
  EXPECT_EQ(thingsOf(free, {}, 0.501).things, 1u);
  EXPECT_EQ(thingsOf(free, {}, 0.499).things, 0u);
  EXPECT_EQ(thingsOf(free, {}, 0.499).patches, 0u);
}

TEST(StandingThings, AreNoPartsOfWhatIsConfirmedAroundThem)
{
  Sheet free, around;
  free.add(3, 0, 1, 10); // a strip ...
  EXPECT_EQ(thingsOf(free).things, 1u);
  around.add(3, -1, 10, 10); // ... of a wall that goes on at both sides
  around.add(3, 0.1, 10, 10);
  EXPECT_EQ(thingsOf(free, around.points).things, 0u);
  for (auto& p : around.points)
    p.x() += 0.25F; // the wall is behind it
  EXPECT_EQ(thingsOf(free, around.points).things, 1u);
}

TEST(StandingThings, HangTogetherByTheirPatches)
{
  Sheet free;
  free.add(3, 0, 2, 1);
  free.add(3, 0.5, 2, 1); // 0.4 m on
  EXPECT_EQ(thingsOf(free).things, 2u);
  free.patches = {{0, 1, 2, 3}};
  EXPECT_EQ(thingsOf(free).things, 1u);
}

TEST(StandingThings, AreOfContradictedPatchesAlone)
{
  Sheet free;
  free.add(3, 0, 3, 3);
  free.patches.clear();
  EXPECT_EQ(thingsOf(free).things, 0u);
  EXPECT_EQ(thingsOf(Sheet{}).things, 0u);
}

TEST(StandingThings, ArePeopleBeforeAWallOnly)
{
  const auto one = seenBefore(personAt(-0.2), {kPatch, kLargest});
  EXPECT_GT(one.contradicted_patches, 4u);
  EXPECT_EQ(one.things, 1u);
  EXPECT_EQ(one.patches_of_things, one.contradicted_patches);
  Points two = personAt(-1.5);
  const Points other = personAt(0.8);
  two.insert(two.end(), other.begin(), other.end());
  EXPECT_EQ(seenBefore(two, {kPatch, kLargest}).things, 2u);
  const auto screen = seenBefore(personAt(-1.6, 3.2, 2), {kPatch, kLargest});
  EXPECT_GT(screen.contradicted_patches, 20u);
  EXPECT_EQ(screen.things, 0u) << "larger than people";
  EXPECT_EQ(screen.patches_of_things, 0u);
}

TEST(StandingThings, AreNotLookedForUnlessAsked)
{
  const auto asked = seenBefore(personAt(-0.2), {kPatch, kLargest});
  const auto not_asked = seenBefore(personAt(-0.2), kPatch);
  EXPECT_EQ(not_asked.things, 0u);
  EXPECT_EQ(not_asked.patches_of_things, 0u);
  EXPECT_EQ(not_asked.contradicted_patches, asked.contradicted_patches);
  EXPECT_EQ(not_asked.patches, asked.patches);
}

TEST(StandingThings, DoNotDependOnTheOrderOfThePoints)
{
  Points two = personAt(-1.5);
  const Points other = personAt(0.8);
  two.insert(two.end(), other.begin(), other.end());
  const auto there = seenBefore(two, {kPatch, kLargest});
  std::reverse(two.begin(), two.end());
  const auto back = seenBefore(two, {kPatch, kLargest});
  EXPECT_EQ(back.things, there.things);
  EXPECT_EQ(back.patches_of_things, there.patches_of_things);
}

TEST(StandingThings, AddUp)
{
  SightEvidence one = seenBefore(personAt(-0.2), {kPatch, kLargest});
  const auto patches = one.patches_of_things;
  one += seenBefore(personAt(0.5), {kPatch, kLargest});
  EXPECT_EQ(one.things, 2u);
  EXPECT_GT(one.patches_of_things, patches);
}

TEST(StandingThings, RefuseASizeThatIsNone)
{
  for (const double wrong :
       {-1.0, static_cast<double>(kNan), static_cast<double>(kInfinity)})
    EXPECT_NE(badArgumentOf([&] {
                seenBefore({}, {kPatch, wrong});
              }).find("largest_thing = "),
              std::string::npos)
        << wrong;
}
