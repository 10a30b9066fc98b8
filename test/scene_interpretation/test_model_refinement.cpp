// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/box_room.h"
#include "support/constants.h"
#include "support/plane_model.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/scene_interpretation/model_refinement.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {
using pcl6d::PlaneSegment;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::RefinedKind;
using pcl6d::RefinementOptions;
using pcl6d::test::BoxRoom;
using pcl6d::test::kDegree;
using pcl6d::test::kUp;
using pcl6d::test::kX;
using pcl6d::test::kY;
using pcl6d::test::modelOf;
using pcl6d::test::PlaneModel;
using pcl6d::test::rectangle;
using pcl6d::test::TruePlane;

constexpr double kExact = 1e-9; // [rad] of directions that are to be exact

// Root mean square distance [m] of the points of labelled planes to the true planes.
double
distanceTo(const std::vector<TruePlane>& truth,
           const PlaneModel& model,
           const Points& points)
{
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (const auto place : model.planes[i].points) {
      const double d = truth[i].plane.normal.dot(points[place].cast<double>()) -
                       truth[i].plane.offset;
      sum += truth[i].plane.label == "none" ? 0 : d * d;
      count += truth[i].plane.label == "none" ? 0 : 1;
    }
  return std::sqrt(sum / count);
}

double
missOfRightAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const double cosine = std::abs(a.dot(b));
  return std::min(cosine, a.cross(b).norm());
}

void
expectConsistent(const PlaneSegment& segment)
{
  const auto& plane = segment.plane;
  EXPECT_GE(plane.offset, 0);
  EXPECT_NEAR(plane.normal.norm(), 1, 1e-12);
  EXPECT_NEAR(missOfRightAngle(plane.normal, segment.seen_from), 0, 1e-12);
  for (const auto& corner : plane.hull)
    EXPECT_NEAR(plane.normal.dot(corner), plane.offset, 1e-9);
  for (const auto& ring : {plane.hull, segment.outline.at(0)}) {
    const Eigen::Vector3d area = (ring[1] - ring[0]).cross(ring[2] - ring[1]);
    EXPECT_GT(area.dot(plane.normal), 0); // counter-clockwise still
  }
}
} // namespace

TEST(RefineModel, MakesAManhattanRoomExact)
{
  Random random(1);
  const auto truth = turned(BoxRoom().planes(), pcl6d::rotationFromVector(0.4 * kUp));
  const PlaneModel model = modelOf(truth, {0.01, 0.1 * kDegree}, random);
  const auto refined = refineModel(model.planes, model.points);
  EXPECT_EQ(refined.status, pcl6d::Status::kOk);
  ASSERT_EQ(refined.headings.size(), 1u);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    SCOPED_TRACE(i);
    const bool is_free = truth[i].plane.label == "none";
    EXPECT_EQ(refined.changes[i].kind == RefinedKind::kUnchanged, is_free);
    if (is_free)
      continue;
    expectConsistent(refined.planes[i]);
    EXPECT_GT(refined.changes[i].turn, 0);
    EXPECT_LT(refined.changes[i].turn, 0.02);
    EXPECT_LT(refined.changes[i].largest_move, 0.05);
    EXPECT_LT(missOfRightAngle(refined.planes[i].plane.normal, refined.up), kExact);
    for (std::size_t j = 0; j < i; ++j)
      if (truth[j].plane.label != "none") {
        EXPECT_LT(missOfRightAngle(refined.planes[i].plane.normal,
                                   refined.planes[j].plane.normal),
                  kExact);
      }
  }
}

TEST(RefineModel, BringsPointsNearerToTheTruePlanes)
{
  Random random(2);
  const auto truth = BoxRoom().planes();
  RefinementOptions options;
  options.map_angle_error = 0.3 * kDegree;
  RefinementOptions turn_only = options;
  turn_only.project = false;
  double before = 0, turned = 0, projected = 0; // of all trials: single ones may differ
  for (int trial = 0; trial < 10; ++trial) {
    const PlaneModel model = modelOf(truth, {0.002, 0.3 * kDegree}, random);
    const Points turned_points =
        refineModel(model.planes, model.points, turn_only).points;
    const Points projected_points =
        refineModel(model.planes, model.points, options).points;
    before += distanceTo(truth, model, model.points);
    turned += distanceTo(truth, model, turned_points);
    projected += distanceTo(truth, model, projected_points);
  }
  EXPECT_LT(turned, 0.8 * before);
  EXPECT_LT(projected, turned);
}

