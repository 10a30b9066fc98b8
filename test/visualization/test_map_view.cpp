// SPDX-License-Identifier: BSD-3-Clause
#include "picture_checks.h"
#include "support/points.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/label_colours.h>
#include <pcl6d/visualization/map_view.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace {
using Eigen::Vector3d;
using pcl6d::BadArgument;
using pcl6d::Camera;
using pcl6d::labelColour;
using pcl6d::MapView;
using pcl6d::MapViewOptions;
using pcl6d::MapViewScene;
using pcl6d::PointColour;
using pcl6d::test::colourAt;
using pcl6d::test::difference;
using pcl6d::test::drawnPixels;
using pcl6d::test::kDarkBackground;
using pcl6d::test::kNan;
using pcl6d::test::kWhite;

constexpr int kTolerance = 3; // of a channel: rounding

/** A patch of points 2 cm apart around a corner, spanned by two vectors, with a label. */
void
addPatch(MapViewScene& scene,
         const Vector3d& corner,
         const Vector3d& u,
         const Vector3d& v,
         const std::string& label)
{
  const auto number = static_cast<std::uint32_t>(scene.label_names.size());
  scene.label_names.push_back(label);
  const int columns = static_cast<int>(u.norm() / 0.02);
  const int rows = static_cast<int>(v.norm() / 0.02);
  for (int i = 0; i <= columns; ++i)
    for (int k = 0; k <= rows; ++k) {
      scene.points.push_back((corner + u * i / columns + v * k / rows).cast<float>());
      scene.labels.push_back(number);
    }
}

/** A floor of 4 m x 3 m and a wall along its far side, 2 m high. */
MapViewScene
corner()
{
  MapViewScene scene;
  addPatch(scene, {0, 0, 0}, {4, 0, 0}, {0, 3, 0}, "floor");
  addPatch(scene, {0, 3, 0}, {4, 0, 0}, {0, 0, 2}, "wall");
  return scene;
}

MapViewOptions
byLabel()
{
  MapViewOptions options;
  options.width = 640;
  options.height = 400;
  options.colour = PointColour::kLabel;
  options.shading = 0;
  return options;
}

/** From y = -5, at 2 m, looking along y: right is x, down is -z. */
Camera
alongY()
{
  Camera camera;
  camera.T_world_camera.linear().col(0) = Vector3d::UnitX();
  camera.T_world_camera.linear().col(1) = -Vector3d::UnitZ();
  camera.T_world_camera.linear().col(2) = Vector3d::UnitY();
  camera.T_world_camera.translation() = Vector3d(2, -5, 2);
  camera.scale = 400;
  camera.centre = {320, 150};
  return camera;
}
/** Where a place is on a picture; it must be there. */
Eigen::Vector2d
pixelOf(const Camera& camera, const Vector3d& place)
{
  const auto pixel = camera.toPixel(place);
  if (!pixel)
    throw std::logic_error("a place that the camera must see");
  return pixel->head<2>();
}
} // namespace

TEST(Camera, ProjectsAsAPinhole)
{
  const auto pixel = alongY().toPixel({3, 3, 1});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 320 + 400 * 1.0 / 8, 1e-9);
  EXPECT_NEAR(pixel->y(), 150 + 400 * 1.0 / 8, 1e-9);
  EXPECT_NEAR(pixel->z(), 8, 1e-9);
  EXPECT_FALSE(alongY().toPixel({3, -6, 1})) << "behind";
}

