// SPDX-License-Identifier: BSD-3-Clause
#include "support/box_room.h"
#include "support/constants.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/scene_interpretation/interpretation.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace {
using pcl6d::InterpretationOptions;
using pcl6d::test::BoxRoom;
using pcl6d::test::kUp;
using pcl6d::test::kX;
using pcl6d::test::kY;
using pcl6d::test::rectangle;
using pcl6d::test::TruePlane;
using Labels = std::vector<std::string>;

std::vector<TruePlane>
house(double storeys)
{
  std::vector<TruePlane> planes;
  for (int i = 0; i < storeys; ++i) {
    BoxRoom room;
    room.base = 3 * i;
    room.length = 5 + i;
    const auto more = room.planes();
    planes.insert(planes.end(), more.begin(), more.end());
  }
  return planes;
}

pcl6d::Interpretation
interpreted(const std::vector<TruePlane>& planes,
            const InterpretationOptions& options = {})
{
  return interpretPlanes(
      planesOf(planes), sidesOf(planes), pcl6d::bookRules(), options);
}
} // namespace

TEST(Interpretation, OfNothingIsEmpty)
{
  const auto found = pcl6d::interpretScene({});
  EXPECT_TRUE(found.labels.empty());
  EXPECT_EQ(found.status, pcl6d::Status::kOk);
  EXPECT_EQ(found.storeys.size(), 1u);
  EXPECT_FALSE(found.storeys[0].floor);
}

TEST(Interpretation, OneLevelPlaneIsFloorOrCeilingByWhereTheSensorIs)
{
  const auto planes = pcl6d::test::planesOf({rectangle("", {0, 0, 1}, 2 * kX, 2 * kY)});
  InterpretationOptions options;
  options.sensor = Eigen::Vector3d(0, 0, 2.5);
  EXPECT_EQ(interpretPlanes(planes, {}, pcl6d::bookRules(), options).labels,
            Labels{"floor"});
  options.sensor = Eigen::Vector3d(0, 0, -1.5);
  EXPECT_EQ(interpretPlanes(planes, {}, pcl6d::bookRules(), options).labels,
            Labels{"ceiling"});
  EXPECT_EQ(pcl6d::interpretPlanes(planes, {Eigen::Vector3d(0, 0, -1)}).labels,
            Labels{"ceiling"});
}

TEST(Interpretation, WithoutSidesTheLowerOfTwoLevelPlanesIsTheFloor)
{
  const auto room = BoxRoom().planes();
  EXPECT_EQ(interpretPlanes(planesOf(room), {}).labels, labelsOf(room));
}

TEST(Interpretation, EachStoreyHasItsOwnFloorAndCeiling)
{
  const auto planes = house(3);
  const auto found = interpreted(planes);
  EXPECT_EQ(found.labels, labelsOf(planes));
  ASSERT_EQ(found.storeys.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.storeys[i].floor.value(), 3.0 * i, 1e-12);
    EXPECT_NEAR(found.storeys[i].ceiling.value(), 3.0 * i + 2.6, 1e-12);
  }
  for (std::size_t i = 0; i < planes.size(); ++i)
    EXPECT_EQ(found.storey_of[i], i / 9) << i;
}

TEST(Interpretation, AWallThroughTwoStoreysIsAWallOfBoth)
{
  auto planes = house(2);
  planes.push_back(rectangle("wall", {0, -2.2, 2.8}, 2.5 * kX, -2.8 * kUp)); // outside
  EXPECT_EQ(interpreted(planes).labels, labelsOf(planes));
}

TEST(Interpretation, ASplitLevelRoomBesideIsAStoreyButAPlatformIsNot)
{
  auto planes = BoxRoom().planes();
  planes.push_back(rectangle("floor", {6.6, 0, 0.9}, 2 * kX, 2 * kY));
  planes.push_back(rectangle("none", {0, 0, 0.4}, 1.5 * kX, 1 * kY));
  const auto found = interpreted(planes);
  EXPECT_EQ(found.labels, labelsOf(planes));
  EXPECT_EQ(found.storeys.size(), 2u);
}

TEST(Interpretation, FurnitureIsNoPartOfTheBuilding)
{
  auto planes = BoxRoom().planes();
  planes.push_back(rectangle("none", {-2, 0, 0.95}, 0.5 * kY, 0.95 * kUp)); // wardrobe
  planes.push_back(rectangle("none", {-2.2, 0, 1.9}, 0.3 * kX, 0.5 * kY));  // its top
  planes.push_back(rectangle("none", {0, 1.2, 0.7}, 0.35 * kY, 0.6 * kX));  // under it
  EXPECT_EQ(interpreted(planes).labels, labelsOf(planes));
}

TEST(Interpretation, AnOpenDoorHangsAtAWall)
{
  auto planes = BoxRoom().planes();
  const Eigen::Vector3d leaf(0.2, 0.98, 0); // nearly across the wall at low y
  planes.push_back(
      rectangle("door", Eigen::Vector3d(1, -2, 1) + 0.46 * leaf, 0.46 * leaf, kUp));
  planes.push_back(rectangle("none", {-0.5, 0.3, 1}, 0.46 * kY, kUp)); // nowhere
  EXPECT_EQ(interpreted(planes).labels, labelsOf(planes));
}