TEST(RefineModel, FindsTheSmallestSumOfSquares)
{
  Random random(3);
  const auto truth = BoxRoom().planes();
  const PlaneModel model = modelOf(truth, {0.001, 0.1 * kDegree}, random);
  RefinementOptions options; // as the book: nothing but the noise of the points ...
  options.map_angle_error = options.map_position_error = 0;
  options.significance = 1000; // ... which takes 0.1 deg for very significant
  const auto refined = refineModel(model.planes, model.points, options);
  const auto cost = [&](const Eigen::Matrix3d& R) {
    double sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i].plane.label == "none")
        continue;
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const auto place : model.planes[i].points)
        mean += model.points[place].cast<double>() / 4000;
      for (const auto place : model.planes[i].points) {
        const Eigen::Vector3d p = model.points[place].cast<double>() - mean;
        const double d = (R * refined.planes[i].plane.normal).dot(p);
        sum += d * d;
      }
    }
    return sum;
  };
  const double smallest = cost(Eigen::Matrix3d::Identity());
  for (int axis = 0; axis < 3; ++axis)
    for (const double angle : {-3e-4, 3e-4}) // [rad], of a turn of the whole model
      EXPECT_GT(cost(pcl6d::rotationFromVector(angle * Eigen::Vector3d::Unit(axis))),
                smallest);
}

TEST(RefineModel, GivesEachManhattanWorldAFrame)
{
  Random random(4);
  auto truth = BoxRoom().planes();
  const Eigen::Vector3d along(std::cos(0.5), std::sin(0.5), 0);
  const Eigen::Vector3d across = kUp.cross(along);
  truth.push_back(rectangle("wall", {9, 0, 1.3}, 2 * along, 1.3 * kUp));
  truth.push_back(rectangle("wall", {9, 3, 1.3}, 2 * across, 1.3 * kUp));
  const PlaneModel model = modelOf(truth, {0.01, 0.1 * kDegree}, random);
  const auto refined = refineModel(model.planes, model.points);
  ASSERT_EQ(refined.headings.size(), 2u);
  for (const std::size_t i : {9u, 10u}) {
    EXPECT_EQ(refined.changes[i].kind, RefinedKind::kVertical);
    EXPECT_EQ(refined.changes[i].frame, 1u);
    EXPECT_LT(std::abs(refined.planes[i].plane.normal.dot(refined.up)), kExact);
  }
  EXPECT_LT(
      std::abs(refined.planes[9].plane.normal.dot(refined.planes[10].plane.normal)),
      kExact);
  EXPECT_NEAR(refined.headings[1].dot(refined.headings[0]),
              std::cos(0.5),
              0.01); // not pulled towards the first
}

TEST(RefineModel, LeavesAWallThatLeansForCertain)
{
  Random random(5);
  auto truth = BoxRoom().planes();
  const Eigen::Vector3d leaning(std::sin(2 * kDegree), 0, std::cos(2 * kDegree));
  truth[2] = rectangle("wall", {-2.5, 0, 1.3}, 2 * kY, 1.3 * leaning);
  const PlaneModel model = modelOf(truth, {0.01, 0.05 * kDegree}, random);
  const auto refined = refineModel(model.planes, model.points);
  EXPECT_EQ(refined.changes[2].kind, RefinedKind::kUnchanged);
  EXPECT_EQ(refined.changes[2].refusal.find("not made vertical: would turn by "), 0u)
      << refined.changes[2].refusal;
  EXPECT_EQ(refined.planes[2].plane.normal, model.planes[2].plane.normal);
  for (const auto place : model.planes[2].points)
    ASSERT_EQ(refined.points[place], model.points[place]);
  for (const std::size_t i : {0u, 1u, 3u, 4u, 5u, 6u})
    EXPECT_NE(refined.changes[i].kind, RefinedKind::kUnchanged) << i;
  RefinementOptions options;
  options.map_angle_error = 2 * kDegree; // a map so bent that it may well be upright
  EXPECT_EQ(refineModel(model.planes, model.points, options).changes[2].kind,
            RefinedKind::kVertical);
}