TEST(MapView, ShowsSurfacesClosedInTheirColoursWhereTheyBelong)
{
  const auto picture = MapView(byLabel()).draw(corner(), alongY());
  EXPECT_EQ(picture.image.width, 640);
  EXPECT_EQ(picture.image.height, 400);
  const auto expectAt = [&](const Vector3d& place, const std::string& label) {
    const auto pixel = pixelOf(picture.layout.camera, place);
    EXPECT_LE(difference(colourAt(picture.image, pixel), labelColour(label)),
              kTolerance)
        << place.transpose();
  };
  for (double along = 0.2; along < 4; along += 0.2) {
    expectAt({along, 3, 1}, "wall");
    expectAt({along, 3, 1.8}, "wall");
    expectAt({along, 1, 0}, "floor");
    expectAt({along, 2, 0}, "floor");
  }
  EXPECT_EQ(colourAt(picture.image, pixelOf(picture.layout.camera, {2, 3, 2.3})),
            kDarkBackground);
}

TEST(MapView, HidesWhatLiesBehind)
{
  MapViewScene scene = corner();
  addPatch(scene, {1.5, 1, 0.5}, {1, 0, 0}, {0, 0, 1}, "door"); // in front of the wall
  const auto picture = MapView(byLabel()).draw(scene, alongY());
  const auto pixel = pixelOf(picture.layout.camera, {2, 1, 1});
  EXPECT_LE(difference(colourAt(picture.image, pixel), labelColour("door")),
            kTolerance);
}

TEST(MapView, NamesTheLabels)
{
  const auto picture = MapView(byLabel()).draw(corner(), alongY());
  const auto& layout = picture.layout;
  const pcl6d::PictureBox below{320, layout.map.bottom + 10, 640, 400};
  int floor = 0, wall = 0;
  for (int row = static_cast<int>(below.top); row < 400; ++row)
    for (int column = 320; column < 640; ++column) {
      const auto colour = picture.image.at(column, row);
      floor += difference(colour, labelColour("floor")) <= kTolerance;
      wall += difference(colour, labelColour("wall")) <= kTolerance;
    }
  EXPECT_GT(floor, 20) << "dot of the label";
  EXPECT_GT(wall, 20);
}

TEST(MapView, ShowsTitleLegendAndColourBar)
{
  MapViewOptions options = byLabel();
  options.colour = PointColour::kHeight;
  options.title = "a title";
  MapViewScene scene = corner();
  scene.trajectory.poses.push_back(pcl6d::planarPose(1, 1, 0));
  const auto picture = MapView(options).draw(scene, alongY());
  const auto drawn = [&](double left, double top, double right, double bottom) {
    return drawnPixels(picture.image, {left, top, right, bottom}, kDarkBackground);
  };
  const double top = picture.layout.map.top, bottom = picture.layout.map.bottom;
  EXPECT_GT(drawn(0, 0, 200, top), 50) << "title";
  EXPECT_EQ(drawn(220, 0, 360, top), 0);
  EXPECT_GT(drawn(400, 0, 640, top), 50) << "legend";
  EXPECT_GT(drawn(400, bottom + 2, 640, 400), 300) << "colour bar";
  EXPECT_NEAR(picture.layout.lowest_colour, 0, 1e-6);
  EXPECT_NEAR(picture.layout.highest_colour, 1.9, 0.1); // the 98 % quantile
}

TEST(MapView, DrawsPathsAndOverlayOverPoints)
{
  MapViewScene scene = corner();
  for (double x = 0.5; x < 4; x += 0.5)
    scene.trajectory.poses.push_back(pcl6d::planarPose(x, 2, 0));
  scene.trajectory.poses[2].translation().x() = std::nan(""); // is left out
  const pcl6d::Colour red{250, 20, 30};
  scene.overlay.lines.push_back({{{0.5, 3, 1}, {3.5, 3, 1}}, red, 4});
  scene.overlay.marks.push_back({{2, 3, 1.7}, red, 12});
  const auto picture = MapView(byLabel()).draw(scene, alongY());
  const auto at = [&](const Vector3d& place) {
    return colourAt(picture.image, pixelOf(picture.layout.camera, place));
  };
  EXPECT_LE(difference(at({3.2, 2, 0}), kWhite), 12) << "path";
  EXPECT_LE(difference(at({2, 3, 1}), red), kTolerance) << "line";
  EXPECT_LE(difference(at({2, 3, 1.7}), red), kTolerance) << "mark";
}

