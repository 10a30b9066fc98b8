// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/placed_objects.h"
#include "support/bits.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl6d {
using namespace test;

TEST(ObjectLocalizer, LeavesOutPointsThatAreNotFinite)
{
  const StoredModel chair = stored("chair");
  Room room;
  room.add(chair.mesh, inRoom(standing(2, 0.3, 0.6)));
  Points points = room.scan();
  const auto clean = locate(chair.model, points);
  points.emplace_back(NAN, 0.0F, 1.0F);
  points.emplace_back(0.0F, INFINITY, 1.0F);
  const auto found = locate(chair.model, points);
  ASSERT_EQ(found.size(), clean.size());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(test::sameBits(found[0].T_scene_object, clean[0].T_scene_object));
}

TEST(ObjectLocalizer, FindsNothingWhereThereIsNothingToFind)
{
  const ObjectModel chair = stored("chair").model;
  OrientedPoints floor;
  test::addPatch(floor, {{-2, -2, -kHeight}, {4, 0, 0}, {0, 4, 0}}, 0.05);
  EXPECT_TRUE(locate(chair, floor.points).empty());
  EXPECT_TRUE(ObjectLocalizer(chair).locate(LocalizationScene(floor.points)).empty());
  EXPECT_TRUE(
      ObjectLocalizer(chair).locate(LocalizationScene(floor.points), {}).empty());
  const Points one_place(20, {1, 0, 0});
  EXPECT_TRUE(locate(chair, one_place).empty());
  EXPECT_TRUE(ObjectLocalizer(chair).locate(LocalizationScene(one_place)).empty());
  EXPECT_THROW(LocalizationScene(Points(9, {1, 0, 0})), BadArgument);
  EXPECT_THROW(LocalizationScene(Points(50, {NAN, 0, 0})), BadArgument);
}

TEST(ObjectLocalizer, NamesTheOptionThatBreaksItsRule)
{
  const auto refusal = [](auto change) {
    LocalizerOptions options;
    change(options);
    try {
      options.validate();
    } catch (const BadArgument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const auto expectNamed = [&](const char* name, auto change) {
    EXPECT_EQ(refusal(change).rfind(name, 0), 0u) << refusal(change);
  };
  EXPECT_EQ(refusal([](auto&) {}), "");
  expectNamed("resolution", [](auto& o) { o.resolution = 0.01; });
  expectNamed("max_candidates", [](auto& o) { o.max_candidates = 0; });
  expectNamed("min_visible", [](auto& o) { o.min_visible = 1.1; });
  expectNamed("min_facing", [](auto& o) { o.min_facing = -0.1; });
  expectNamed("min_agreement", [](auto& o) { o.min_agreement = NAN; });
  expectNamed("max_violation", [](auto& o) { o.max_violation = 2; });
  expectNamed("max_continuation", [](auto& o) { o.max_continuation = -1; });
  expectNamed("min_support", [](auto& o) { o.min_support = 0; });
  expectNamed("max_shared_support", [](auto& o) { o.max_shared_support = -1; });
}

} // namespace pcl6d
