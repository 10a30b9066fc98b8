// SPDX-License-Identifier: BSD-3-Clause
// A thing without symmetry, tilted anyhow, in the view of a depth camera.
#include "object_localization/localization_cases.h"
#include "support/constants.h"

#include <pcl6d/common/random.h>
#include <pcl6d/object_localization/object_localizer.h>
#include <pcl6d/simulation/scene_bodies.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::test::kDegree;

namespace pcl6d {
namespace {

/** A board and a wall behind it, with some blocks on it. */
TriangleScene
table()
{
  TriangleScene scene;
  addBox(scene, {0.4, -1, -0.35}, {2.2, 1, -0.3}, {});
  addBox(scene, {2.2, -2, -2}, {2.3, 2, 2}, {});
  addBox(scene, {1.1, -0.55, -0.3}, {1.2, -0.35, -0.18}, {});
  addCylinder(scene, {1.5, -0.3, -0.3}, 0.06, 0.25, {});
  return scene;
}

Points
seen(const TriangleScene& scene, double noise)
{
  return test::scanOf(scene,
                      scannerByName("projection", 0.2 * kDegree),
                      Eigen::Isometry3d::Identity(),
                      noise);
}
} // namespace

TEST(FeatureLocalization, FindsATiltedObjectInSixDegreesOfFreedom)
{
  const TriangleMesh mesh = test::machineMesh();
  const ObjectLocalizer localizer(ObjectModel::fromMesh("machine", mesh));
  // which show faces to three sides
  const Eigen::Isometry3d truths[] = {
      poseFromEuler({1.1, -0.2, -0.1}, {0.4, 0.2, 2.6}),
      poseFromEuler({1.1, 0.2, -0.1}, {-0.3, 0.4, -2.2})};
  for (const auto& truth : truths) {
    TriangleScene scene = table();
    addMesh(scene, mesh, truth, {});
    for (const double noise : {0.0, 0.002}) {
      const auto found = localizer.locate(LocalizationScene(seen(scene, noise)));
      ASSERT_EQ(found.size(), 1u) << truth.translation().y() << ", noise " << noise;
      const MotionSize off = distanceBetween(truth, found[0].T_scene_object);
      EXPECT_LT(off.translation, 0.01); // along the faces, which hold it weakly there
      EXPECT_LT(off.rotation, (noise == 0 ? 0.5 : 1) * kDegree);
      EXPECT_EQ(found[0].status, Status::kOk);
      EXPECT_TRUE(found[0].covariance);
    }
  }
}

TEST(FeatureLocalization, SaysSoWhereTheFacesInSightLeaveAShiftOpen)
{
  const TriangleMesh mesh = test::machineMesh();
  const ObjectLocalizer localizer(ObjectModel::fromMesh("machine", mesh));
  const Eigen::Isometry3d truth = poseFromEuler({1.05, -0.05, -0.1}, {0.5, 0.3, 2.6});
  TriangleScene scene = table();
  addMesh(scene, mesh, truth, {});
  const auto found = localizer.locate(LocalizationScene(seen(scene, 0)));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].status, Status::kRankDeficient);
  EXPECT_FALSE(found[0].covariance);
  const MotionSize off = distanceBetween(truth, found[0].T_scene_object);
  EXPECT_LT(off.translation, 0.01); // along the shift
  EXPECT_LT(off.rotation, 0.5 * kDegree);
}

TEST(FeatureLocalization, FindsNothingWithoutIt)
{
  const ObjectLocalizer localizer(
      ObjectModel::fromMesh("machine", test::machineMesh()));
  EXPECT_TRUE(localizer.locate(LocalizationScene(seen(table(), 0))).empty());
  EXPECT_TRUE(localizer.locate(LocalizationScene(seen(table(), 0.002))).empty());
}

TEST(FeatureLocalization, FindsBothOfTwo)
{
  const TriangleMesh mesh = test::machineMesh();
  const Eigen::Isometry3d truths[] = {
      poseFromEuler({1.1, -0.2, -0.1}, {0.4, 0.2, 2.6}),
      poseFromEuler({1.1, 0.2, -0.1}, {-0.3, 0.4, -2.2})};
  TriangleScene scene = table();
  for (const auto& truth : truths)
    addMesh(scene, mesh, truth, {});
  const ObjectLocalizer localizer(ObjectModel::fromMesh("machine", mesh));
  const auto found = localizer.locate(LocalizationScene(seen(scene, 0)));
  ASSERT_EQ(found.size(), 2u);
  for (const auto& truth : truths) {
    const MotionSize a = distanceBetween(truth, found[0].T_scene_object);
    const MotionSize b = distanceBetween(truth, found[1].T_scene_object);
    EXPECT_LT(std::min(a.translation, b.translation), 0.003);
    EXPECT_LT(std::min(a.rotation, b.rotation), 0.7 * kDegree);
  }
}

} // namespace pcl6d