TEST(MapView, DarkensWhatLiesBehindAnEdge)
{
  MapViewScene scene = corner();
  addPatch(scene, {1.5, 0, 0.5}, {1, 0, 0}, {0, 0, 1}, "door");
  MapViewOptions options = byLabel();
  const auto flat = MapView(options).draw(scene, alongY());
  options.shading = 1;
  const auto shaded = MapView(options).draw(scene, alongY());
  const auto pixel = pixelOf(flat.layout.camera, {2.5, 0, 1});
  const auto darkest = [&](const pcl6d::Image& image) {
    int lowest = 255;
    for (int dx = 0; dx < 5; ++dx) {
      const auto c = colourAt(image, pixel + Eigen::Vector2d(dx, 0));
      lowest = std::min(lowest, (c[0] + c[1] + c[2]) / 3);
    }
    return lowest;
  };
  EXPECT_LT(darkest(shaded.image), darkest(flat.image) - 20);
}

TEST(MapView, IsTransparentWhereNothingIsDrawn)
{
  MapViewOptions options = byLabel();
  options.transparent = true;
  const auto picture = MapView(options).draw(corner(), alongY());
  ASSERT_EQ(picture.image.alpha.size(), 640u * 400u);
  const auto alphaAt = [&](const Eigen::Vector2d& pixel) {
    return picture.image.alpha[static_cast<std::size_t>(pixel.y()) * 640 +
                               static_cast<std::size_t>(pixel.x())];
  };
  EXPECT_EQ(alphaAt({3, 3}), 0);
  const auto wall = pixelOf(picture.layout.camera, {2, 3, 1});
  EXPECT_EQ(alphaAt(wall), 255);
  EXPECT_LE(difference(colourAt(picture.image, wall), labelColour("wall")), kTolerance);
}

TEST(MapView, FindsViewpointsThatShowEverything)
{
  const MapView view(byLabel());
  const auto cameras = view.viewpoints(corner(), 3);
  ASSERT_EQ(cameras.size(), 3u);
  const auto points = corner().points;
  for (const Camera& camera : cameras) {
    const auto seen = std::count_if(points.begin(), points.end(), [&](const auto& p) {
      return view.box().contains(pixelOf(camera, p.template cast<double>()));
    });
    EXPECT_GT(static_cast<double>(seen), 0.93 * static_cast<double>(points.size()));
  }
  // The wall hides the floor from behind, and the floor is seen from the front.
  EXPECT_LT(cameras.front().T_world_camera.translation().y(), 3);
  const auto heading = [](const Camera& camera) -> Eigen::Vector2d {
    return camera.T_world_camera.linear().col(2).head<2>().normalized();
  };
  EXPECT_LE(heading(cameras[0]).dot(heading(cameras[1])), 0.5 + 1e-9);
}

TEST(MapView, DrawsAPanoramaAllAround)
{
  MapViewScene scene;
  const auto pole = [&](double x, double y, const std::string& label) {
    addPatch(scene, {x - 0.2, y - 0.2, -1}, {0.4, 0.4, 0}, {0, 0, 2}, label);
  };
  pole(5, 0, "wall");     // ahead
  pole(0, 5, "door");     // to the left
  pole(0, -5, "floor");   // to the right
  pole(-5, 0, "ceiling"); // behind
  MapViewOptions options = byLabel();
  options.height.reset();
  const auto picture =
      MapView(options).drawPanorama(scene, Eigen::Isometry3d::Identity());
  const auto& map = picture.layout.map;
  const auto expectAt = [&](double share, const std::string& label) {
    const double column = map.left + share * (map.right - map.left);
    const Eigen::Vector2d pixel(column, picture.layout.camera.centre.y());
    EXPECT_LE(difference(colourAt(picture.image, pixel), labelColour(label)),
              kTolerance)
        << label;
  };
  expectAt(0.25, "door");
  expectAt(0.5, "wall");
  expectAt(0.75, "floor");
  EXPECT_LT(pixelOf(picture.layout.camera, {5, 0, 0.9}).y(),
            picture.layout.camera.centre.y());
}

