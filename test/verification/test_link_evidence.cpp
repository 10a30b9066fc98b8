// SPDX-License-Identifier: BSD-3-Clause
#include "judged.h"
#include "support/points.h"
#include "verified_rooms.h"

#include <pcl6d/verification/link_evidence.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using pcl6d::contradictionBackground;
using pcl6d::LinkEvidence;
using pcl6d::linkEvidence;
using pcl6d::LinkTestResult;
using pcl6d::LinkTrust;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::testLink;
using pcl6d::test::evaluated;
using pcl6d::test::kBackground;
using pcl6d::test::kNan;
using pcl6d::test::kRayStep;
using pcl6d::test::kVoxel;
using pcl6d::test::PillarRoom;
using pcl6d::test::ScannedPair;
using pcl6d::test::shifted;
using pcl6d::test::VerifiedScans;
using Vector = Eigen::Vector3d;

namespace {

LinkTestResult
testedAt(const VerifiedScans& scans, const Eigen::Isometry3d& T)
{
  return evaluated(linkEvidence(scans[0], scans[1], T));
}

/** A room with closets along its walls, none of which half a turn maps to another. */
PillarRoom
asymmetricRoom()
{
  PillarRoom room;
  room.pillars.emplace_back(Vector(3.5, -4, -1), Vector(5, -3.4, 2));
  room.pillars.emplace_back(Vector(-5, 0, -1), Vector(-4.4, 1.2, 2));
  room.pillars.emplace_back(Vector(0, 3.4, -1), Vector(1.5, 4, 1));
  room.pillars.emplace_back(Vector(-2.5, 2.2, -1), Vector(-1.9, 2.8, 2));
  room.pillars.emplace_back(Vector(2.2, 2.4, -1), Vector(2.8, 3, 2));
  room.pillars.emplace_back(Vector(-4.2, -2.6, -1), Vector(-3.6, -2, 2));
  return room;
}
} // namespace

TEST(LinkEvidence, OfATrueLinkIsGood)
{
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  const LinkEvidence evidence = linkEvidence(scans[0], scans[1], pair.T_first_second);
  EXPECT_GT(evidence.sight.patches, 300u);
  EXPECT_LT(evidence.sight.contradicted_patches, 3u);
  EXPECT_LT(evidence.leaving(), 0.05 * kVoxel);
  EXPECT_FALSE(evidence.abstained);
  const LinkTestResult test_result = evaluated(evidence);
  EXPECT_EQ(test_result.trust, LinkTrust::kGood);
  EXPECT_LT(test_result.probability_wrong, 1e-3);
  EXPECT_FALSE(test_result.rejection);
}

TEST(LinkEvidence, GivesPosesTheCovarianceOfBothNormals)
{
  // In the axes of the second scan, about its origin: the same in any pose of the pair.
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  const LinkEvidence evidence = linkEvidence(scans[0], scans[1], pair.T_first_second);
  const auto check = pcl6d::linkCheck(0, 1, evidence, evaluated(evidence));
  const auto& C = evidence.fit.pose_covariance;
  const Eigen::Matrix3d R = pair.T_first_second.linear();
  const Eigen::Matrix3d turns =
      R * check.covariance.bottomRightCorner<3, 3>() * R.transpose();
  EXPECT_TRUE(turns.isApprox(C.bottomRightCorner<3, 3>(), 1e-9));
  EXPECT_LT(std::sqrt(check.covariance.topLeftCorner<3, 3>().trace()),
            evidence.fit.deviation())
      << "the test of one link is more careful";
}

