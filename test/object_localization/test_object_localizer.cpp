// SPDX-License-Identifier: BSD-3-Clause
// Upright objects of the store in a simulated room, at places that are known.
#include "object_localization/placed_objects.h"
#include "support/bits.h"
#include "support/constants.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

using pcl6d::test::kDegree;

namespace pcl6d {
namespace {
using namespace test;

/** \return how far the middle of the model's box is from its true place [m] */
double
shiftOf(const LocalizedObject& object,
        const ObjectModel& model,
        const Eigen::Isometry3d& truth)
{
  const Eigen::Vector3d middle = model.box().center();
  return (object.T_scene_object * middle - truth * middle).norm();
}

double
turnOf(const LocalizedObject& object, const Eigen::Isometry3d& truth)
{
  return rotationAngle(object.T_scene_object.linear().transpose() * truth.linear());
}
} // namespace

TEST(ObjectLocalizer, FindsAChairWhereItStands)
{
  const StoredModel chair = stored("chair");
  for (const auto& truth : {standing(2, 0.3, 0.6)}) {
    Room room;
    room.add(chair.mesh, inRoom(truth));
    const auto found = locate(chair.model, room.scan());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].object_class, "chair");
    EXPECT_EQ(found[0].status, Status::kOk);
    EXPECT_LT(shiftOf(found[0], chair.model, truth), 0.005);
    EXPECT_LT(turnOf(found[0], truth), 1 * kDegree);
    EXPECT_GT(found[0].visible_fraction, 0.8);
    EXPECT_GT(found[0].score, 0.7);
    EXPECT_LE(found[0].score, found[0].visible_fraction);
    EXPECT_LT(found[0].rms, 0.005);
  }
}

TEST(ObjectLocalizer, GivesThePointsThatAreOnIt)
{
  const StoredModel chair = stored("chair");
  const Eigen::Isometry3d truth = standing(1.8, 0, 2);
  Room room;
  room.add(chair.mesh, inRoom(truth));
  const Points points = room.scan();
  const auto found = locate(chair.model, points);
  ASSERT_EQ(found.size(), 1u);
  Eigen::AlignedBox3d box = chair.model.box();
  const Eigen::Vector3d rim = Eigen::Vector3d::Constant(0.02);
  box.extend(box.min() - rim);
  box.extend(box.max() + rim);
  std::size_t inside = 0;
  for (const auto& p : points)
    inside +=
        box.contains(truth.inverse() * p.cast<double>()) && p.z() > -kHeight + 0.02 ? 1
                                                                                    : 0;
  for (const auto place : found[0].points)
    EXPECT_TRUE(box.contains(truth.inverse() * points[place].cast<double>()));
  EXPECT_GT(found[0].points.size(), 0.8 * static_cast<double>(inside));
}

TEST(ObjectLocalizer, TellsHowPreciseItIs)
{
  const StoredModel chair = stored("chair");
  Room room;
  room.add(chair.mesh, inRoom(standing(2, 0, 0.4)));
  const auto found = locate(chair.model, room.scan(0.01));
  ASSERT_EQ(found.size(), 1u);
  ASSERT_TRUE(found[0].covariance);
  const PoseCovariance& covariance = *found[0].covariance;
  EXPECT_EQ(covariance, covariance.transpose());
  const Eigen::SelfAdjointEigenSolver<PoseCovariance> solver(covariance);
  EXPECT_GT(solver.eigenvalues().minCoeff(), 0);
  for (int i = 0; i < 6; ++i) {
    EXPECT_GT(std::sqrt(covariance(i, i)), 1e-4) << i;
    EXPECT_LT(std::sqrt(covariance(i, i)), 0.02) << i; // [m], [rad]
  }
}

TEST(ObjectLocalizer, FindsNothingInARoomWithoutIt)
{
  const Points points = Room().scan(0.01);
  for (const char* const name : {"box", "chair", "person"})
    EXPECT_TRUE(locate(stored(name).model, points).empty()) << name;
}

TEST(ObjectLocalizer, DoesNotTakeABoxOfAnotherSizeForIt)
{
  const ObjectModel box = stored("box").model; // 0.4 m x 0.6 m x 0.45 m
  for (const auto& size :
       {Eigen::Vector3d(0.4, 0.6, 0.8), Eigen::Vector3d(0.7, 0.9, 0.45)}) {
    Room room;
    room.addBlock({1.5, -0.5, 0}, {1.5 + size.x(), -0.5 + size.y(), size.z()});
    EXPECT_TRUE(locate(box, room.scan()).empty()) << size.transpose();
  }
}

