// SPDX-License-Identifier: BSD-3-Clause
// Loops of a drive whose poses have drifted: from room to room and back to the first one.
#include "drive/descriptor_tree.h"
#include "placeable.h"
#include "support/bits.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/drive_loops.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {
using pcl6d::BadArgument;
using pcl6d::closeDriveLoops;
using pcl6d::distanceBetween;
using pcl6d::DriveLoop;
using pcl6d::DriveLoopOptions;
using pcl6d::DriveLoops;
using pcl6d::mayHoldDriveLoops;
using pcl6d::PlaceableScan;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::global_registration::describePlace;
using pcl6d::global_registration::DescriptorTree;
using pcl6d::global_registration::distanceOf;
using pcl6d::global_registration::PlaceDescriptor;
using pcl6d::test::kPlaceTol;
using pcl6d::test::kRayStep;
using pcl6d::test::kTurnTol;
using pcl6d::test::PillarRoom;
using pcl6d::test::Placeable;
using pcl6d::test::sameBits;
using Vector = Eigen::Vector3d;

constexpr double kBetweenRooms = 25; // [m]

/** Rooms that differ in their walls and pillars. */
PillarRoom
roomOf(std::size_t number)
{
  const auto k = static_cast<double>(number);
  PillarRoom room;
  room.walls = {Vector(-3 - 0.5 * k, -4 + 0.3 * k, -1),
                Vector(4 - 0.2 * k, 3 + 0.6 * k, 1.4)};
  room.pillars = {{Vector(-2, 1 + 0.2 * k, -1), Vector(-1.5, 1.6 + 0.2 * k, 1.4)},
                  {Vector(1.5, -2 - 0.1 * k, -1), Vector(2.3, -1.4 - 0.1 * k, 0.4)}};
  if (number % 2 == 1)
    room.pillars.push_back({Vector(-2.5, -2.5, -1), Vector(-1.6, -1.9, 1.4)});
  return room;
}

/** A drive through rooms, three scans in each. */
struct RoomDrive {
  explicit RoomDrive(const std::vector<std::size_t>& rooms)
  {
    Random random(5);
    for (std::size_t visit = 0; visit < rooms.size(); ++visit)
      for (int scan = 0; scan < 3; ++scan) {
        const auto v = static_cast<double>(visit);
        const Eigen::Isometry3d inside =
            poseFromEuler({-0.8 + 0.6 * scan, 0.3 * scan - 0.05 * v, 0},
                          {0, 0, 0.5 * scan + 0.7 * v});
        scans.add(roomOf(rooms[visit]).scan(inside, random, kRayStep, 0.005));
        const auto room = static_cast<double>(rooms[visit]);
        truth.push_back(Eigen::Translation3d(kBetweenRooms * room, 0, 0) * inside);
      }
    drifted.push_back(truth[0]);
    for (std::size_t i = 1; i < truth.size(); ++i) {
      Eigen::Isometry3d step = truth[i - 1].inverse() * truth[i];
      const double way = step.translation().norm();
      drifted.push_back(drifted.back() * step *
                        poseFromEuler({0, 0, 0}, {0, 0, 0.0006 * way}));
    }
  }
  Placeable scans;
  std::vector<Eigen::Isometry3d> truth, drifted;
};

/** Through five rooms and back to the first. */
const RoomDrive&
roundTrip()
{
  static const RoomDrive drive({0, 1, 2, 3, 4, 0});
  return drive;
}

double
errorOf(const std::vector<Eigen::Isometry3d>& poses,
        const RoomDrive& drive,
        std::size_t i)
{
  return distanceBetween(poses[0].inverse() * poses[i],
                         drive.truth[0].inverse() * drive.truth[i])
      .translation;
}
} // namespace

TEST(DriveLoops, AReturnThatTheDriftHidesIsFoundAndClosed)
{
  const RoomDrive& drive = roundTrip();
  const std::size_t last = drive.truth.size() - 1;
  ASSERT_GT(errorOf(drive.drifted, drive, last), 3);
  const DriveLoops found = closeDriveLoops(drive.scans.all(), drive.drifted);
  ASSERT_FALSE(found.loops.empty());
  for (const DriveLoop& loop : found.loops) {
    EXPECT_TRUE(loop.counts);
    const auto off = distanceBetween(
        drive.truth[loop.from].inverse() * drive.truth[loop.to], loop.T_from_to);
    EXPECT_LT(off.translation, kPlaceTol);
    EXPECT_LT(off.rotation, kTurnTol);
  }
  EXPECT_LT(errorOf(found.poses, drive, last), 3 * kPlaceTol);
  EXPECT_LT(errorOf(found.poses, drive, last - 1), 3 * kPlaceTol);
}

TEST(DriveLoops, ADriveWithoutReturnKeepsItsPosesToTheLastBit)
{
  const RoomDrive drive({0, 1, 2, 3});
  DriveLoopOptions options;
  options.max_drift = 1;
  const DriveLoops found = closeDriveLoops(drive.scans.all(), drive.drifted, options);
  EXPECT_TRUE(found.loops.empty());
  for (std::size_t i = 0; i < drive.drifted.size(); ++i)
    EXPECT_TRUE(sameBits(found.poses[i], drive.drifted[i]));
}

