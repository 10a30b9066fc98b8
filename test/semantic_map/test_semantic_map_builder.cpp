// SPDX-License-Identifier: BSD-3-Clause
// Scans, planes and objects in memory, as a user of the library has them.
#include "semantic_map/small_map.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/semantic_map/semantic_map_builder.h>

#include <gtest/gtest.h>

namespace pcl6d {
namespace {
using namespace test;

/** The two rooms of small_map.h, and the points on the planes of them. */
struct Rooms {
  Rooms()
  {
    for (const auto& plane : truth.planes)
      planes.push_back(plane.best());
    scans.scans = truth.scans;
    for (const auto& plane : planes)
      for (int i = 0; i <= 40; ++i)
        for (int k = 0; k <= 40; ++k)
          points.push_back((plane.hull[0] + i / 40.0 * (plane.hull[1] - plane.hull[0]) +
                            k / 40.0 * (plane.hull[3] - plane.hull[0]))
                               .cast<float>());
  }

  /** All that a scan sees: what is nearer than 3 m. */
  Points
  seenBy(std::size_t i) const
  {
    const Eigen::Isometry3f T_scan_world =
        scans.scans[i].T_world_scan.inverse().cast<float>();
    Points seen;
    for (const auto& point : points)
      if ((T_scan_world * point).norm() < 3)
        seen.push_back(T_scan_world * point);
    return seen;
  }

  void
  build(SemanticMapBuilder& builder) const
  {
    builder.build(points, [this](std::size_t i) { return seenBy(i); });
  }

  SemanticMap truth = twoRooms();
  SemanticMap scans;
  std::vector<Plane> planes;
  Points points;
};
} // namespace

TEST(SemanticMapBuilder, JoinsScansPlanesAndObjects)
{
  const Rooms rooms;
  SemanticMapBuilder builder(rooms.scans);
  builder.setObjects(rooms.truth.objects);
  builder.setPlanes(rooms.planes);
  rooms.build(builder);
  const SemanticMap& map = builder.map();
  EXPECT_EQ(map.planes.size(), 10u);
  EXPECT_EQ(map.rooms.size(), 2u);
  EXPECT_TRUE(says(map, "object:3", "on", "object:1"));
  ASSERT_EQ(map.objects.size(), 4u);
  EXPECT_EQ(map.objects[0].scans,
            (std::vector<std::size_t>{0, 2}));                   // as it says itself
  EXPECT_EQ(map.planes[4].scans, (std::vector<std::size_t>{0})); // the wall x = 0
  ASSERT_EQ(builder.labels().plane_id.size(), rooms.points.size());
  EXPECT_EQ(builder.labels().plane_id[0], 1u);
}

TEST(SemanticMapBuilder, LabelsPlanesThatHaveNoLabel)
{
  Rooms rooms;
  for (auto& plane : rooms.planes)
    plane.label = "none";
  SemanticMapBuilder builder(rooms.scans);
  builder.setPlanes(rooms.planes);
  EXPECT_EQ(builder.map().planes[0].best().label, "floor");
  EXPECT_EQ(builder.map().planes[2].best().label, "wall");
}

TEST(SemanticMapBuilder, MakesOneObjectOfSeveralObservations)
{
  const Rooms rooms;
  MapObject chair = rooms.truth.objects[1];
  std::vector<MapObject> observations(2, chair);
  observations[0].scans = {0};
  observations[1].scans = {2};
  SemanticMapBuilder builder(rooms.scans);
  builder.setObjects(observations);
  ASSERT_EQ(builder.map().objects.size(), 1u);
  EXPECT_EQ(builder.map().objects[0].scans, (std::vector<std::size_t>{0, 2}));
  SemanticMapBuilderOptions options;
  options.fuse = false;
  SemanticMapBuilder apart(rooms.scans, options);
  apart.setObjects(observations);
  EXPECT_EQ(apart.map().objects.size(), 2u);
}

TEST(SemanticMapBuilder, RefusesAnObjectOfAScanThatIsNotThere)
{
  const Rooms rooms;
  MapObject chair = rooms.truth.objects[1];
  chair.scans = {1};
  SemanticMapBuilder builder(rooms.scans);
  EXPECT_THROW(builder.setObjects({chair}), IoFailed);
}

TEST(SemanticMapBuilder, AddsWhatPointsAreToACloud)
{
  const Rooms rooms;
  SemanticMapBuilder builder(rooms.scans);
  builder.setPlanes(rooms.planes);
  rooms.build(builder);
  pcl::PCLPointCloud2 cloud;
  cloud.width = static_cast<std::uint32_t>(rooms.points.size());
  cloud.height = 1;
  addLabelFields(builder.labels(), builder.map().labelNames(), cloud);
  for (const char* const name : {"label", "plane_id", "object_id", "rgb"}) {
    const auto field = fieldValues(cloud, name);
    ASSERT_TRUE(field) << name;
    EXPECT_EQ(field->values.size(), rooms.points.size()) << name;
  }
}

} // namespace pcl6d
