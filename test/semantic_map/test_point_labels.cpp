// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_map/small_map.h"

#include <pcl6d/common/error.h>
#include <pcl6d/semantic_map/point_labels.h>

#include <gtest/gtest.h>

using namespace pcl6d;
using pcl6d::test::twoRooms;

namespace {
struct Expected {
  Eigen::Vector3f point;
  std::string label;
  std::uint32_t plane_id;
  std::uint32_t object_id;
};
} // namespace

TEST(PointLabels, ArePlanesAndBoxes)
{
  const SemanticMap map = twoRooms();
  const std::vector<Expected> expected = {
      {{2, 2.5F, 0.01F}, "floor", 1, 0},
      {{2, 2.5F, 0.04F}, "floor", 1, 0},
      {{2, 2.5F, 0.06F}, "none", 0, 0}, // too high
      {{2, 2.5F, 2.49F}, "ceiling", 2, 0},
      {{4.05F, 1.5F, 1}, "door", 9, 0}, // not the walls beside it
      {{4.01F, 0.5F, 1}, "wall", 7, 0},
      {{1, 1.5F, 0.74F}, "table", 10, 1}, // a top of no label is of the table
      {{0.7F, 1.2F, 0.3F}, "table", 0, 1},
      {{1, 1.5F, 0.005F}, "floor", 1, 0}, // the floor under it is no table
      {{1, 1.6F, 0.8F}, "cup", 0, 3},     // the smaller box
      {{7.8F, 0.3F, 0.2F}, "waste bin", 0, 4},
      {{2, 2.5F, 1.2F}, "none", 0, 0}};
  Points points;
  for (const auto& e : expected)
    points.push_back(e.point);
  // as a scan sees them
  const Eigen::Isometry3d pose = poseFromEuler({3, 1, 1}, {0.1, 0.2, 0.9});
  const PointLabels labels =
      PointLabeller(map).label(transformed(points, pose.inverse()), pose);
  const auto names = map.labelNames();
  EXPECT_EQ(names[static_cast<std::size_t>(PlaneLabel::kDoor)], "door");
  EXPECT_EQ(names.size(), 9u);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE(expected[i].point.transpose());
    EXPECT_EQ(names[labels.label[i]], expected[i].label);
    EXPECT_EQ(labels.plane_id[i], expected[i].plane_id);
    EXPECT_EQ(labels.object_id[i], expected[i].object_id);
  }
}

TEST(PointLabels, FollowTheRefinedPlane)
{
  SemanticMap map = twoRooms();
  map.planes[0].refined = map.planes[0].measured;
  map.planes[0].refined->offset += 0.1; // normal up or down: 10 cm off either way
  const PointLabels labels =
      PointLabeller(map).label({{2, 2.5F, 0}}, Eigen::Isometry3d::Identity());
  EXPECT_EQ(labels.plane_id[0], 0u);
}

TEST(PointLabels, AreTheSameForAnyNumberOfThreads)
{
  const SemanticMap map = twoRooms();
  Points points;
  for (float x = 0; x < 8.1F; x += 0.05F)
    for (float y = 0; y < 3; y += 0.05F)
      points.emplace_back(x, y, 0.3F * x);
  PointLabelOptions one, several;
  one.num_threads = 1;
  several.num_threads = 5;
  const auto pose = Eigen::Isometry3d::Identity();
  const PointLabels a = PointLabeller(map, one).label(points, pose);
  const PointLabels b = PointLabeller(map, several).label(points, pose);
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.plane_id, b.plane_id);
  EXPECT_EQ(a.object_id, b.object_id);
}

TEST(PointLabels, RefuseWrongOptions)
{
  PointLabelOptions options;
  options.plane_distance = 0;
  EXPECT_THROW(PointLabeller(SemanticMap(), options), BadArgument);
  options = {};
  options.skin = -1;
  EXPECT_THROW(PointLabeller(SemanticMap(), options), BadArgument);
}