TEST(LinkEvidence, LeavesByTheWholeShift)
{
  // Also by more than pairs are apart at most (0.255 m): in a few steps.
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  for (const double way : {0.03, 0.1, 0.2, 0.3}) {
    const Vector shift = way / 3 * Vector(2, -1, 2);
    const LinkEvidence evidence =
        linkEvidence(scans[0], scans[1], shifted(pair.T_first_second, shift));
    EXPECT_NEAR(evidence.leaving(), way, 0.03 * way + 0.002) << way;
    EXPECT_LT((evidence.fit.step.head<3>() + shift).norm(), 0.03 * way + 0.003);
    EXPECT_EQ(evaluated(evidence).trust,
              way < 0.05 ? LinkTrust::kGood : LinkTrust::kWrong)
        << way << ": " << evaluated(evidence).rejection;
  }
}

TEST(LinkEvidence, OfATurnedScanIsAgainstIt)
{
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  for (const double degrees : {2.0, 5.0, 20.0}) {
    const Eigen::Isometry3d T =
        pair.T_first_second *
        Eigen::AngleAxisd(degrees * M_PI / 180, Vector(1, 2, 2) / 3);
    EXPECT_EQ(testedAt(scans, T).trust, LinkTrust::kWrong) << degrees;
  }
}

TEST(LinkEvidence, DoesNotDependOnUnits)
{
  const ScannedPair pair;
  const VerifiedScans metres = pair.verified();
  for (const double scale : {1.0 / 128, 0.01, 100.0}) {
    const VerifiedScans scans = pair.verified(scale);
    // Factors that are no power of two round: a point in another voxel makes another
    // sample of them.
    const double tolerance = scale == 1.0 / 128 ? 0 : 0.03;
    for (const Vector& shift : {Vector(0, 0, 0), Vector(0.3, 0.2, 0)}) {
      SCOPED_TRACE(scale);
      Eigen::Isometry3d T = shifted(pair.T_first_second, shift);
      const LinkEvidence expected = linkEvidence(metres[0], metres[1], T);
      T.translation() *= scale;
      const LinkEvidence found = linkEvidence(scans[0], scans[1], T);
      const double patches = static_cast<double>(expected.sight.patches);
      EXPECT_NEAR(
          static_cast<double>(found.sight.patches), patches, tolerance * patches);
      EXPECT_NEAR(static_cast<double>(found.sight.contradicted_patches),
                  static_cast<double>(expected.sight.contradicted_patches),
                  tolerance * patches);
      EXPECT_NEAR(
          found.deviation() / scale / expected.deviation(), 1, tolerance + 1e-6);
      EXPECT_NEAR(
          found.leaving() / scale, expected.leaving(), (tolerance + 1e-6) * kVoxel);
      EXPECT_EQ(evaluated(found).trust, evaluated(expected).trust);
      const double probability = evaluated(expected).probability_wrong;
      EXPECT_NEAR(evaluated(found).probability_wrong,
                  probability,
                  1e-6 + tolerance * probability);
    }
  }
}

TEST(LinkEvidence, IsTheSameTheOtherWayRound)
{
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  for (const Vector& shift : {Vector(0, 0, 0), Vector(0.04, 0.1, 0), Vector(1, 0, 0)}) {
    const Eigen::Isometry3d T = shifted(pair.T_first_second, shift);
    const LinkEvidence there = linkEvidence(scans[0], scans[1], T);
    const LinkEvidence back = linkEvidence(scans[1], scans[0], T.inverse());
    // The inverse pose rounds: a point at the border of a cell may fall into the next one.
    const double patches = static_cast<double>(there.sight.patches);
    EXPECT_NEAR(static_cast<double>(back.sight.patches), patches, 0.01 * patches);
    EXPECT_NEAR(static_cast<double>(back.sight.contradicted_patches),
                static_cast<double>(there.sight.contradicted_patches),
                0.01 * patches);
    EXPECT_EQ(evaluated(back).trust, evaluated(there).trust);
    EXPECT_NEAR(
        evaluated(back).probability_wrong, evaluated(there).probability_wrong, 1e-4);
  }
}

