// SPDX-License-Identifier: BSD-3-Clause
#include "support/drift.h"
#include "support/points.h"

#include <pcl6d/slam6d/slam6d.h>

using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;

TEST(Slam6DOptions, NameTheValueThatBreaksItsRule)
{
  const auto message = [](auto change) {
    Slam6DOptions options;
    change(options);
    return badArgumentOf([&] { Slam6D slam(options); });
  };
  EXPECT_EQ(message([](auto& o) { o.min_range = -1; }).find("min_range ="), 0u);
  EXPECT_EQ(message([](auto& o) { o.max_range = -1; }).find("max_range ="), 0u);
  EXPECT_EQ(message([](auto& o) { o.max_range = kNan; }).find("max_range ="), 0u);
  EXPECT_EQ(message([](auto& o) { o.voxel = 0; }).find("voxel = 0"), 0u);
  EXPECT_EQ(message([](auto& o) { o.voxel = kNan; }).find("voxel ="), 0u);
  EXPECT_EQ(message([](auto& o) { o.max_distance = 0; }).find("max_distance = 0"), 0u);
  EXPECT_EQ(
      message([](auto& o) { o.max_distance_start = -1; }).find("max_distance_start ="),
      0u);
  EXPECT_EQ(message([](auto& o) { o.metascan = -1; }).find("metascan = -1"), 0u);
  EXPECT_EQ(message([](auto& o) { o.max_iterations = 0; }).find("max_iterations = 0"),
            0u);
  EXPECT_EQ(message([](auto& o) {
              o.translation_epsilon = -1;
            }).find("translation_epsilon ="),
            0u);
  EXPECT_EQ(
      message([](auto& o) { o.rotation_epsilon = kNan; }).find("rotation_epsilon ="),
      0u);
  for (const double overlap : {-0.1, 1.1, double{kNan}})
    EXPECT_EQ(message([&](auto& o) { o.min_overlap = overlap; }).find("min_overlap ="),
              0u);
  EXPECT_NO_THROW(Slam6DOptions().validate());
}

TEST(Slam6DOptions, RefuseAnInfiniteLengthButNotAnInfiniteRange)
{
  const double infinity = pcl6d::test::kInfinity;
  const auto message = [](auto change) {
    Slam6DOptions options;
    change(options);
    return badArgumentOf([&] { options.validate(); });
  };
  EXPECT_EQ(message([&](auto& o) { o.voxel = infinity; }),
            "voxel = inf, but must be finite and > 0");
  EXPECT_EQ(message([&](auto& o) { o.max_distance = infinity; }),
            "max_distance = inf, but must be finite and > 0");
  EXPECT_EQ(message([&](auto& o) { o.max_distance_start = infinity; }),
            "max_distance_start = inf, but must be finite and >= 0");
  EXPECT_EQ(message([&](auto& o) { o.max_range = infinity; }), "");
}
