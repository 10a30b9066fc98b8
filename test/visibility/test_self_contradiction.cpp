// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/visibility/sight_evidence.h>

using pcl6d::Points;
using pcl6d::Random;
using pcl6d::selfContradiction;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::PillarRoom;
using Isometry = Eigen::Isometry3d;

TEST(SelfContradiction, IsNoneInAScan)
{
  Random random(3);
  const PillarRoom room;
  for (const double step : {0.02, 0.05})
    for (const double sigma : {0.0, 0.005, 0.02}) {
      const Points scan = room.scan(Isometry::Identity(), random, step, sigma);
      EXPECT_LT(selfContradiction(scan, {0, 0, 0}, sigma), 0.001);
    }
}

TEST(SelfContradiction, RisesWithSinglePointsInTheAir)
{
  // Points that are alone: each where the rays around went on.
  Random random(4);
  Points scan = PillarRoom().scan(Isometry::Identity(), random, 0.02);
  Points spoilt;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    spoilt.push_back(scan[i]);
    if (i % 20 == 1)
      spoilt.push_back(0.5F * scan[(i * 7919) % scan.size()]);
  }
  EXPECT_GT(selfContradiction(spoilt, {0, 0, 0}, 0.005), 0.005);
}

TEST(SelfContradiction, HardlySeesASecondOrigin)
{
  // Each point lies on a surface, and the rays of neither origin go through surfaces:
  // what is hidden from one is measured behind another surface. That limit is documented.
  Random random(3);
  const PillarRoom room;
  const Isometry other(Eigen::Translation3d(3, 0, 0));
  const Points a = room.scan(Isometry::Identity(), random, 0.02);
  const Points b = pcl6d::transformed(room.scan(other, random, 0.02), other);
  Points merged;
  for (std::size_t i = 0; i < a.size(); ++i) {
    merged.push_back(a[i]);
    merged.push_back(b[i]);
  }
  EXPECT_LT(selfContradiction(merged, {0, 0, 0}, 0.005), 0.01);
}

TEST(SelfContradiction, LooksAtFinitePointsOnly)
{
  // Every second beam without an echo: the halves must not be all and nothing.
  Random random(3);
  const Points scan = PillarRoom().scan(Isometry::Identity(), random, 0.02);
  Points shaken;
  for (std::size_t i = 0; i < scan.size(); ++i)
    shaken.push_back(scan[i] * static_cast<float>(random.uniform(0.3, 1)));
  Points holes;
  for (const auto& p : shaken) {
    holes.push_back(p);
    holes.push_back({kNan, kNan, kNan});
  }
  EXPECT_EQ(selfContradiction(holes, {0, 0, 0}, 0.005),
            selfContradiction(shaken, {0, 0, 0}, 0.005));
  EXPECT_EQ(selfContradiction({}, {0, 0, 0}, 0.005), 0);
  EXPECT_NE(badArgumentOf([&] { selfContradiction(scan, {0, 0, 0}, -1); }), "");
}