TEST(LinkEvidence, DoesNotDependOnTheFramesOfTheScans)
{
  // Cells of rays, voxels and patches lie elsewhere in frames that are turned.
  const ScannedPair pair;
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(0.7, Vector(2, 1, 2) / 3));
  VerifiedScans turned;
  for (const Points* points : {&pair.first, &pair.second})
    turned.add(pcl6d::transformed(*points, turn));
  const auto testedWith = [&](const Vector& shift) {
    return testedAt(turned,
                    turn * shifted(pair.T_first_second, shift) * turn.inverse());
  };
  EXPECT_EQ(testedWith({0, 0, 0}).trust, LinkTrust::kGood);
  EXPECT_EQ(testedWith({0.2, 0, 0}).trust, LinkTrust::kWrong);
  EXPECT_EQ(testedWith({1, 0, 0}).trust, LinkTrust::kWrong);
}

TEST(LinkEvidence, RaysFindAFoldThatSurfacesDoNot)
{
  const PillarRoom room = asymmetricRoom();
  const ScannedPair pair(room);
  const VerifiedScans scans = pair.verified();
  const Eigen::Isometry3d folded = pair.T_world_first.inverse() *
                                   pcl6d::test::foldOf(room) * pair.T_world_first *
                                   pair.T_first_second;
  const LinkEvidence truth = linkEvidence(scans[0], scans[1], pair.T_first_second);
  const LinkEvidence fold = linkEvidence(scans[0], scans[1], folded);
  EXPECT_GT(fold.fit.overlap, 0.75 * truth.fit.overlap);
  EXPECT_LT(fold.fit.residual, 2 * truth.fit.residual);
  EXPECT_LT(fold.leaving(), 3 * fold.deviation()) << "ICP would stay there";
  EXPECT_EQ(evaluated(truth).trust, LinkTrust::kGood);
  EXPECT_EQ(evaluated(fold).trust, LinkTrust::kWrong);
  EXPECT_EQ(evaluated(fold).rejection.reason, pcl6d::RejectReason::kPatchesViolated);
}

TEST(LinkEvidence, OfAFoldWithLittleToTellIsNeverGood)
{
  const PillarRoom room;
  const ScannedPair pair(room);
  const VerifiedScans scans = pair.verified();
  const LinkTestResult test_result =
      testedAt(scans,
               pair.T_world_first.inverse() * pcl6d::test::foldOf(room) *
                   pair.T_world_first * pair.T_first_second);
  EXPECT_NE(test_result.trust, LinkTrust::kGood);
  EXPECT_TRUE(test_result.rejection);
}

TEST(LinkEvidence, OfScansThatSeeNothingInCommonIsWeak)
{
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  const LinkTestResult test_result =
      testedAt(scans, shifted(pair.T_first_second, {100, 0, 0}));
  EXPECT_EQ(test_result.trust, LinkTrust::kWeak);
  EXPECT_EQ(test_result.rejection.reason, pcl6d::RejectReason::kTooFewPatches);
  EXPECT_EQ(test_result.rejection.measured, 0);
}

TEST(LinkEvidence, OfIdenticalScansIsGood)
{
  const VerifiedScans scans = ScannedPair().verified();
  const LinkEvidence evidence =
      linkEvidence(scans[0], scans[0], Eigen::Isometry3d::Identity());
  EXPECT_EQ(evaluated(evidence).trust, LinkTrust::kGood);
  EXPECT_EQ(evidence.leaving(), 0);
  EXPECT_EQ(evidence.deviation(), 0.1 * kVoxel) << "not 0";
}