TEST(DriveLoops, WhatDriftCannotExplainIsNotSearched)
{
  const RoomDrive& drive = roundTrip();
  DriveLoopOptions options;
  options.max_drift = 1e-3;
  const DriveLoops found = closeDriveLoops(drive.scans.all(), drive.drifted, options);
  EXPECT_EQ(found.searched, 0u);
  EXPECT_TRUE(found.loops.empty());
}

TEST(DriveLoops, AnyNumberOfThreadsGivesTheSameBits)
{
  const RoomDrive& drive = roundTrip();
  DriveLoopOptions one, two;
  one.num_threads = 1;
  two.num_threads = 2;
  const DriveLoops a = closeDriveLoops(drive.scans.all(), drive.drifted, one);
  const DriveLoops b = closeDriveLoops(drive.scans.all(), drive.drifted, two);
  ASSERT_EQ(a.loops.size(), b.loops.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    EXPECT_TRUE(sameBits(a.poses[i], b.poses[i]));
}

TEST(DriveLoops, PosesTellWhetherThereMayBeLoops)
{
  const RoomDrive& drive = roundTrip();
  DriveLoopOptions options;
  EXPECT_TRUE(mayHoldDriveLoops(drive.drifted, 3, options));
  options.max_drift = 1e-3;
  EXPECT_FALSE(mayHoldDriveLoops(drive.drifted, 3, options)) << "drifts too little";
  options.near = 60; // beyond, the way is not long enough for a loop
  EXPECT_FALSE(mayHoldDriveLoops(drive.drifted, 3, options)) << "found by the poses";
  EXPECT_FALSE(mayHoldDriveLoops({}, 3));
}

TEST(DriveLoops, RefuseWhatBreaksARule)
{
  const RoomDrive& drive = roundTrip();
  EXPECT_THROW(closeDriveLoops(drive.scans.all(), {}), BadArgument);
  DriveLoopOptions options;
  options.max_drift = 0;
  EXPECT_THROW(options.validate(), BadArgument);
  options = {};
  options.candidates = 0;
  EXPECT_THROW(options.validate(), BadArgument);
  options = {};
  options.near = -1;
  EXPECT_THROW(options.validate(), BadArgument);
  options = {};
  options.max_failures = 0;
  EXPECT_THROW(options.validate(), BadArgument);
  EXPECT_TRUE(closeDriveLoops({}, {}).loops.empty());
}

TEST(PlaceDescriptor, IsNearerForTheSameRoomThanForAnyOther)
{
  const RoomDrive& drive = roundTrip();
  std::vector<PlaceDescriptor> descriptors;
  for (const PlaceableScan& scan : drive.scans.all())
    descriptors.push_back(describePlace(scan, 3));
  for (std::size_t i = 15; i < 18; ++i) { // back in the first room, turned
    double same = 10, other = 10;
    for (std::size_t j = 0; j < 15; ++j)
      (j < 3 ? same : other) =
          std::min(j < 3 ? same : other, distanceOf(descriptors[i], descriptors[j]));
    EXPECT_LT(same, other) << i;
  }
}

TEST(PlaceDescriptor, DoesNotDependOnTheHeading)
{
  Random random(3);
  Placeable scans;
  for (const double yaw : {0.0, 1.1, 2.9})
    scans.add(roomOf(2).scan(
        poseFromEuler({0.2, 0.1, 0}, {0, 0, yaw}), random, kRayStep, 0.005));
  scans.add(
      roomOf(3).scan(poseFromEuler({0.2, 0.1, 0}, {0, 0, 0}), random, kRayStep, 0.005));
  const PlaceDescriptor first = describePlace(scans[0], 3);
  const double other = distanceOf(first, describePlace(scans[3], 3));
  EXPECT_LT(distanceOf(first, describePlace(scans[1], 3)), other / 2);
  EXPECT_LT(distanceOf(first, describePlace(scans[2], 3)), other / 2);
}

TEST(DescriptorTree, FindsTheNearestAsLookingAtAllDoes)
{
  Random random(8);
  std::vector<PlaceDescriptor> descriptors;
  for (int i = 0; i < 200; ++i) {
    PlaceDescriptor one;
    for (int k = 0; k < 5; ++k)
      one.push_back(i % 17 == 3 ? 0.5 : random.uniform(0, 1)); // several alike
    descriptors.push_back(one);
  }
  const DescriptorTree tree(descriptors);
  for (std::size_t query = 0; query < descriptors.size(); ++query) {
    const auto accepts = [query](std::size_t i) { return i % 3 != query % 3; };
    std::vector<DescriptorTree::Found> all;
    for (std::size_t i = 0; i < descriptors.size(); ++i)
      if (i != query && accepts(i))
        all.emplace_back(distanceOf(descriptors[query], descriptors[i]), i);
    std::sort(all.begin(), all.end());
    all.resize(4);
    EXPECT_EQ(tree.nearest(query, 4, accepts), all) << query;
  }
}
