// SPDX-License-Identifier: BSD-3-Clause
#include "support/drift.h"
#include "support/points.h"

#include <pcl6d/common/option_spec.h>
#include <pcl6d/slam6d/slam6d.h>

#include <set>
#include <string>

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

TEST(Slam6DOptions, HaveOneRowEachWithNameAndHelp)
{
  Slam6DOptions options;
  pcl6d::Slam6DParameters used;
  pcl6d::OptionList list;
  describe(options, used, list);
  std::set<std::string> names;
  std::set<const void*> variables;
  for (const pcl6d::OptionSpec& option : list.rows()) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
    EXPECT_TRUE(variables.insert(option.place).second) << option.name;
    EXPECT_FALSE(option.help.empty()) << option.name;
    EXPECT_EQ(option.is_used == nullptr, option.condition.empty()) << option.name;
    EXPECT_EQ(option.parameter != nullptr, !option.derived.empty()) << option.name;
  }
  EXPECT_NO_THROW(list.check());
}

TEST(Slam6DOptions, TellWhereTheLengthsOfARunAreKept)
{
  pcl6d::Slam6DParameters used;
  const auto parameters = pcl6d::parametersOf(used);
  const std::set<pcl6d::Parameter*> all(parameters.begin(), parameters.end());
  const std::set<pcl6d::Parameter*> expected = {&used.min_range,
                                                &used.max_range,
                                                &used.voxel,
                                                &used.line_spacing,
                                                &used.planar_rows,
                                                &used.max_distance,
                                                &used.max_distance_start,
                                                &used.loop_distance,
                                                &used.loop_gap,
                                                &used.loop_pairs,
                                                &used.link_distance};
  EXPECT_EQ(all, expected);
  // All but the median range, which is no option: nobody has forgotten one.
  EXPECT_LE(sizeof used, expected.size() * sizeof(pcl6d::Parameter) + sizeof(double));
}

TEST(Slam6DOptions, CountOnlyWithTheMethodThatTheyAreOf)
{
  Slam6DOptions options;
  pcl6d::Slam6DParameters used;
  pcl6d::OptionList list;
  describe(options, used, list);
  const auto counts = [&](const void* variable) { return list.of(variable).is_used(); };
  EXPECT_FALSE(counts(&options.minimiser)); // the metric is gicp
  EXPECT_TRUE(counts(&options.plane_minimiser));
  options.metric = pcl6d::Metric::kPoint;
  EXPECT_TRUE(counts(&options.minimiser));
  EXPECT_FALSE(counts(&options.plane_minimiser));
  EXPECT_TRUE(counts(&options.line_spacing));
  options.voxel = 0.1;
  EXPECT_FALSE(counts(&options.line_spacing));
  EXPECT_TRUE(counts(&options.loop_gap));
  options.loop_closing = pcl6d::LoopClosing::kNone;
  EXPECT_FALSE(counts(&options.loop_gap));
  EXPECT_FALSE(counts(&options.link_distance)); // the links are by overlap
  options.links = pcl6d::LinkRule::kDistance;
  EXPECT_TRUE(counts(&options.link_distance));
  options.relaxation = std::nullopt;
  EXPECT_FALSE(counts(&options.link_distance));
  EXPECT_FALSE(counts(&options.link_weights));
}
