// SPDX-License-Identifier: BSD-3-Clause
#include "picture_checks.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/visualization/before_after_view.h>
#include <pcl6d/visualization/convergence_strip.h>
#include <pcl6d/visualization/map_overlays.h>
#include <pcl6d/visualization/top_view.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::Background;
using pcl6d::BadArgument;
using pcl6d::Colour;
using pcl6d::LinkState;
using pcl6d::Overlay;
using pcl6d::TopView;
using pcl6d::TopViewOptions;
using pcl6d::TopViewScene;
using pcl6d::Trajectory;
using pcl6d::ViewLink;
using pcl6d::test::colourAt;
using pcl6d::test::difference;
using pcl6d::test::drawnPixels;
using pcl6d::test::kDarkBackground;
using pcl6d::test::nearestDifference;

constexpr int kThinLine = 100; // of a channel: it covers pixels in part

/** Five poses in a row, 2 m apart. */
Trajectory
row()
{
  Trajectory poses;
  for (int i = 0; i < 5; ++i)
    poses.poses.push_back(pcl6d::planarPose(2 * i, 0, 0));
  return poses;
}

/** A picture of nothing but an overlay, seen from above. */
pcl6d::TopViewPicture
drawn(const Overlay& overlay)
{
  TopViewScene scene;
  for (const double y : {-2.0, 2.0}) // so that there is room
    for (double x = -1; x < 9; x += 0.5)
      scene.points.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0F);
  scene.overlay = overlay;
  TopViewOptions options;
  options.width = 1600; // lines are wider than a pixel
  options.height = 1000;
  options.colour = pcl6d::PointColour::kPlain;
  return TopView(options).draw(scene);
}
} // namespace

TEST(GraphOverlay, ColoursLinksByVerdictAndResidual)
{
  const std::vector<ViewLink> links = {{0, 1, LinkState::kUsed, 0.01},
                                       {1, 2, LinkState::kUsed, 0.30},
                                       {2, 3, LinkState::kOdometry, NAN},
                                       {3, 4, LinkState::kRefused, 0.5}};
  const auto picture = drawn(pcl6d::graphOverlay(
      row(), links, {false, false, true, false, false}, Background::kDark));
  const auto at = [&](double x) {
    return colourAt(picture.image, picture.layout.toPixel({x, 0}));
  };
  EXPECT_GT(at(1)[1], at(1)[0] + 60) << "small residual: green";
  EXPECT_GT(at(3)[0], at(3)[1] + 60) << "large residual: red";
  EXPECT_GT(at(5)[2], at(5)[0] + 60) << "odometry: blue";
  EXPECT_LT(
      nearestDifference(picture.image, picture.layout.toPixel({7, 0}), {125, 118, 122}),
      50)
      << "refused: grey";
  EXPECT_GT(at(4)[0], at(4)[1] + 100) << "doubtful scan: red dot";
  EXPECT_GT(at(0)[1], 180) << "scan: bright dot";
  EXPECT_GT(drawnPixels(
                picture.image, {400, 0, 1600, picture.layout.map.top}, kDarkBackground),
            300)
      << "legend";
}

TEST(GraphOverlay, RefusesLinksToNoPose)
{
  EXPECT_THROW(pcl6d::graphOverlay(row(), {{0, 5}}, {}, Background::kDark),
               BadArgument);
  EXPECT_THROW(pcl6d::graphOverlay(row(), {}, {true}, Background::kDark), BadArgument);
}

TEST(CovarianceOverlay, DrawsThreeSigmaEnlargedByARoundFactor)
{
  std::vector<std::optional<Eigen::Matrix3d>> covariances(5);
  const Eigen::Vector3d sigma(0.01, 0.004, 0.002); // [m]
  covariances[2] = sigma.cwiseAbs2().asDiagonal().toDenseMatrix();
  const Overlay overlay =
      pcl6d::covarianceOverlay(row(), covariances, Background::kDark);
  ASSERT_EQ(overlay.keys.size(), 2u);
  double factor = 0;
  ASSERT_EQ(std::sscanf(overlay.keys[0].text.c_str(),
                        "3 sigma of the positions, %lf times as large",
                        &factor),
            1)
      << overlay.keys[0].text;
  EXPECT_EQ(factor, 5) << "8 m / 40 / 3 cm is 6.7";
  const auto picture = drawn(overlay);
  const Colour colour = overlay.keys[0].colour;
  const Eigen::Vector2d at(4 + 3 * factor * sigma.x(), 0);
  EXPECT_LE(nearestDifference(picture.image, picture.layout.toPixel(at), colour),
            kThinLine);
  const Eigen::Vector2d aside(4, 3 * factor * sigma.y());
  EXPECT_LE(nearestDifference(picture.image, picture.layout.toPixel(aside), colour),
            40);
  EXPECT_THROW(pcl6d::covarianceOverlay(row(), {}, Background::kDark), BadArgument);
}

