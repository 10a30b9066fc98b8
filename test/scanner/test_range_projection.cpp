// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/expect_refused.h"
#include "support/constants.h"

#include <pcl6d/scanner/range_projection.h>

#include <cmath>
#include <memory>

namespace {
using Eigen::Vector3d;
using pcl6d::CylindricalProjection;
using pcl6d::ImageView;
using pcl6d::PerspectiveProjection;
using pcl6d::Pixel;
using pcl6d::RangeProjection;
using pcl6d::SphericalProjection;
using pcl6d::test::expectRefused;
using pcl6d::test::kDegree;

ImageView
frontView()
{
  ImageView view;
  view.rows = 40;
  view.cols = 60;
  view.left = 50 * kDegree;
  view.right = -30 * kDegree;
  view.top = 20 * kDegree;
  view.bottom = -45 * kDegree;
  return view;
}

Eigen::Isometry3d
somePose()
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(0.8, 0.3, -0.4, 0.2).normalized().matrix();
  pose.translation() << 0.3, -0.2, 0.1;
  return pose;
}

template <typename Projection>
class Projections : public testing::Test {};
using AllProjections =
    testing::Types<SphericalProjection, CylindricalProjection, PerspectiveProjection>;
TYPED_TEST_SUITE(Projections, AllProjections);
} // namespace

TYPED_TEST(Projections, SeeAPointOnThePixelOfItsRay)
{
  ImageView view = frontView();
  for (const auto& pose : {Eigen::Isometry3d::Identity(), somePose()}) {
    view.T_scan_view = pose;
    const TypeParam projection(view);
    for (int row = 0; row < view.rows; ++row)
      for (int col = 0; col < view.cols; ++col) {
        const pcl6d::Ray ray = projection.ray({row, col});
        EXPECT_NEAR(ray.direction.norm(), 1, 1e-15);
        const auto seen = projection.project(ray.origin + 7.5 * ray.direction);
        ASSERT_TRUE(seen);
        EXPECT_EQ(seen->pixel, (Pixel{row, col}));
        EXPECT_NEAR(seen->range, 7.5, 1e-14);
      }
  }
}

TYPED_TEST(Projections, EndAtTheirBorders)
{
  const ImageView view = frontView();
  const TypeParam projection(view);
  const auto at = [&](double azimuth, double elevation) {
    // In the middle row and column, where all three measure the same angles.
    return projection.project(Vector3d(
        std::cos(azimuth), std::sin(azimuth), std::cos(azimuth) * std::tan(elevation)));
  };
  constexpr double kInside = 1e-6;
  EXPECT_EQ(at(view.left - kInside, 0)->pixel.col, 0);
  EXPECT_FALSE(at(view.left + kInside, 0));
  EXPECT_EQ(at(view.right + kInside, 0)->pixel.col, view.cols - 1);
  EXPECT_FALSE(at(view.right - kInside, 0));
  EXPECT_EQ(at(0, view.top - kInside)->pixel.row, 0);
  EXPECT_FALSE(at(0, view.top + kInside));
  EXPECT_EQ(at(0, view.bottom + kInside)->pixel.row, view.rows - 1);
  EXPECT_FALSE(at(0, view.bottom - kInside));
  EXPECT_FALSE(projection.project(Vector3d::Zero()));
  EXPECT_FALSE(projection.project(Vector3d(NAN, 0, 0)));
  EXPECT_FALSE(projection.project(Vector3d(INFINITY, 0, 0)));
}

TYPED_TEST(Projections, RefuseASenselessView)
{
  const auto refused = [](auto spoil, const std::string& words) {
    ImageView view = frontView();
    spoil(view);
    expectRefused([&] { TypeParam projection(view); }, words);
  };
  refused([](auto& v) { v.rows = 0; }, "rows = 0");
  refused([](auto& v) { v.cols = -3; }, "cols = -3");
  refused([](auto& v) { v.rows = v.cols = 100000; }, "1e+10 pixels, 160 GB");
  refused([](auto& v) { v.left = v.right; }, "right = ");
  refused([](auto& v) { v.left = NAN; }, "left = nan");
  refused([](auto& v) { v.top = 2; }, "top = 2");
  refused([](auto& v) { v.bottom = 1; }, "bottom = 1");
  refused([](auto& v) { v.T_scan_view.linear() *= 2; }, "T_scan_view");
}

