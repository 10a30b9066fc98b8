// SPDX-License-Identifier: BSD-3-Clause
#include "support/box_room.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/label_colours.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/scene_interpretation/labelled_files.h>
#include <pcl6d/scene_interpretation/pcl/scene_interpreter.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::PlaneSegment;
using pcl6d::test::BoxRoom;

constexpr std::uint32_t kPointsOfPlane = 100;

struct Scene {
  std::vector<PlaneSegment> planes;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud{new pcl::PointCloud<pcl::PointXYZ>};
};

// The room and one point more, on no plane.
Scene
makeScene()
{
  Scene scene;
  pcl6d::Random random(1);
  for (const auto& truth : BoxRoom().planes()) {
    PlaneSegment segment;
    segment.plane = truth.plane;
    segment.plane.label = "none";
    segment.seen_from = truth.seen_from;
    const auto& hull = truth.plane.hull;
    for (std::uint32_t i = 0; i < kPointsOfPlane; ++i) {
      segment.points.push_back(static_cast<std::uint32_t>(scene.cloud->size()));
      const double u = random.uniform(), v = random.uniform();
      const Eigen::Vector3d p =
          hull[0] + u * (hull[1] - hull[0]) + v * (hull[3] - hull[0]);
      scene.cloud->push_back({static_cast<float>(p.x()),
                              static_cast<float>(p.y()),
                              static_cast<float>(p.z())});
    }
    scene.planes.push_back(segment);
  }
  scene.cloud->push_back({0, 0, 1.5f});
  return scene;
}
} // namespace

TEST(SceneInterpreter, LabelsAndRefinesTheCloud)
{
  const Scene scene = makeScene();
  pcl6d::SceneInterpreter<pcl::PointXYZ> interpreter;
  pcl::PointCloud<pcl::PointXYZL> labelled;
  EXPECT_THROW(interpreter.getLabelledCloud(labelled), pcl6d::BadArgument);
  interpreter.setInputCloud(scene.cloud);
  interpreter.setPlanes(scene.planes);
  EXPECT_EQ(interpreter.interpret().labels, labelsOf(BoxRoom().planes()));
  interpreter.getLabelledCloud(labelled);
  ASSERT_EQ(labelled.size(), scene.cloud->size());
  EXPECT_EQ(labelled[0].label, 1u);
  EXPECT_EQ(labelled[kPointsOfPlane].label, 2u);
  EXPECT_EQ(labelled[6 * kPointsOfPlane].label, 4u);
  EXPECT_EQ(labelled.back().label, 0u);
  EXPECT_EQ(labelled[5].x, (*scene.cloud)[5].x);
  pcl::PointCloud<pcl::PointXYZ> moved;
  const auto model = interpreter.refine(moved);
  EXPECT_EQ(model.status, pcl6d::Status::kOk);
  ASSERT_EQ(moved.size(), scene.cloud->size());
  EXPECT_NEAR(moved[7].z, (*scene.cloud)[7].z, 1e-5);
  auto planes = interpreter.planes();
  planes[3].plane.label = "sofa"; // of which the book knows nothing
  interpreter.setPlanes(planes);
  EXPECT_THROW(interpreter.getLabelledCloud(labelled), pcl6d::BadArgument);
}

TEST(LabelledFiles, HoldPointsWithPlaneLabelAndColour)
{
  Scene scene = makeScene();
  applyLabels(interpretScene(scene.planes), scene.planes);
  const pcl6d::test::TempFolder folder;
  writeLabelledCloud(
      folder / "labels.pcd", pcl6d::toPoints(*scene.cloud), scene.planes);
  const auto cloud = pcl6d::readPcd(folder / "labels.pcd");
  ASSERT_EQ(cloud.width, scene.cloud->size());
  pcl::PointCloud<pcl::PointXYZRGBL> points;
  pcl::fromPCLPointCloud2(cloud, points);
  const auto red = pcl6d::labelColour("door");
  const auto& door = points[6 * kPointsOfPlane + 3];
  EXPECT_EQ(door.label, 4u);
  EXPECT_EQ(door.r, red[0]);
  EXPECT_EQ(door.g, red[1]);
  EXPECT_EQ(door.b, red[2]);
  EXPECT_EQ(door.y, (*scene.cloud)[6 * kPointsOfPlane + 3].y);
  EXPECT_EQ(points.back().label, 0u);
  EXPECT_EQ(cloud.fields[4].name, "plane_id");
  scene.cloud->resize(10);
  EXPECT_THROW(writeLabelledCloud(
                   folder / "labels.pcd", pcl6d::toPoints(*scene.cloud), scene.planes),
               pcl6d::BadArgument);
}

TEST(LabelledFiles, HoldHullsAsMesh)
{
  Scene scene = makeScene();
  const auto& hull = scene.planes[0].plane.hull;
  const Eigen::Vector3d centre = (hull[0] + hull[2]) / 2;
  scene.planes[0].outline = {hull, {}};
  for (const int corner : {3, 2, 1, 0}) // a hole of a quarter of the area
    scene.planes[0].outline[1].push_back((centre + hull[corner]) / 2);
  const pcl6d::test::TempFolder folder;
  writeLabelledHulls(folder / "hulls.ply", scene.planes);
  const auto mesh = pcl6d::readMesh(folder / "hulls.ply");
  double area = 0, expected = -0.25 * scene.planes[0].plane.area;
  for (const auto& [a, b, c] : mesh.triangles)
    area += (mesh.vertices[b] - mesh.vertices[a])
                .cross(mesh.vertices[c] - mesh.vertices[a])
                .norm() /
            2;
  for (const auto& segment : scene.planes)
    expected += segment.plane.area;
  EXPECT_NEAR(area, expected, 1e-4);
  EXPECT_EQ(mesh.triangles.size(), 8 + 8 * 2u);
  const std::string text = pcl6d::test::readText(folder / "hulls.ply");
  EXPECT_NE(text.find("property int plane_id"), std::string::npos);
  EXPECT_THROW(writeLabelledHulls(folder / "no" / "hulls.ply", scene.planes),
               pcl6d::IoFailed);
}

TEST(LabelColours, AreFixedAndDifferForTheBooksLabels)
{
  const char* const labels[] = {"none", "floor", "ceiling", "wall", "door"};
  for (const auto* a : labels)
    for (const auto* b : labels)
      EXPECT_EQ(pcl6d::labelColour(a) == pcl6d::labelColour(b), a == b);
  EXPECT_EQ(pcl6d::labelColour("sofa"), pcl6d::labelColour("sofa"));
}