TEST(LinkEvidence, AlongACorridorItIsOpenAndTiesNothing)
{
  Random random(3);
  VerifiedScans scans;
  for (const double x : {0.0, 1.5})
    scans.add(pcl6d::test::within(
        pcl6d::test::endlessCorridor().scan(
            pcl6d::poseFromEuler({x, 0.2, 0}, {}), random, kRayStep),
        10));
  const Eigen::Isometry3d truth = pcl6d::poseFromEuler({1.5, 0, 0}, {});
  for (const double slid : {0.0, 1.0}) {
    const LinkEvidence evidence =
        linkEvidence(scans[0], scans[1], shifted(truth, {slid, 0, 0}));
    EXPECT_EQ(evidence.fit.open_directions, 1);
    EXPECT_GT(std::sqrt(evidence.fit.covariance(0, 0)), 1) << "[m] along the corridor";
    EXPECT_GT(evidence.deviation(), 1);
    EXPECT_LT(std::sqrt(evidence.fit.covariance(1, 1)), 0.1 * kVoxel);
    EXPECT_EQ(evaluated(evidence).trust, LinkTrust::kWeak);
    EXPECT_EQ(evaluated(evidence).rejection,
              pcl6d::Rejection(pcl6d::RejectReason::kFreeDirections, 1));
  }
  EXPECT_EQ(testedAt(scans, shifted(truth, {0, 0.3, 0})).trust, LinkTrust::kWrong);
}

TEST(LinkEvidence, OfAMirroredOrScaledScanIsAgainstIt)
{
  const ScannedPair pair;
  VerifiedScans mirrored, feet, upside_down;
  for (VerifiedScans* scans : {&mirrored, &feet, &upside_down})
    scans->add(pair.first);
  Points left_handed = pair.second;
  for (auto& p : left_handed)
    p.y() = -p.y();
  mirrored.add(left_handed);
  feet.add(ScannedPair::scaled(pair.second, 1 / 0.3048));
  upside_down.add(pcl6d::transformed(
      pair.second, Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Vector::UnitX()))));
  EXPECT_EQ(testedAt(mirrored, pair.T_first_second).trust, LinkTrust::kWrong);
  EXPECT_EQ(testedAt(feet, pair.T_first_second).trust, LinkTrust::kWrong);
  EXPECT_EQ(testedAt(upside_down, pair.T_first_second).trust, LinkTrust::kWrong);
}

TEST(LinkEvidence, OfASmallPartInCommonIsNeverWrongAtTheTruth)
{
  const ScannedPair pair;
  for (const float share : {0.3F, 0.5F, 0.7F, 0.8F, 0.9F, 0.95F, 0.98F}) {
    VerifiedScans scans;
    scans.add(pair.first);
    Points part;
    for (const auto& p : pair.second)
      if (p.normalized().dot(Eigen::Vector3f(2, 1, -1).normalized()) > share)
        part.push_back(p);
    scans.add(part);
    const LinkTestResult right = testedAt(scans, pair.T_first_second);
    EXPECT_NE(right.trust, LinkTrust::kWrong) << share << ": " << right.rejection;
    const LinkTestResult wrong =
        testedAt(scans, shifted(pair.T_first_second, {1, 0.5, 0.3}));
    EXPECT_NE(wrong.trust, LinkTrust::kGood) << share;
  }
}

TEST(LinkEvidence, OfEmptyOrTinyScansIsWeak)
{
  VerifiedScans scans;
  scans.add(ScannedPair().first);
  scans.add({});
  scans.add({{1, 2, 1}});
  scans.add(Points(50, {kNan, kNan, kNan}));
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 1; k < 4; ++k) {
      const LinkTestResult test_result =
          evaluated(linkEvidence(scans[i], scans[k], Eigen::Isometry3d::Identity()));
      EXPECT_EQ(test_result.trust, LinkTrust::kWeak);
      EXPECT_TRUE(std::isfinite(test_result.probability_wrong));
    }
}

TEST(LinkEvidence, DoesNotSeePointsThatAreNotFinite)
{
  const ScannedPair pair;
  VerifiedScans scans = pair.verified();
  Points holes = pair.second;
  for (std::size_t i = 0; i < 100; ++i)
    holes.insert(holes.begin() + static_cast<long>(100 * i), {kNan, 1, kNan});
  scans.add(holes);
  const LinkEvidence plain = linkEvidence(scans[0], scans[1], pair.T_first_second);
  const LinkEvidence with = linkEvidence(scans[0], scans[2], pair.T_first_second);
  EXPECT_EQ(evaluated(with).trust, LinkTrust::kGood);
  EXPECT_EQ(with.sight.patches, plain.sight.patches);
}