TEST(ObjectLocalizer, SaysThatTheHeadingOfARoundObjectMeansNothing)
{
  const StoredModel bin = stored("bin");
  const Eigen::Isometry3d truth = standing(1.5, 0.5, 1.2);
  Room room;
  room.add(bin.mesh, inRoom(truth));
  const auto found = locate(bin.model, room.scan());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].status, Status::kRankDeficient);
  EXPECT_FALSE(found[0].covariance);
  const EulerAngles angles = eulerFromRotation(found[0].T_scene_object.linear());
  EXPECT_NEAR(angles.yaw, 0, 0.001);
  EXPECT_LT(std::hypot(angles.roll, angles.pitch), 2 * kDegree);
  EXPECT_LT(shiftOf(found[0], bin.model, truth), 0.01);
}

TEST(ObjectLocalizer, KeepsTwoChairsSideBySideApart)
{
  const StoredModel chair = stored("chair");
  const Eigen::Isometry3d truths[] = {standing(2, 0.3, M_PI), standing(2, -0.3, M_PI)};
  Room room;
  for (const auto& truth : truths)
    room.add(chair.mesh, inRoom(truth));
  const auto found = locate(chair.model, room.scan());
  ASSERT_EQ(found.size(), 2u);
  for (const auto& truth : truths) {
    const bool first = shiftOf(found[0], chair.model, truth) < 0.3;
    const LocalizedObject& object = found[first ? 0 : 1];
    EXPECT_LT(shiftOf(object, chair.model, truth), 0.01);
    EXPECT_LT(turnOf(object, truth), 1.5 * kDegree);
  }
}

TEST(ObjectLocalizer, FindsWhatIsPartlyHidden)
{
  const StoredModel chair = stored("chair");
  const Eigen::Isometry3d truth = standing(2.2, 0, 2.2);
  Room room;
  room.add(chair.mesh, inRoom(truth));
  const auto whole = locate(chair.model, room.scan());
  room.addBlock({1.2, -0.5, 0}, {1.22, -0.03, 1.4}); // a board before one side of it
  const auto found = locate(chair.model, room.scan());
  ASSERT_EQ(whole.size(), 1u);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(shiftOf(found[0], chair.model, truth), 0.02);
  EXPECT_LT(turnOf(found[0], truth), 3 * kDegree);
  EXPECT_LT(found[0].visible_fraction, 0.85 * whole[0].visible_fraction);
  EXPECT_LT(found[0].points.size(), whole[0].points.size());
}

TEST(ObjectLocalizer, TurnsWithTheScan)
{
  const StoredModel chair = stored("chair");
  Room room;
  room.add(chair.mesh, inRoom(standing(2, 0.3, 0.6)));
  const Points points = room.scan(0.01);
  const Eigen::Isometry3d turn = planarPose(0, 0, 0.5);
  const auto before = locate(chair.model, points);
  const auto after = locate(chair.model, transformed(points, turn));
  ASSERT_EQ(before.size(), 1u);
  ASSERT_EQ(after.size(), 1u);
  EXPECT_LT(shiftOf(after[0], chair.model, turn * before[0].T_scene_object), 0.003);
  EXPECT_LT(turnOf(after[0], turn * before[0].T_scene_object), 0.5 * kDegree);
}

TEST(ObjectLocalizer, GivesTheSameBitsForAnyNumberOfThreads)
{
  const StoredModel chair = stored("chair");
  Room room;
  room.add(chair.mesh, inRoom(standing(2, 0.3, 0.6)));
  const Points points = room.scan(0.01);
  const auto one = locate(chair.model, points, 1);
  ASSERT_EQ(one.size(), 1u);
  for (const unsigned int threads : {2u, 8u}) {
    const auto several = locate(chair.model, points, threads);
    ASSERT_EQ(several.size(), 1u);
    EXPECT_TRUE(sameBits(several[0].T_scene_object, one[0].T_scene_object));
    EXPECT_TRUE(sameBits(*several[0].covariance, *one[0].covariance));
    EXPECT_EQ(several[0].score, one[0].score);
    EXPECT_EQ(several[0].points, one[0].points);
  }
}

} // namespace pcl6d
