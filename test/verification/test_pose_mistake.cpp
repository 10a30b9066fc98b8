// SPDX-License-Identifier: BSD-3-Clause
// Usual mistakes of poses, in words.
#include "support/points.h"
#include "verified_rooms.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/verification/pose_mistake.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using pcl6d::likelyPoseMistake;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::test::PillarRoom;
using pcl6d::test::VerifiedScans;

namespace {
using Poses = std::vector<Eigen::Isometry3d>;

/** A drive through a room with nothing alike in it. */
Poses
straightWay()
{
  Poses poses;
  for (int i = 0; i < 5; ++i)
    poses.push_back(pcl6d::poseFromEuler({-2.0 + i, -1.5 + 0.7 * i, 0.1 * i},
                                         {0.02 * i, -0.03 * i, 0.4 * i}));
  return poses;
}

VerifiedScans
scansOf(bool is_mirrored = false)
{
  PillarRoom room;
  room.pillars.emplace_back(Eigen::Vector3d(3.5, -4, -1), Eigen::Vector3d(5, -3.4, 2));
  room.pillars.emplace_back(Eigen::Vector3d(-5, 0, -1), Eigen::Vector3d(-4.4, 1.2, 2));
  room.pillars.emplace_back(Eigen::Vector3d(0, 3.4, -1), Eigen::Vector3d(1.5, 4, 1));
  VerifiedScans scans;
  Random random(4);
  for (const auto& pose : straightWay()) {
    Points points = room.scan(pose, random, 0.04, 0.005);
    if (is_mirrored)
      for (auto& p : points)
        p.y() = -p.y();
    scans.add(points);
  }
  return scans;
}

bool
begins(const std::string& text, const std::string& with)
{
  return text.rfind(with, 0) == 0;
}
} // namespace

TEST(PoseMistake, IsNoneOfPosesThatAgree)
{
  EXPECT_EQ(likelyPoseMistake(scansOf().all(), straightWay()), "");
}

// Views of a floor agree at the right distance above the floor, wherever they lie on it: given poses
// that are wrong by their height agree nowhere, and every change of axes that mends the height would.
TEST(PoseMistake, IsNoneWhereSurfacesLeaveMotionsOpen)
{
  Random random(5);
  VerifiedScans scans;
  Poses poses;
  for (int i = 0; i < 5; ++i) {
    Points floor;
    for (int k = 0; k < 6000; ++k)
      floor.push_back(Eigen::Vector3d(random.uniform(-3, 3),
                                      random.uniform(-3, 3),
                                      -1 + 0.005 * random.normal())
                          .cast<float>());
    scans.add(floor);
    poses.push_back(pcl6d::poseFromEuler({0, 0, 0.8 * i}, {}));
  }
  EXPECT_EQ(likelyPoseMistake(scans.all(), poses), "");
}

TEST(PoseMistake, NamesTheUnit)
{
  const VerifiedScans scans = scansOf();
  const auto with = [&](double scale) {
    Poses poses = straightWay();
    for (auto& pose : poses)
      pose.translation() *= scale;
    return likelyPoseMistake(scans.all(), poses);
  };
  EXPECT_EQ(with(1 / 0.3048),
            "positions are in feet, scans in metres? Then 4 of 4 pairs of scans would "
            "agree, with the given poses: 0");
  EXPECT_PRED2(
      begins, with(1000), "positions are in millimetres, scans in metres? Then ");
  EXPECT_PRED2(begins, with(0.3048), "scans are in feet, positions in metres? Then ");
}

TEST(PoseMistake, NamesTurnedAxes)
{
  const Eigen::Isometry3d half_turn = pcl6d::poseFromEuler({0, 0, 0}, {0, 0, M_PI});
  Poses poses;
  for (const auto& pose : straightWay())
    poses.push_back(half_turn * pose * half_turn.inverse());
  EXPECT_PRED2(begins,
               likelyPoseMistake(scansOf().all(), poses),
               "axes of the poses are turned against the axes of the scans: x, y, z of "
               "the scans are (-x, -y, z) of the poses? Then ");
}

TEST(PoseMistake, NamesMirroredScans)
{
  EXPECT_PRED2(
      begins,
      likelyPoseMistake(scansOf(true).all(), straightWay()),
      "scans are mirrored against the poses (left-handed coordinates read as "
      "right-handed?): x, y, z of the scans are (x, -y, z) of the poses? Then ");
}

TEST(PoseMistake, IsNoneWhereNothingExplains)
{
  Poses poses = straightWay();
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].translation().x() += i % 2 == 0 ? 0.9 : -0.8;
  EXPECT_EQ(likelyPoseMistake(scansOf().all(), poses), "");
}

TEST(PoseMistake, OfFewOrEmptyScansIsNone)
{
  EXPECT_EQ(likelyPoseMistake({}, {}), "");
  VerifiedScans scans;
  scans.add({});
  EXPECT_EQ(likelyPoseMistake(scans.all(), Poses(1, straightWay()[0])), "");
  scans.add({{1, 2, 3}});
  EXPECT_EQ(likelyPoseMistake(scans.all(), Poses(2, straightWay()[0])), "");
  EXPECT_NE(pcl6d::test::badArgumentOf([&] {
              likelyPoseMistake(scans.all(), {});
            }).find("one per scan"),
            std::string::npos);
}