TEST(Interpretation, FindsTheVerticalOfATiltedMap)
{
  const auto level = house(2);
  for (const double tilt : {0.0, 0.1, 0.4, 0.7}) {
    SCOPED_TRACE(tilt);
    const Eigen::Matrix3d R =
        pcl6d::rotationFromVector(tilt * Eigen::Vector3d(0.6, -0.8, 0));
    const auto planes = turned(level, R);
    InterpretationOptions options;
    options.up.reset();
    const auto found = interpreted(planes, options);
    EXPECT_EQ(found.labels, labelsOf(planes));
    EXPECT_LT((found.up - R * kUp).norm(), 1e-9);
    options.up = R * kUp;
    EXPECT_EQ(interpreted(planes, options).labels, labelsOf(planes));
  }
}

TEST(Interpretation, IsTheSameForAnyNumberOfThreads)
{
  const auto planes = house(4);
  InterpretationOptions options;
  options.num_threads = 1;
  const auto one = interpreted(planes, options);
  for (const unsigned int threads : {2u, 8u}) {
    options.num_threads = threads;
    const auto found = interpreted(planes, options);
    EXPECT_EQ(found.labels, one.labels);
    EXPECT_EQ(found.nodes, one.nodes);
    for (std::size_t i = 0; i < planes.size(); ++i)
      EXPECT_EQ(explanationText(found, i), explanationText(one, i));
  }
}

TEST(Interpretation, SolvesHundredsOfPlanes)
{
  const auto planes = house(40);
  const auto found = interpreted(planes);
  EXPECT_EQ(found.labels, labelsOf(planes));
  EXPECT_EQ(found.status, pcl6d::Status::kOk);
  EXPECT_LT(found.nodes, 2000u);
}

TEST(Interpretation, GivesTheBestSoFarAtTheNodeLimit)
{
  InterpretationOptions options;
  options.node_limit = 3;
  const auto found = interpreted(BoxRoom().planes(), options);
  EXPECT_EQ(found.status, pcl6d::Status::kMaxIterations);
  EXPECT_EQ(found.labels.size(), 9u);
}

TEST(Interpretation, SaysWhyALabelIsNotCarried)
{
  const auto room = BoxRoom().planes();
  const auto found = interpreted(room);
  const std::string table = explanationText(found, 7);
  EXPECT_EQ(table.find("plane 8: none: "), 0u) << table;
  EXPECT_NE(
      table.find("  not floor: not 'parallel and equalheight' beside floor (plane 1)"),
      std::string::npos)
      << table;
  EXPECT_NE(table.find("  not ceiling: seen from above"), std::string::npos) << table;
  EXPECT_EQ(found.explanations[7].rejections[0].partner, std::size_t{0});
  EXPECT_NE(explanationText(found, 8).find(
                "not wall: gap to ceiling 1.40 m, but must be in [any, 0.40]"),
            std::string::npos)
      << explanationText(found, 8);
  EXPECT_NE(explanationText(found, 6).find("wall (plane 5)"), std::string::npos);
}

TEST(Interpretation, IsWrittenAsJson)
{
  const auto room = BoxRoom().planes();
  const pcl6d::test::TempFolder folder;
  writeInterpretation(folder / "labels.json", interpreted(room));
  const auto json =
      nlohmann::json::parse(pcl6d::test::readText(folder / "labels.json"));
  ASSERT_EQ(json.at("planes").size(), 9u);
  EXPECT_EQ(json.at("planes").at(6).at("label"), "door");
  EXPECT_EQ(json.at("planes").at(7).at("rejected").at(0).at("partner"), 1);
  EXPECT_EQ(json.at("storeys").at(0).at("ceiling"), 2.6);
  EXPECT_THROW(pcl6d::writeInterpretation(folder / "no" / "labels.json", {}),
               pcl6d::IoFailed);
}

TEST(Interpretation, RefusesWhatBreaksARule)
{
  auto planes = planesOf(BoxRoom().planes());
  EXPECT_THROW(interpretPlanes(planes, {kUp}), pcl6d::BadArgument);
  InterpretationOptions options;
  options.node_limit = 0;
  EXPECT_THROW(interpretPlanes(planes, {}, pcl6d::bookRules(), options),
               pcl6d::BadArgument);
  options = {};
  options.up = Eigen::Vector3d::Zero();
  EXPECT_THROW(interpretPlanes(planes, {}, pcl6d::bookRules(), options),
               pcl6d::BadArgument);
  options = {};
  options.tolerances.angle = 2;
  EXPECT_THROW(interpretPlanes(planes, {}, pcl6d::bookRules(), options),
               pcl6d::BadArgument);
  planes[3].hull[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(interpretPlanes(planes, {}), pcl6d::BadArgument);
}