TEST(MapView, LeavesOutAzimuthsWithoutPointsInAPanorama)
{
  MapViewScene scene;
  addPatch(scene, {-2, 5, -1}, {4, 0, 0}, {0, 0, 2}, "wall"); // to the left only
  const auto picture =
      MapView(byLabel()).drawPanorama(scene, Eigen::Isometry3d::Identity());
  const auto& map = picture.layout.map;
  EXPECT_NEAR(pixelOf(picture.layout.camera, {0, 5, 0}).x(), 320, 12);
  EXPECT_NEAR(pixelOf(picture.layout.camera, {2, 5, 0}).x(), map.right, 50);
  EXPECT_NEAR(pixelOf(picture.layout.camera, {-2, 5, 0}).x(), map.left, 50);
}

TEST(MapView, DrawsModelsIntoTheMap)
{
  MapViewScene scene = corner();
  const pcl6d::Colour blue{40, 60, 250};
  MapViewScene::Model model;
  model.colour = blue;
  model.mesh.vertices = {{1, 1, 0.2}, {2, 1, 0.2}, {1, 1, 1.2}};
  model.mesh.triangles = {{0, 1, 2}};
  scene.models.push_back(model);
  const auto picture = MapView(byLabel()).draw(scene, alongY());
  const auto pixel = pixelOf(picture.layout.camera, {1.3, 1, 0.5});
  const auto colour = colourAt(picture.image, pixel);
  EXPECT_GT(colour[2], 150);
  EXPECT_LT(colour[0], 80);
}

TEST(MapView, ThinsToItsBudgetAlwaysInTheSameWay)
{
  MapViewOptions options = byLabel();
  options.max_points = 2000;
  const auto first = MapView(options).draw(corner());
  EXPECT_LE(first.layout.points_drawn, 2000u);
  EXPECT_GT(first.layout.points_drawn, 1800u);
  EXPECT_EQ(MapView(options).draw(corner()).image.rgb, first.image.rgb);
}

TEST(MapView, DrawsEvenASinglePointAndSkipsWhatIsNotFinite)
{
  MapViewScene scene;
  scene.points = {
      {3, 4, 5}, {kNan, 0, 0}, {0, std::numeric_limits<float>::infinity(), 0}};
  MapViewOptions options = byLabel();
  options.colour = PointColour::kPlain;
  const auto picture = MapView(options).draw(scene);
  EXPECT_EQ(picture.layout.points_drawn, 1u);
  EXPECT_GT(drawnPixels(picture.image, picture.layout.map, kDarkBackground), 0);
}

TEST(MapView, RefusesWhatDoesNotFitTogether)
{
  const MapView view(byLabel());
  EXPECT_THROW(view.draw({}), BadArgument);
  MapViewScene scene = corner();
  scene.labels.pop_back();
  EXPECT_THROW(view.draw(scene), BadArgument);
  scene = corner();
  scene.labels[0] = 9;
  EXPECT_THROW(view.draw(scene), BadArgument);
  for (auto& p : scene.points)
    p.setConstant(kNan);
  scene.labels[0] = 0;
  EXPECT_THROW(view.draw(scene), BadArgument);
  const auto refuses = [](auto change) {
    MapViewOptions options;
    change(options);
    EXPECT_THROW(MapView{options}, BadArgument);
  };
  refuses([](auto& o) { o.width = 20; });
  refuses([](auto& o) { o.height = 100000; });
  refuses([](auto& o) { o.shading = -1; });
  refuses([](auto& o) { o.point_size = 0; });
  refuses([](auto& o) { o.max_points = 0; });
  refuses([](auto& o) { o.margin = -1; });
}