TEST(ObjectOverlay, DrawsTheBoxAndTheClass)
{
  pcl6d::ObjectPose chair;
  chair.object_class = "chair";
  chair.T_world_object = pcl6d::planarPose(4, 0, M_PI / 2);
  chair.box = Eigen::AlignedBox3d(Eigen::Vector3d(-1, -2, 0), Eigen::Vector3d(1, 2, 1));
  const Overlay overlay = pcl6d::objectOverlay({chair}, Background::kDark);
  EXPECT_EQ(overlay.lines.size(), 12u);
  const auto picture = drawn(overlay);
  const Colour colour = overlay.keys.at(0).colour;
  const auto isEdge = [&](double x, double y) {
    return nearestDifference(picture.image, picture.layout.toPixel({x, y}), colour) <
           40;
  };
  EXPECT_TRUE(isEdge(2, 0.5)) << "turned by a right angle: 4 m along x";
  EXPECT_TRUE(isEdge(6, -0.5));
  EXPECT_TRUE(isEdge(3, 1));
  EXPECT_FALSE(isEdge(3, 0.5));
  const Eigen::Vector2d middle = picture.layout.toPixel({4, 0});
  EXPECT_GT(
      drawnPixels(picture.image,
                  {middle.x() - 40, middle.y() - 12, middle.x() + 40, middle.y() + 12},
                  kDarkBackground),
      30)
      << "the name";
}

TEST(BeforeAfterView, ShowsTheSameAreaTwice)
{
  TopViewScene before;
  for (int i = 0; i <= 400; ++i) {
    before.points.emplace_back(0.01F * static_cast<float>(i), 0.0F, 0.0F);
    before.scans.push_back(0);
  }
  TopViewScene after = before;
  for (auto& p : after.points)
    p.y() = 2;
  TopViewOptions options = pcl6d::BeforeAfterView::defaultOptions();
  options.width = 1000;
  options.height = 400;
  const auto picture = pcl6d::BeforeAfterView(options).draw(before, after);
  EXPECT_EQ(picture.image.width, 1000);
  EXPECT_EQ(picture.image.height, 400);
  EXPECT_EQ(picture.before.metres_per_pixel, picture.after.metres_per_pixel);
  EXPECT_EQ(picture.before.toPixel({1, 1}) + Eigen::Vector2d(500, 0),
            picture.after.toPixel({1, 1}));
  const auto isDrawn = [&](const Eigen::Vector2d& pixel) {
    return difference(colourAt(picture.image, pixel), kDarkBackground) > 60;
  };
  EXPECT_TRUE(isDrawn(picture.before.toPixel({2, 0})));
  EXPECT_FALSE(isDrawn(picture.before.toPixel({2, 2})));
  EXPECT_TRUE(isDrawn(picture.after.toPixel({2, 2})));
  EXPECT_FALSE(isDrawn(picture.after.toPixel({2, 0})));
  const auto title = [&](double left) {
    return drawnPixels(
        picture.image, {left, 0, left + 150, picture.before.map.top}, kDarkBackground);
  };
  EXPECT_GT(title(0), 30);
  EXPECT_GT(title(500), 30);
  EXPECT_THROW(pcl6d::BeforeAfterView().draw({}, {}), BadArgument);
}

TEST(ConvergenceStrip, ShowsTheScanOverTheOthersAtEachStep)
{
  pcl6d::ConvergenceStripScene scene;
  scene.title = "a scan";
  pcl6d::ConvergenceStep step;
  for (int i = 0; i <= 400; ++i) {
    const float along = 0.01F * static_cast<float>(i);
    scene.scan.emplace_back(along, 0.0F, 0.0F);
    step.fixed.emplace_back(along, 0.0F, 0.0F);
  }
  step.title = "as given";
  step.caption = "1 m off";
  step.T_world_scan = pcl6d::planarPose(0, 1, 0);
  scene.steps.push_back(step);
  step.title = "matched";
  step.T_world_scan = pcl6d::planarPose(0, 0, 0);
  scene.steps.push_back(step);
  pcl6d::ConvergenceStripOptions options;
  options.width = 900;
  const auto picture = pcl6d::ConvergenceStrip(options).draw(scene);
  const auto at = [&](std::size_t panel, double x, double y) {
    return colourAt(picture.image, picture.layout.toPixel(panel, {x, y}));
  };
  const auto isOrange = [](const Colour& c) { return c[0] > 150 && c[2] < 110; };
  EXPECT_TRUE(isOrange(at(0, 2, 1)));
  EXPECT_GT(difference(at(0, 2, 0), kDarkBackground), 50) << "the others";
  EXPECT_FALSE(isOrange(at(0, 2, 0)));
  EXPECT_TRUE(isOrange(at(1, 2, 0))) << "the scan lies over the others";
  EXPECT_EQ(at(1, 2, 0.9), kDarkBackground);
  for (const auto& panel : picture.layout.panels)
    EXPECT_GT(drawnPixels(picture.image,
                          {panel.left, panel.top - 40, panel.left + 100, panel.top - 4},
                          kDarkBackground),
              50)
        << "title and caption";
}

TEST(ConvergenceStrip, RefusesNothingToShow)
{
  const pcl6d::ConvergenceStrip strip;
  EXPECT_THROW(strip.draw({}), BadArgument);
  pcl6d::ConvergenceStripScene scene;
  scene.steps.emplace_back();
  EXPECT_THROW(strip.draw(scene), BadArgument);
  pcl6d::ConvergenceStripOptions options;
  options.width = 100;
  EXPECT_THROW(pcl6d::ConvergenceStrip{options}, BadArgument);
}
