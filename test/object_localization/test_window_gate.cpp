// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/detection_room.h"

#include <pcl6d/object_localization/window_gate.h>

#include <gtest/gtest.h>

namespace pcl6d {
namespace {
constexpr double kGateSize = 2.2; // [m] of the window around the figure

/** The figure 3 m ahead of the scanner, and what a gate says of windows around it. */
struct Gate : testing::Test {
  Gate()
  {
    TriangleScene scene = test::room();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().x() = 3;
    addMesh(scene, test::figure(), pose, {});
    const BackgroundScan scan = test::scanFrom(scene, 0, 0, 7);
    const Eigen::Vector3d middle(3, 0, 0.1);
    const std::size_t view = views.viewOf(middle);
    image = std::make_unique<RangeImage>(views.image(view, scan.points));
    const auto place = views.place(view, middle);
    height = static_cast<int>(views.pixelsOf(kGateSize, place.depth));
    x = static_cast<int>(place.x);
    y = static_cast<int>(place.y);
  }
  WindowGate
  gateOf(const DepthSlice& slice) const
  {
    return {views.options(), *image, slice, kGateSize, 1.3};
  }
  ImageRect
  window(double factor) const
  {
    const int h = static_cast<int>(height * factor);
    return {x - h / 4, y - h / 2, h / 2, h};
  }
  DetectionViews views;
  std::unique_ptr<RangeImage> image;
  int height = 0, x = 0, y = 0; // of the window [px]
};
} // namespace

TEST_F(Gate, LetsWindowsOfTheObjectsSizePass)
{
  const WindowGate gate = gateOf({0.5, 12});
  for (const double factor : {0.8, 1.0, 1.25})
    EXPECT_NEAR(gate.rangeIn(window(factor)).value_or(0), 3, 0.25) << factor;
  // It would be 10 m away, behind the walls.
  EXPECT_FALSE(gate.rangeIn(window(0.3)));
}

TEST_F(Gate, LooksAtItsSliceAlone)
{
  EXPECT_TRUE(gateOf({2, 4}).rangeIn(window(1)));
  EXPECT_FALSE(gateOf({0.5, 2.2}).rangeIn(window(1)));
  EXPECT_FALSE(gateOf({4, 7}).rangeIn(window(1)));
}

TEST_F(Gate, NamesTheSizesThatCanPass)
{
  const auto grid = gateOf({4, 7}).grid(1.1);
  ASSERT_TRUE(grid);
  EXPECT_LE(grid->min_height, views.pixelsOf(kGateSize, 7) / 1.3);
  EXPECT_GE(grid->max_height, views.pixelsOf(kGateSize, 4) * 1.3);
  // Nothing of this size is that near and fits into the view.
  EXPECT_FALSE(WindowGate(views.options(), *image, {0.1, 0.5}, 5, 1.3).grid(1.1));
}

TEST_F(Gate, SeesNothingWhereNothingIs)
{
  const RangeImage empty = views.image(0, {});
  EXPECT_FALSE(
      WindowGate(views.options(), empty, {0.5, 12}, kGateSize, 1.3).rangeIn(window(1)));
}

} // namespace pcl6d
