// SPDX-License-Identifier: BSD-3-Clause
#include "ray_spheres.h"
#include "rays.h"
#include "support/points.h"

#include <pcl6d/visibility/ray_image.h>

#include <functional>
#include <string>
#include <utility>

using pcl6d::Points;
using pcl6d::RayImage;
using pcl6d::RayImageOptions;
using pcl6d::Sight;
using pcl6d::test::badArgumentOf;
using pcl6d::test::directionOf;
using pcl6d::test::filledOptions;
using pcl6d::test::kAsked;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::kOrigin;
using pcl6d::test::kRadius;
using pcl6d::test::kRays;
using pcl6d::test::placeAt;
using pcl6d::test::scanAround;
using pcl6d::test::sphere;

namespace {
using Vector = Eigen::Vector3d;

} // namespace

TEST(RayImage, LeavesOutWhatIsNoPoint)
{
  const Points clean = sphere();
  Points dirty{{kNan, 0, 0}, {0, kInfinity, 0}, {0, 0, -kInfinity}, {1e30F, 0, 0}};
  dirty.push_back(kOrigin.cast<float>());
  dirty.insert(dirty.end(), clean.begin(), clean.end());
  const RayImage expected(clean, filledOptions()), image(dirty, filledOptions());
  for (std::size_t i = 0; i < kAsked; ++i) {
    const Eigen::Vector3f place = placeAt(4.0, directionOf(i, kAsked));
    EXPECT_EQ(image.look(place, 0).sight, expected.look(place, 0).sight);
    EXPECT_EQ(image.look(place, 0).beyond, expected.look(place, 0).beyond);
  }
}

TEST(RayImage, LeavesOutPointsWhoseRangeVanishes)
{
  // The square of 1e-30 is 0 in float.
  Points points = sphere(kRadius, Vector::Zero());
  const Points vanishing =
      scanAround(1000, Vector::Zero(), [](const Vector&) { return 1e-30; });
  points.insert(points.end(), vanishing.begin(), vanishing.end());
  const RayImage image(points, filledOptions(0.01, Vector::Zero()));
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_EQ(image.look((4 * directionOf(i, 100)).cast<float>(), 0).sight,
              Sight::kFree);
}

TEST(RayImage, SaysNothingOfPlacesThatAreNone)
{
  const RayImage image(sphere(), filledOptions());
  for (const Eigen::Vector3f& place : {Eigen::Vector3f(kNan, 0, 0),
                                       Eigen::Vector3f(0, kInfinity, 0),
                                       Eigen::Vector3f(0, 0, -kInfinity)}) {
    EXPECT_EQ(image.look(place, 0).sight, Sight::kUnseen);
    EXPECT_EQ(image.look(place, 0).beyond, 0);
  }
}

TEST(RayImage, SaysNothingWithoutEnoughPoints)
{
  const Eigen::Vector3f on_axis(1, 0, 0);
  for (const Points& points : {Points{},
                               Points{on_axis},
                               Points(100, Eigen::Vector3f::Zero()),
                               Points(100, on_axis),
                               Points{{kNan, kNan, kNan}}}) {
    const RayImage image(points);
    EXPECT_EQ(image.resolution(), 0);
    for (const float range : {0.5F, 1.0F, 2.0F})
      EXPECT_EQ(image.look(range * on_axis, 0).sight, Sight::kUnseen);
  }
  EXPECT_EQ(RayImage().look(on_axis, 0).sight, Sight::kUnseen);
}

TEST(RayImageOptions, AreRefusedWithTheRuleTheyBreak)
{
  const auto messageOf = [](const std::function<void(RayImageOptions&)>& spoil) {
    RayImageOptions options;
    spoil(options);
    return badArgumentOf([&] { RayImage({{1, 0, 0}}, options); });
  };
  EXPECT_EQ(messageOf([](auto&) {}), "");
  EXPECT_EQ(messageOf([](auto& o) { o.noise = -1; }),
            "noise = -1, but must be finite and >= 0");
  EXPECT_EQ(messageOf([](auto& o) { o.noise = kNan; }),
            "noise = nan, but must be finite and >= 0");
  EXPECT_EQ(messageOf([](auto& o) { o.noise = kInfinity; }),
            "noise = inf, but must be finite and >= 0");
  EXPECT_NE(messageOf([](auto& o) { o.origin.x() = kNan; }).find("origin = nan"),
            std::string::npos);
  EXPECT_EQ(messageOf([](auto& o) { o.finest = 0; }),
            "finest = 0, but must be in [0.0005, coarsest]");
  EXPECT_EQ(messageOf([](auto& o) { o.finest = 1e-9; }),
            "finest = 1e-09, but must be in [0.0005, coarsest]")
      << "no memory holds such cells";
  EXPECT_EQ(messageOf([](auto& o) { o.finest = 0.1; }),
            "finest = 0.1, but must be in [0.0005, coarsest]");
  EXPECT_EQ(messageOf([](auto& o) { o.finest = kNan; }),
            "finest = nan, but must be in [0.0005, coarsest]");
  EXPECT_EQ(messageOf([](auto& o) { o.coarsest = 0.6; }),
            "coarsest = 0.6, but must be at most 0.5");
  EXPECT_NE(messageOf([](auto& o) { o.coarsest = kNan; }), "");
}

TEST(Sight, HasAWordForEachAnswer)
{
  const std::pair<Sight, std::string> words[] = {{Sight::kUnseen, "unseen"},
                                                 {Sight::kBehind, "behind"},
                                                 {Sight::kEdge, "edge"},
                                                 {Sight::kConfirmed, "confirmed"},
                                                 {Sight::kFree, "free"}};
  for (const auto& [sight, word] : words)
    EXPECT_EQ(toString(sight), word);
}