TEST(RefineModel, RefusesToMoveFar)
{
  Random random(6);
  const PlaneModel model = modelOf(BoxRoom().planes(), {0.01, 0.1 * kDegree}, random);
  RefinementOptions options;
  options.max_move = 1e-4;
  const auto refined = refineModel(model.planes, model.points, options);
  for (const auto& change : refined.changes) {
    EXPECT_LE(change.largest_move, options.max_move);
    if (change.kind == RefinedKind::kUnchanged && !change.refusal.empty()) {
      EXPECT_NE(change.refusal.find("would move by"), std::string::npos);
    }
  }
}

TEST(RefineModel, TakesTheVerticalThatIsGiven)
{
  Random random(7);
  const PlaneModel model = modelOf(BoxRoom().planes(), {0.01, 0.1 * kDegree}, random);
  RefinementOptions options;
  options.up = kUp;
  const auto refined = refineModel(model.planes, model.points, options);
  EXPECT_EQ(refined.up, kUp);
  EXPECT_NEAR(refined.planes[0].plane.normal.cross(kUp).norm(), 0, 1e-12);
  EXPECT_NEAR(refined.planes[2].plane.normal.dot(kUp), 0, kExact);
}

TEST(RefineModel, TurnsPointsAboutTheirCentroidAndProjectsThemIfAsked)
{
  Random random(8);
  const PlaneModel model = modelOf(BoxRoom().planes(), {0.01, 0.1 * kDegree}, random);
  RefinementOptions options;
  options.project = false;
  const auto turned = refineModel(model.planes, model.points, options);
  const auto projected = refineModel(model.planes, model.points);
  constexpr double kFloat = 1e-6; // [m] rounding of coordinates of a few metres
  for (std::size_t i = 0; i < 7; ++i) {
    const auto& plane = projected.planes[i].plane;
    Eigen::Vector3d before = Eigen::Vector3d::Zero(), after = before;
    double square = 0;
    for (const auto place : model.planes[i].points) {
      before += model.points[place].cast<double>() / 4000;
      after += turned.points[place].cast<double>() / 4000;
      const double d = plane.normal.dot(turned.points[place].cast<double>());
      square += (d - plane.offset) * (d - plane.offset) / 4000;
      EXPECT_NEAR(plane.normal.dot(projected.points[place].cast<double>()),
                  plane.offset,
                  kFloat);
    }
    EXPECT_LT((before - after).norm(), kFloat);
    EXPECT_NEAR(std::sqrt(square), turned.planes[i].plane.rms, kFloat);
    EXPECT_NEAR(turned.planes[i].plane.rms, 0.01, 0.0005);
    EXPECT_EQ(plane.rms, 0);
  }
  for (const std::size_t i : {7u, 8u}) // without a label
    for (const auto place : model.planes[i].points)
      ASSERT_EQ(projected.points[place], model.points[place]);
}

TEST(RefineModel, HasTheSameBitsForAnyNumberOfThreads)
{
  Random random(9);
  const PlaneModel model = modelOf(BoxRoom().planes(), {0.01, 0.1 * kDegree}, random);
  RefinementOptions options;
  options.num_threads = 1;
  const auto one = refineModel(model.planes, model.points, options);
  for (const unsigned int threads : {2u, 8u}) {
    options.num_threads = threads;
    const auto refined = refineModel(model.planes, model.points, options);
    EXPECT_TRUE(pcl6d::test::sameBits(refined.up, one.up));
    for (std::size_t i = 0; i < one.points.size(); ++i)
      ASSERT_TRUE(pcl6d::test::sameBits(refined.points[i], one.points[i]));
  }
}
