// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_map/small_map.h"

#include <pcl6d/common/error.h>
#include <pcl6d/semantic_map/find_rooms.h>
#include <pcl6d/semantic_map/map_relations.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace pcl6d;
using pcl6d::test::says;
using pcl6d::test::twoRooms;

namespace {
SemanticMap
related(SemanticMap map, const MapRelationOptions& options = {})
{
  findRooms(map);
  map.relations = findRelations(map, options);
  return map;
}
} // namespace

TEST(MapRelations, OfPlanesAreThoseOfTheBook)
{
  const SemanticMap map = related(twoRooms());
  EXPECT_TRUE(says(map, "plane:1", "parallel", "plane:2"));
  EXPECT_TRUE(says(map, "plane:2", "above", "plane:1"));
  EXPECT_FALSE(says(map, "plane:1", "above", "plane:2"));
  EXPECT_TRUE(says(map, "plane:1", "orthogonal", "plane:3"));
  EXPECT_FALSE(says(map, "plane:3", "orthogonal", "plane:1")) << "kept once";
  EXPECT_TRUE(says(map, "plane:3", "orthogonal", "plane:5"));
  EXPECT_TRUE(says(map, "plane:3", "parallel", "plane:4"));
  EXPECT_FALSE(says(map, "plane:3", "onto", "plane:4"));
  EXPECT_TRUE(says(map, "plane:7", "onto", "plane:9")) << "the door is in the wall";
  EXPECT_TRUE(says(map, "plane:1", "touches", "plane:3"));
  EXPECT_FALSE(says(map, "plane:1", "touches", "plane:2"));
  EXPECT_TRUE(says(map, "plane:3", "equalheight", "plane:4"));
  for (const auto& relation : map.relations)
    EXPECT_FALSE(toString(relation.first) == "plane:10" && relation.predicate != "in")
        << "no label, no relations: " << relation.predicate;
}

TEST(MapRelations, OfPlanesEndWhereTheyAreFarApart)
{
  MapRelationOptions options;
  options.reach = 2;
  const SemanticMap map = related(twoRooms(), options);
  EXPECT_FALSE(says(map, "plane:3", "parallel", "plane:4")); // 3 m
  EXPECT_TRUE(says(map, "plane:7", "parallel", "plane:8"));  // 0.1 m
}

TEST(MapRelations, TellWhatAnObjectStandsOn)
{
  const SemanticMap map = related(twoRooms());
  EXPECT_TRUE(says(map, "object:1", "on", "plane:1"));
  EXPECT_TRUE(says(map, "object:2", "on", "plane:1"));
  EXPECT_TRUE(says(map, "object:3", "on", "plane:10"));
  EXPECT_TRUE(says(map, "object:3", "on", "object:1"));
  EXPECT_FALSE(says(map, "object:3", "on", "plane:1"));
  EXPECT_TRUE(says(map, "plane:10", "in", "object:1")) << "a part of the table";
  EXPECT_EQ(test::numRelations(map, "on"), 5u);
}

TEST(MapRelations, FollowTheFootWithinFiveCentimetres)
{
  for (const double height : {-0.06, -0.04, 0.0, 0.04, 0.06}) {
    SemanticMap map = twoRooms();
    map.objects.resize(1);
    map.objects[0].pose.T_world_object.translation().z() = height;
    map.relations = findRelations(map);
    EXPECT_EQ(says(map, "object:1", "on", "plane:1"), std::abs(height) < 0.05)
        << height;
  }
  SemanticMap map = twoRooms(); // beside the floor
  map.objects.resize(1);
  map.objects[0].pose.T_world_object.translation().x() = -0.2;
  map.relations = findRelations(map);
  EXPECT_FALSE(says(map, "object:1", "on", "plane:1"));
}

TEST(MapRelations, TellRoomsAndNeighboursOfObjects)
{
  const SemanticMap map = related(twoRooms());
  const bool left_first = isInPlan(map.rooms[0], map.up, {1, 1, 0});
  const std::string left = left_first ? "room:1" : "room:2";
  const std::string right = left_first ? "room:2" : "room:1";
  for (const auto object : {"object:1", "object:2", "object:3"}) {
    EXPECT_TRUE(says(map, object, "in", left)) << object;
    EXPECT_FALSE(says(map, object, "in", right)) << object;
  }
  EXPECT_TRUE(says(map, "object:4", "in", right));
  EXPECT_TRUE(says(map, "object:1", "next_to", "object:2"));
  EXPECT_FALSE(says(map, "object:1", "next_to", "object:4"));
  EXPECT_FALSE(says(map, "object:1", "next_to", "object:3")) << "on it, not beside";
  EXPECT_TRUE(says(map, "object:4", "next_to", "plane:3"));
  EXPECT_TRUE(says(map, "object:4", "next_to", "plane:6"));
  EXPECT_FALSE(says(map, "object:4", "next_to", "plane:5"));
  EXPECT_TRUE(says(map, "room:1", "next_to", "room:2")) << "kept";
}

TEST(MapRelations, TellWhatIsAboveAndInAnotherObject)
{
  SemanticMap map;
  map.objects = {test::object("shelf", {0, 0, 0}, {0.4, 1, 1.8}),
                 test::object("book", {0, 0.2, 0.9}, {0.2, 0.05, 0.3}),
                 test::object("lamp", {0, 0, 2.3}, {0.3, 0.3, 0.2}),
                 test::object("vase", {0, -0.3, 1.82}, {0.1, 0.1, 0.3}),
                 test::object("chair", {0.3, 0, 0}, {0.45, 0.45, 0.95})};
  map.relations = findRelations(map);
  EXPECT_TRUE(says(map, "object:2", "in", "object:1"));
  EXPECT_TRUE(says(map, "object:3", "above", "object:1"));
  EXPECT_TRUE(says(map, "object:4", "on", "object:1"));
  EXPECT_TRUE(says(map, "object:1", "next_to", "object:5"))
      << "boxes that overlap a little are neighbours";
  EXPECT_FALSE(says(map, "object:5", "in", "object:1"));
  EXPECT_FALSE(says(map, "object:3", "on", "object:1"));
}

TEST(MapRelations, ComeInOrderAndRefuseWrongOptions)
{
  const SemanticMap map = related(twoRooms());
  EXPECT_TRUE(std::is_sorted(
      map.relations.begin(),
      map.relations.end(),
      [](const MapRelation& a, const MapRelation& b) { return a.first < b.first; }));
  SemanticMap again = map;
  again.relations = findRelations(map);
  ASSERT_EQ(again.relations.size(), map.relations.size()) << "nothing twice";
  MapRelationOptions options;
  options.on = 0;
  EXPECT_THROW(findRelations(map, options), BadArgument);
  options = {};
  options.planes.angle = 2;
  EXPECT_THROW(findRelations(map, options), BadArgument);
}
