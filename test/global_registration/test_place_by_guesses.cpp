// SPDX-License-Identifier: BSD-3-Clause
// What others have against the place of a scan: people who walked on between two scans of a room,
// and places that are wrong, with exact truth.
#include "placeable.h"

#include <pcl6d/global_registration/place_by_guesses.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

using pcl6d::KnownScan;
using pcl6d::PlaceNeeds;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::rejectionOfPose;
using pcl6d::test::kRayStep;
using pcl6d::test::PillarRoom;
using pcl6d::test::Placeable;
using Vector = Eigen::Vector3d;

namespace {
constexpr double kFineVoxel = 0.1; // [m] of which a person makes several patches

/** \return the room with people, 0.5 x 0.4 x 1.7 m, who stand at some places (x, y) */
PillarRoom
roomWith(const std::vector<Eigen::Vector2d>& people)
{
  PillarRoom room;
  for (const Eigen::Vector2d& at : people)
    room.pillars.emplace_back(Vector(at.x() - 0.25, at.y() - 0.2, -1),
                              Vector(at.x() + 0.25, at.y() + 0.2, 0.7));
  return room;
}

/** Two scans of a room, between which people about the scanner walked on, each its own way. */
struct AmongPeople {
  AmongPeople()
  {
    Random random(5);
    scans.add(roomWith({{1.6, 0.8}, {-1.2, 0.4}, {0.4, 1.2}})
                  .scan(T_world_first, random, kRayStep),
              kFineVoxel);
    scans.add(roomWith({{2.4, -0.4}, {-0.6, -1.6}, {-1.5, 1.2}})
                  .scan(T_world_second, random, kRayStep),
              kFineVoxel);
  }

  pcl6d::Rejection
  rejection(PlaceNeeds needs, const Vector& off = Vector::Zero()) const
  {
    return rejectionOfPose(scans[1],
                           {KnownScan{&scans[0], T_world_first}},
                           Eigen::Translation3d(off) * T_world_second,
                           needs);
  }

  Eigen::Isometry3d T_world_first = poseFromEuler({0, -0.4, 0}, {0, 0, 0.5});
  Eigen::Isometry3d T_world_second = poseFromEuler({0.9, -0.1, 0}, {0, 0, 0.3});
  Placeable scans;
};
} // namespace

TEST(RejectionOfPose, IsNotMadeByPeopleWhereAScanWasExpected)
{
  const AmongPeople run;
  EXPECT_FALSE(run.rejection(PlaceNeeds::kConfirmedAsExpected));
  EXPECT_EQ(run.rejection(PlaceNeeds::kConfirmed).reason,
            pcl6d::RejectReason::kNoConsistentLink)
      << "a place found anywhere needs more";
  EXPECT_TRUE(run.rejection(PlaceNeeds::kConnected));
}

TEST(RejectionOfPose, IsMadeToWrongPlacesWhereverAScanWasExpected)
{
  const AmongPeople run;
  for (const Vector& off : {Vector(0.5, 0, 0), Vector(0, -1, 0), Vector(-2, 0.5, 0)})
    EXPECT_TRUE(run.rejection(PlaceNeeds::kConfirmedAsExpected, off))
        << off.transpose();
}

TEST(RejectionOfPose, IsMadeWhereThereIsNothingToSee)
{
  const AmongPeople run;
  EXPECT_TRUE(run.rejection(PlaceNeeds::kConfirmedAsExpected, Vector(100, 0, 0)));
  EXPECT_FALSE(run.rejection(PlaceNeeds::kNoContradiction, Vector(100, 0, 0)));
}
