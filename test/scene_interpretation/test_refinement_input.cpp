// SPDX-License-Identifier: BSD-3-Clause
/* What refineModel() makes of little or wrong input, and its report. */
#include "support/constants.h"
#include "support/plane_model.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/scene_interpretation/model_refinement.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace {
using pcl6d::Random;
using pcl6d::RefinementOptions;
using pcl6d::test::BoxRoom;
using pcl6d::test::kDegree;
using pcl6d::test::kUp;
using pcl6d::test::kX;
using pcl6d::test::kY;
using pcl6d::test::modelOf;
using pcl6d::test::PlaneModel;
using pcl6d::test::rectangle;

} // namespace

TEST(RefineModel, OfOneFloorTurnsNothing)
{
  Random random(10);
  const PlaneModel model =
      modelOf({rectangle("floor", {0, 0, 1}, kX, kY)}, {0.01, 0.1 * kDegree}, random);
  const auto refined = refineModel(model.planes, model.points);
  EXPECT_EQ(refined.status, pcl6d::Status::kOk);
  EXPECT_LT(refined.changes[0].turn, 1e-9);
  RefinementOptions options;
  options.up = kUp;
  EXPECT_GT(refineModel(model.planes, model.points, options).changes[0].turn, 1e-4);
}

TEST(RefineModel, OfNothingLabelledSaysSo)
{
  Random random(11);
  PlaneModel model = modelOf({rectangle("none", {0, 0, 1}, kX, kY)}, {}, random);
  EXPECT_EQ(refineModel(model.planes, model.points).status,
            pcl6d::Status::kRankDeficient);
  EXPECT_EQ(pcl6d::refineModel({}, {}).status, pcl6d::Status::kRankDeficient);
  model.planes[0].plane.label = "floor";
  model.planes[0].points.assign(5, 0); // one place: no plane
  EXPECT_EQ(refineModel(model.planes, model.points).status,
            pcl6d::Status::kRankDeficient);
}

TEST(RefineModel, RefusesWhatBreaksARule)
{
  Random random(12);
  PlaneModel model = modelOf({rectangle("floor", {0, 0, 1}, kX, kY)}, {}, random);
  RefinementOptions options;
  options.max_turn = 0;
  EXPECT_THROW(refineModel(model.planes, model.points, options), pcl6d::BadArgument);
  options = {};
  options.up = Eigen::Vector3d::Zero();
  EXPECT_THROW(refineModel(model.planes, model.points, options), pcl6d::BadArgument);
  model.points.pop_back();
  EXPECT_THROW(refineModel(model.planes, model.points), pcl6d::BadArgument);
}

TEST(RefineModel, IsReportedAsJson)
{
  Random random(13);
  const PlaneModel model = modelOf(BoxRoom().planes(), {0.01, 0.1 * kDegree}, random);
  const pcl6d::test::TempFolder folder;
  writeRefinement(folder / "refinement.json", refineModel(model.planes, model.points));
  const auto json =
      nlohmann::json::parse(pcl6d::test::readText(folder / "refinement.json"));
  ASSERT_EQ(json.at("planes").size(), 9u);
  EXPECT_EQ(json.at("planes").at(0).at("kind"), "horizontal");
  EXPECT_EQ(json.at("planes").at(2).at("frame"), 1);
  EXPECT_EQ(json.at("planes").at(8).at("kind"), "unchanged");
}
