// SPDX-License-Identifier: BSD-3-Clause
// The live view on a private X server in the place of the user's display.
#include "support/x_server.h"

#include <pcl6d/common/error.h>
#include <pcl6d/visualization/live_view.h>
#include <pcl6d/visualization/private_display.h>
#include <pcl6d/visualization/top_view.h>

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace {
using namespace pcl6d;
using test::soon;
using test::XServer;
using Colour = XServer::Colour;

/** Points of the ground about the origin, 4 x 4 m. */
Points
square()
{
  Points points;
  for (int x = -20; x <= 20; ++x)
    for (int y = -20; y <= 20; ++y)
      points.emplace_back(
          0.1F * static_cast<float>(x), 0.1F * static_cast<float>(y), 0);
  points.emplace_back(std::nanf(""), 0, 0);
  return points;
}

Eigen::Isometry3d
at(double x, double y = 0)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 1e6 + x, 5e6 + y, 300; // as far off as a national grid
  return pose;
}

bool
isWhite(const Colour& c)
{
  return c[0] > 240 && c[1] > 240 && c[2] > 240;
}
bool
isOrange(const Colour& c)
{
  return c[0] > 240 && c[1] > 120 && c[1] < 180 && c[2] < 60;
}
bool
isLike(const Colour& c, const Colour& other)
{
  for (std::size_t i = 0; i < c.size(); ++i)
    if (std::abs(c[i] - other[i]) > 4)
      return false;
  return true;
}

class LiveViewTest : public testing::Test {
protected:
  void
  SetUp() override
  {
    ::setenv("DISPLAY", server_.name().c_str(), 1);
  }
  void
  TearDown() override
  {
    ::unsetenv("DISPLAY");
  }
  /** \return the pixels of the first scan's points */
  std::size_t
  red() const
  {
    return server_.count([](const Colour& c) { return isLike(c, {225, 56, 56}); });
  }
  /** \return those of the second one's */
  std::size_t
  blue() const
  {
    return server_.count([](const Colour& c) { return isLike(c, {56, 106, 225}); });
  }

  XServer server_;
};
} // namespace

TEST_F(LiveViewTest, ShowsScansWhenTheyArePlaced)
{
  LiveViewOptions options;
  options.title = "the title";
  LiveView view(options);
  ASSERT_EQ(server_.windows().size(), 1u);
  EXPECT_EQ(server_.titleOf(server_.windows()[0]), "the title");
  for (int i = 0; i < 3; ++i)
    view.addScan(square(), at(5 * i, i));
  EXPECT_TRUE(soon([&] { return server_.count(isOrange) > 100; })) << "poses before";
  EXPECT_EQ(red() + blue(), 0u) << "not registered yet";
  EXPECT_EQ(server_.count(isWhite), 0u);
  view.place(0, at(0));
  EXPECT_TRUE(soon([&] { return red() > 500; }));
  EXPECT_EQ(blue(), 0u);
  view.place(1, at(5));
  EXPECT_TRUE(soon([&] { return blue() > 500; }));
  EXPECT_TRUE(soon([&] { return server_.count(isWhite) > 50; })) << "the trajectory";
  const std::size_t white = server_.count(isWhite);
  view.setText("matching 2/3");
  EXPECT_TRUE(soon([&] { return server_.count(isWhite) > white + 60; })) << "the text";
  EXPECT_TRUE(view.isOpen());
}

TEST_F(LiveViewTest, MovesAScanThatIsPlacedAgain)
{
  LiveView view;
  view.addScan(square(), at(0));
  view.addScan(square(), at(10));
  view.place(0, at(0));
  view.place(1, at(0)); // hides the first one
  ASSERT_TRUE(soon([&] { return blue() > 500; }));
  EXPECT_EQ(red(), 0u);
  view.place(1, at(10));
  EXPECT_TRUE(soon([&] { return red() > 300 && blue() > 300; }));
  EXPECT_THROW(view.place(2, at(0)), BadArgument);
}

TEST_F(LiveViewTest, KnowsThatTheUserClosedIt)
{
  LiveView view;
  EXPECT_TRUE(view.isOpen());
  server_.close(server_.windows().at(0));
  EXPECT_TRUE(soon([&] { return !view.isOpen(); }));
  EXPECT_TRUE(server_.windows().empty());
  view.addScan(square(), at(0)); // nothing happens
  view.place(0, at(0));
  view.setText("unseen");
  view.waitUntilClosed([] { return false; });
}

TEST_F(LiveViewTest, OutlivesALostDisplay)
{
  LiveView view;
  view.addScan(square(), at(0));
  server_.cutOff(server_.windows().at(0));
  EXPECT_TRUE(soon([&] { return !view.isOpen(); }));
  for (int i = 0; i < 100; ++i)
    view.addScan(square(), at(i));
}

TEST_F(LiveViewTest, EndsWithItsOwner)
{
  {
    LiveView view;
    EXPECT_EQ(server_.windows().size(), 1u);
  }
  EXPECT_TRUE(soon([&] { return server_.windows().empty(); }));
}

TEST_F(LiveViewTest, NeverHoldsUpTheWork)
{
  LiveView view;
  const Points cloud(1000000, Eigen::Vector3f(1, 2, 3));
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 200; ++i) {
    view.addScan(cloud, at(i));
    view.place(static_cast<std::size_t>(i), at(i));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST_F(LiveViewTest, LeavesThePrivateDisplayAlone)
{
  LiveView view;
  view.addScan(square(), at(0));
  view.place(0, at(0));
  ASSERT_TRUE(soon([&] { return red() > 500; }));
  TopViewScene scene;
  scene.points = square();
  EXPECT_GT(TopView().draw(scene).image.width, 0);
  EXPECT_NE(PrivateDisplay::instance().name(), server_.name());
  EXPECT_EQ(server_.windows().size(), 1u)
      << "pictures are not drawn on the user's display";
  EXPECT_TRUE(view.isOpen());
}

TEST(LiveView, WithoutADisplaySaysSo)
{
  ::unsetenv("DISPLAY");
  try {
    LiveView view;
    FAIL() << "opened";
  } catch (const IoFailed& e) {
    EXPECT_NE(std::string(e.what()).find("DISPLAY is not set"), std::string::npos);
  }
  ::setenv("DISPLAY", ":9999", 1);
  try {
    LiveView view;
    FAIL() << "opened";
  } catch (const IoFailed& e) {
    EXPECT_NE(std::string(e.what()).find("the display :9999"), std::string::npos);
  }
  ::unsetenv("DISPLAY");
}

TEST(LiveView, ChecksItsOptions)
{
  LiveViewOptions options;
  options.width = 10;
  EXPECT_THROW(LiveView{options}, BadArgument);
  options = LiveViewOptions();
  options.points_per_scan = 0;
  EXPECT_THROW(LiveView{options}, BadArgument);
}
