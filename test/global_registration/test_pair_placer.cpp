// SPDX-License-Identifier: BSD-3-Clause
// Two scans made ready, placed and matched finely: the compiled core of GlobalRegistration.
#include "placeable.h"
#include "support/bits.h"
#include "support/points.h"
#include "verification/verified_rooms.h"

#include <pcl6d/global_registration/pair_placer.h>
#include <pcl6d/verification/prepared_scans.h>

#include <gtest/gtest.h>

using pcl6d::distanceBetween;
using pcl6d::MotionSize;
using pcl6d::PairPlacement;
using pcl6d::PairPlacer;
using pcl6d::PairPlacerOptions;
using pcl6d::PlaceAnswer;
using pcl6d::poseFromEuler;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kFineTol;
using pcl6d::test::kFineTurn;
using pcl6d::test::sameBits;
using pcl6d::test::scannedPair;
using pcl6d::test::ScannedPair;

namespace {
// Matching leaves a twentieth of a voxel of 0.15 m, and the same at walls 5 m away.

} // namespace

TEST(PairPlacer, GivesTheSameBitsForAnyNumberOfThreads)
{
  PairPlacerOptions options;
  options.search.num_threads = 1;
  PairPlacer alone;
  alone.setOptions(options);
  const PairPlacement one = alone.place(scannedPair().first, scannedPair().second);
  for (const unsigned int threads : {2u, 8u}) {
    options.search.num_threads = threads;
    PairPlacer several;
    several.setOptions(options);
    const PairPlacement many = several.place(scannedPair().first, scannedPair().second);
    EXPECT_TRUE(sameBits(many.T_target_source, one.T_target_source));
  }
}

TEST(PairPlacer, SaysWhichScanHasTooFewPoints)
{
  PairPlacer placer;
  const PairPlacement found = placer.place(scannedPair().first, {{1, 2, 3}});
  EXPECT_EQ(found.result.answer, PlaceAnswer::kNone);
  EXPECT_NE(found.result.rejection.text.find("the source"), std::string::npos)
      << found.result.rejection;
  EXPECT_EQ(placer.place(scannedPair().first, scannedPair().second).result.answer,
            PlaceAnswer::kUnique)
      << "the next one is placed";
}

TEST(RefinePlace, StaysWhereMatchingFails)
{
  pcl6d::PreparedScans scans(2, pcl6d::deriveScanParameters({}, {scannedPair().first}));
  scans.set(0, scannedPair().first, "first");
  scans.set(1, scannedPair().second, "second");
  const pcl6d::PlaceableScan first(scans.scans()[0]), second(scans.scans()[1]);
  const Eigen::Isometry3d far = poseFromEuler({300, 0, 0}, {0, 0, 1});
  EXPECT_TRUE(sameBits(refinePlace(first, second, far), far));
  const Eigen::Isometry3d near =
      scannedPair().T_first_second * poseFromEuler({0.03, -0.02, 0.01}, {0, 0, 0.01});
  const MotionSize off =
      distanceBetween(scannedPair().T_first_second, refinePlace(first, second, near));
  EXPECT_LT(off.translation, kFineTol);
  EXPECT_LT(off.rotation, kFineTurn);
  Eigen::Isometry3d stretched = near;
  stretched.linear() *= 2;
  EXPECT_NE(badArgumentOf([&] { refinePlace(first, second, stretched); }), "");
}