TEST(SphericalProjection, DividesAFullTurnWithoutASeam)
{
  ImageView view;
  view.rows = 180;
  view.cols = 360;
  view.top = M_PI / 2;
  view.bottom = -M_PI / 2;
  const SphericalProjection projection(view);
  for (int i = 0; i < 3600; ++i) {
    const double azimuth = M_PI - (i + 0.5) * 2 * M_PI / 3600;
    const auto seen =
        projection.project(Vector3d(std::cos(azimuth), std::sin(azimuth), 0.001));
    ASSERT_TRUE(seen) << i;
    EXPECT_EQ(seen->pixel, (Pixel{89, i / 10})) << i;
  }
  EXPECT_EQ(projection.project(Vector3d(-1, 0.0, 0))->pixel.col, 0);
  EXPECT_TRUE(projection.project(Vector3d(-1, -0.0, 0)));
  EXPECT_TRUE(projection.project(Vector3d(-1, -1e-300, 0)));
  EXPECT_EQ(projection.project(Vector3d(0, 0, 3))->pixel.row, 0);
  EXPECT_EQ(projection.project(Vector3d(0, 0, -3))->pixel.row, 179);
}

TEST(CylindricalProjection, KeepsUprightLinesAndEqualHeights)
{
  const CylindricalProjection projection(frontView());
  const double radius = 4;
  const double top = radius * std::tan(20 * kDegree);
  const double bottom = -radius * std::tan(45 * kDegree);
  for (int i = 0; i < 40; ++i) {
    const double z = top + (bottom - top) * (i + 0.5) / 40;
    const auto seen =
        projection.project(Vector3d(radius * std::cos(0.2), radius * std::sin(0.2), z));
    EXPECT_EQ(seen->pixel.row, i);
    EXPECT_EQ(seen->pixel.col, 28); // (50 - 11.46) / 80 * 60
  }
}

TEST(PerspectiveProjection, KeepsStraightLinesStraight)
{
  const PerspectiveProjection projection(frontView());
  // Of a plane x = 1, equal steps of y and z are equal steps of columns and rows.
  const double left = std::tan(50 * kDegree), right = std::tan(-30 * kDegree);
  for (int i = 0; i < 60; ++i)
    EXPECT_EQ(
        projection.project(Vector3d(1, left + (right - left) * (i + 0.5) / 60, 0.1))
            ->pixel.col,
        i);
  EXPECT_FALSE(projection.project(Vector3d(-1, 0.1, 0.1))) << "behind";
  ImageView wide = frontView();
  wide.left = 1.6;
  expectRefused([&] { PerspectiveProjection wide_projection(wide); }, "left = 1.6");
}

TEST(ViewsAround, SeeEveryDirectionOfTheHorizon)
{
  ImageView view;
  view.rows = 10;
  view.cols = 40;
  view.left = 50 * kDegree; // 100 deg wide: neighbours overlap by 10 deg
  view.right = -view.left;
  view.top = 30 * kDegree;
  view.bottom = -view.top;
  const auto views = pcl6d::viewsAround(view, 4);
  ASSERT_EQ(views.size(), 4u);
  for (int degree = 0; degree < 360; ++degree) {
    const double azimuth = (degree + 0.5) * kDegree;
    int seen = 0;
    for (const auto& one : views)
      seen += PerspectiveProjection(one)
                  .project(Vector3d(std::cos(azimuth), std::sin(azimuth), 0.1))
                  .has_value();
    const double from_middle = (degree + 45) % 90 - 44.5; // of the nearest view
    EXPECT_EQ(seen, std::abs(from_middle) > 40 ? 2 : 1) << degree;
  }
  expectRefused([&] { pcl6d::viewsAround(view, 0); }, "count = 0");
}