TEST(LinkEvidence, OfAWrongOriginIsAgainstAWrongPose)
{
  const ScannedPair pair;
  VerifiedScans scans;
  scans.add(pair.first);
  scans.add(pair.second, kVoxel, {100, 0, 0}); // far outside of the room
  EXPECT_EQ(testedAt(scans, shifted(pair.T_first_second, {0.2, 0, 0})).trust,
            LinkTrust::kWrong);
  EXPECT_EQ(testedAt(scans, shifted(pair.T_first_second, {1, 0, 0})).trust,
            LinkTrust::kWrong);
}

TEST(LinkEvidence, GivesTheContradictedPointsOfTheSecondScan)
{
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  std::vector<pcl6d::Contradiction> none, many;
  linkEvidence(scans[0], scans[1], pair.T_first_second, &none);
  linkEvidence(scans[0], scans[1], shifted(pair.T_first_second, {1, 0, 0}), &many);
  EXPECT_LT(none.size(), 10u);
  EXPECT_GT(many.size(), 500u);
  for (const auto& contradiction : many)
    ASSERT_TRUE(contradiction.beyond > 0 && contradiction.place.allFinite());
}

TEST(LinkEvidence, WithoutRaysTheSurfacesSpeakAlone)
{
  const ScannedPair pair;
  VerifiedScans scans;
  for (const Points* points : {&pair.first, &pair.second})
    scans.add(*points);
  scans.add(pcl6d::test::spoilt(pair.second));
  ASSERT_TRUE(scans[2].abstains());
  const LinkEvidence half = linkEvidence(scans[0], scans[2], pair.T_first_second);
  EXPECT_TRUE(half.abstained);
  EXPECT_NE(evaluated(half).trust, LinkTrust::kGood);
  const LinkEvidence none =
      linkEvidence(scans[2], scans[2], Eigen::Isometry3d::Identity());
  EXPECT_EQ(none.sight.points(), 0u);
  EXPECT_EQ(evaluated(none).trust, LinkTrust::kUnverified);
  EXPECT_EQ(evaluated(none).rejection.reason, pcl6d::RejectReason::kTooFewSurfaces);
}

TEST(LinkEvidence, OfCutOutsInACommonFrameIsOfSurfacesAlone)
{
  const ScannedPair pair;
  const Eigen::Isometry3d offset(Eigen::Translation3d(6, 31, 49));
  VerifiedScans scans;
  for (const Points* points : {&pair.first, &pair.second})
    scans.add(pcl6d::transformed(*points, offset));
  ASSERT_TRUE(scans[0].isOffCentre() && scans[1].isOffCentre());
  const LinkEvidence link =
      linkEvidence(scans[0], scans[1], offset * pair.T_first_second * offset.inverse());
  EXPECT_TRUE(link.abstained && link.off_centre);
  EXPECT_EQ(link.sight.points(), 0u);
  EXPECT_EQ(evaluated(link).trust, LinkTrust::kUnverified);
  EXPECT_EQ(evaluated(link).rejection.reason, pcl6d::RejectReason::kOffCentre);
}

TEST(LinkEvidence, ThatAbstainsWithoutCommonSurfacesIsWeak)
{
  // Nobody says anything: that ties no scans.
  VerifiedScans scans;
  scans.add(pcl6d::test::spoilt(ScannedPair().first));
  const LinkTestResult test_result = evaluated(
      linkEvidence(scans[0], scans[0], pcl6d::poseFromEuler({100, 0, 0}, {})));
  EXPECT_EQ(test_result.trust, LinkTrust::kWeak);
  EXPECT_EQ(test_result.rejection.reason, pcl6d::RejectReason::kTooFewPatches);
  EXPECT_EQ(test_result.rejection.measured, 0);
}
