// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/visualization/plane_view.h>

#include <gtest/gtest.h>

#include <limits>

namespace {
using Eigen::Vector3d;
using pcl6d::BadArgument;
using pcl6d::Colour;
using pcl6d::Image;
using pcl6d::Plane;
using pcl6d::PlaneView;
using pcl6d::PlaneViewOptions;
using pcl6d::PlaneViewScene;

/** A face of the planeRoom from -2 to 2 m, 0 to 2.5 m high, seen from inside. */
void
addFace(PlaneViewScene& scene,
        const Vector3d& corner,
        const Vector3d& u,
        const Vector3d& v,
        const std::string& label)
{
  Plane plane;
  plane.label = label;
  plane.normal = u.cross(v).normalized();
  plane.offset = plane.normal.dot(corner);
  plane.hull = {corner, corner + u, corner + u + v, corner + v};
  scene.planes.push_back(plane);
  scene.seen_from.push_back(plane.normal);
  for (int a = 0; a <= 100; ++a)
    for (int b = 0; b <= 100; ++b) {
      scene.points.push_back((corner + 0.01 * a * u + 0.01 * b * v).cast<float>());
      scene.plane_of.push_back(static_cast<std::uint32_t>(scene.planes.size()));
    }
}

/** Floor, ceiling, and the walls at x = -2 and x = 2. */
PlaneViewScene
planeRoom()
{
  PlaneViewScene scene;
  const Vector3d x(4, 0, 0), y(0, 4, 0), z(0, 0, 2.5);
  addFace(scene, {-2, -2, 0}, x, y, "floor");
  addFace(scene, {-2, -2, 2.5}, y, x, "ceiling");
  addFace(scene, {-2, -2, 0}, y, z, "wall");
  addFace(scene, {2, -2, 0}, z, y, "wall");
  return scene;
}

PlaneViewOptions
fromPositiveX()
{
  PlaneViewOptions options;
  options.width = 600;
  options.height = 500;
  options.azimuth = 0.3;
  return options;
}

Colour
colourAt(const Image& image, const Eigen::Vector2d& pixel)
{
  return image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
}

/** The largest difference of a channel. */
int
difference(const Colour& a, const Colour& b)
{
  int largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(int{a[i]} - int{b[i]}));
  return largest;
}
} // namespace

TEST(PlaneView, LeavesOutPointsThatAreTooFarForAnyMap)
{
  const PlaneView view(fromPositiveX());
  PlaneViewScene scene = planeRoom();
  Image plain, spoilt;
  view.draw(scene, plain);
  // Up to the largest float: their depths would leave none to tell the others apart.
  for (const float far : {1e8F, 1e30F, -3e38F})
    for (int i = 0; i < 100; ++i) {
      scene.points.push_back({far, 0, -far});
      scene.plane_of.push_back(0);
    }
  view.draw(scene, spoilt);
  EXPECT_EQ(spoilt.rgb, plain.rgb);
}

TEST(PlaneView, LooksIntoARoomAsIntoADollsHouse)
{
  Image image;
  const auto layout = PlaneView(fromPositiveX()).draw(planeRoom(), image);
  EXPECT_EQ(image.width, 600);
  EXPECT_EQ(image.height, 500);
  EXPECT_EQ(layout.hidden, (std::vector<bool>{false, true, false, true}));
  EXPECT_EQ(layout.points_drawn, 2u * 101 * 101);
  const Colour floor = colourAt(image, layout.toPixel({0.7, 1.1, 0}));
  const Colour wall = colourAt(image, layout.toPixel({-2, 1.1, 1.9}));
  const Colour background = image.at(2, 2);
  EXPECT_GT(difference(floor, background), 60);
  EXPECT_GT(difference(wall, background), 60);
  EXPECT_GT(difference(floor, wall), 60);
}

TEST(PlaneView, DrawsWhatIsOnNoPlaneGrey)
{
  PlaneViewScene scene = planeRoom();
  for (auto& id : scene.plane_of)
    id = 0;
  scene.planes.clear();
  scene.seen_from.clear();
  Image image;
  const auto layout = PlaneView(fromPositiveX()).draw(scene, image);
  const Colour colour = colourAt(image, layout.toPixel({0, 0, 2.5}));
  EXPECT_LT(std::abs(colour[0] - colour[2]), 20);
  EXPECT_GT(colour[0], 60);
}

TEST(PlaneView, LooksAtTheLargerWallByItself)
{
  PlaneViewScene scene = planeRoom();
  scene.planes[2].area = 10; // faces +x
  scene.planes[3].area = 1;
  Image image;
  const auto layout = PlaneView().draw(scene, image);
  EXPECT_GT(layout.to_camera.x(), 0.5);
  EXPECT_FALSE(layout.hidden[2]);
}

TEST(PlaneView, FindsAWayToLookAndLeavesOutWhatIsNotFinite)
{
  PlaneViewScene scene = planeRoom();
  scene.points.emplace_back(0, 0, std::numeric_limits<float>::quiet_NaN());
  scene.plane_of.push_back(0);
  Image image;
  const auto layout = PlaneView().draw(scene, image);
  EXPECT_NEAR(layout.to_camera.norm(), 1, 1e-12);
  EXPECT_NEAR(layout.to_camera.dot(layout.right), 0, 1e-12);
  EXPECT_GT(layout.points_drawn, 10000u);
}

TEST(PlaneView, RefusesWhatDoesNotFitTogether)
{
  Image image;
  PlaneViewScene scene = planeRoom();
  scene.plane_of.pop_back();
  EXPECT_THROW(PlaneView().draw(scene, image), BadArgument);
  scene = planeRoom();
  scene.seen_from.pop_back();
  EXPECT_THROW(PlaneView().draw(scene, image), BadArgument);
  scene = planeRoom();
  scene.plane_of[0] = 5;
  EXPECT_THROW(PlaneView().draw(scene, image), BadArgument);
  EXPECT_THROW(PlaneView().draw({}, image), BadArgument);
  PlaneViewOptions options;
  options.elevation = 2;
  EXPECT_THROW(PlaneView{options}, BadArgument);
  options = {};
  options.width = 10;
  EXPECT_THROW(PlaneView{options}, BadArgument);
}
