// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"
#include "verified_rooms.h"

#include <pcl6d/verification/link_evidence.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using pcl6d::contradictionBackground;
using pcl6d::judgeLink;
using pcl6d::LinkEvidence;
using pcl6d::linkEvidence;
using pcl6d::LinkOpinion;
using pcl6d::LinkTrust;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::test::kNan;
using pcl6d::test::kRayStep;
using pcl6d::test::kVoxel;
using pcl6d::test::PillarRoom;
using pcl6d::test::ScannedPair;
using pcl6d::test::shifted;
using pcl6d::test::VerifiedScans;
using Vector = Eigen::Vector3d;

namespace {
const double kBackground = contradictionBackground({});

/** \return evidence of rays alone */
LinkEvidence
seen(std::size_t contradicted, std::size_t patches)
{
  LinkEvidence evidence;
  evidence.voxel = kVoxel;
  evidence.sight.patches = patches;
  evidence.sight.contradicted_patches = contradicted;
  evidence.sight.confirmed_patches = patches - contradicted;
  evidence.sight.confirmed = 10 * (patches - contradicted);
  evidence.sight.free = 10 * contradicted;
  return evidence;
}

/** \return evidence of surfaces that would move a link by so many deviations, of which the
 * rays say that it is right */
LinkEvidence
leaving(double sigmas)
{
  LinkEvidence evidence = seen(0, 200);
  evidence.fit.step(0) = sigmas * evidence.deviation();
  return evidence;
}

LinkOpinion
judged(const LinkEvidence& evidence)
{
  return judgeLink(evidence, kBackground);
}

LinkOpinion
judgedAt(const VerifiedScans& scans, const Eigen::Isometry3d& T)
{
  return judged(linkEvidence(scans[0], scans[1], T));
}

/** A room with closets along its walls, none of which half a turn maps to another. */
PillarRoom
asymmetricRoom()
{
  PillarRoom room;
  room.pillars.emplace_back(Vector(3.5, -4, -1), Vector(5, -3.4, 2));
  room.pillars.emplace_back(Vector(-5, 0, -1), Vector(-4.4, 1.2, 2));
  room.pillars.emplace_back(Vector(0, 3.4, -1), Vector(1.5, 4, 1));
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
  const LinkOpinion opinion = judged(evidence);
  EXPECT_EQ(opinion.trust, LinkTrust::kGood);
  EXPECT_LT(opinion.probability_wrong, 1e-4);
  EXPECT_EQ(opinion.reason, "");
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
    EXPECT_EQ(judged(evidence).trust, way < 0.05 ? LinkTrust::kGood : LinkTrust::kWrong)
        << way << ": " << judged(evidence).reason;
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
    EXPECT_EQ(judgedAt(scans, T).trust, LinkTrust::kWrong) << degrees;
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
      EXPECT_EQ(judged(found).trust, judged(expected).trust);
      EXPECT_NEAR(
          judged(found).probability_wrong, judged(expected).probability_wrong, 1e-6);
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
    EXPECT_EQ(back.sight.patches, there.sight.patches);
    EXPECT_EQ(back.sight.contradicted_patches, there.sight.contradicted_patches);
    EXPECT_EQ(judged(back).trust, judged(there).trust);
    EXPECT_NEAR(judged(back).probability_wrong, judged(there).probability_wrong, 1e-4);
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
  const auto judgedWith = [&](const Vector& shift) {
    return judgedAt(turned,
                    turn * shifted(pair.T_first_second, shift) * turn.inverse());
  };
  EXPECT_EQ(judgedWith({0, 0, 0}).trust, LinkTrust::kGood);
  EXPECT_EQ(judgedWith({0.2, 0, 0}).trust, LinkTrust::kWrong);
  EXPECT_EQ(judgedWith({1, 0, 0}).trust, LinkTrust::kWrong);
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
  EXPECT_GT(fold.fit.overlap, 0.8 * truth.fit.overlap);
  EXPECT_LT(fold.fit.residual, 2 * truth.fit.residual);
  EXPECT_LT(fold.leaving(), 3 * fold.deviation()) << "ICP would stay there";
  EXPECT_EQ(judged(truth).trust, LinkTrust::kGood);
  EXPECT_NE(judged(fold).trust, LinkTrust::kGood);
  EXPECT_GT(judged(fold).elsewhere, 0.5);
  EXPECT_EQ(judged(fold).reason.find("rays go through "), 0u) << judged(fold).reason;
}

TEST(LinkEvidence, OfAFoldWithLittleToTellIsNeverGood)
{
  const PillarRoom room;
  const ScannedPair pair(room);
  const VerifiedScans scans = pair.verified();
  const LinkOpinion opinion =
      judgedAt(scans,
               pair.T_world_first.inverse() * pcl6d::test::foldOf(room) *
                   pair.T_world_first * pair.T_first_second);
  EXPECT_NE(opinion.trust, LinkTrust::kGood);
  EXPECT_NE(opinion.reason, "");
}

TEST(LinkEvidence, OfScansThatSeeNothingInCommonIsWeak)
{
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  const LinkOpinion opinion =
      judgedAt(scans, shifted(pair.T_first_second, {100, 0, 0}));
  EXPECT_EQ(opinion.trust, LinkTrust::kWeak);
  EXPECT_EQ(opinion.reason, "only 0 patches of surface in common");
}

TEST(LinkEvidence, OfIdenticalScansIsGood)
{
  const VerifiedScans scans = ScannedPair().verified();
  const LinkEvidence evidence =
      linkEvidence(scans[0], scans[0], Eigen::Isometry3d::Identity());
  EXPECT_EQ(judged(evidence).trust, LinkTrust::kGood);
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
    EXPECT_EQ(judged(evidence).trust, LinkTrust::kWeak);
    EXPECT_EQ(judged(evidence).reason,
              "the surfaces leave 1 motion open, as along a corridor");
  }
  EXPECT_EQ(judgedAt(scans, shifted(truth, {0, 0.3, 0})).trust, LinkTrust::kWrong);
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
  EXPECT_EQ(judgedAt(mirrored, pair.T_first_second).trust, LinkTrust::kWrong);
  EXPECT_EQ(judgedAt(feet, pair.T_first_second).trust, LinkTrust::kWrong);
  EXPECT_EQ(judgedAt(upside_down, pair.T_first_second).trust, LinkTrust::kWrong);
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
    const LinkOpinion right = judgedAt(scans, pair.T_first_second);
    EXPECT_NE(right.trust, LinkTrust::kWrong) << share << ": " << right.reason;
    const LinkOpinion wrong =
        judgedAt(scans, shifted(pair.T_first_second, {1, 0.5, 0.3}));
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
      const LinkOpinion opinion =
          judged(linkEvidence(scans[i], scans[k], Eigen::Isometry3d::Identity()));
      EXPECT_EQ(opinion.trust, LinkTrust::kWeak);
      EXPECT_TRUE(std::isfinite(opinion.probability_wrong));
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
  EXPECT_EQ(judged(with).trust, LinkTrust::kGood);
  EXPECT_EQ(with.sight.patches, plain.sight.patches);
}

TEST(LinkEvidence, OfAWrongOriginIsAgainstAWrongPose)
{
  const ScannedPair pair;
  VerifiedScans scans;
  scans.add(pair.first);
  scans.add(pair.second, kVoxel, {100, 0, 0}); // far outside of the room
  EXPECT_EQ(judgedAt(scans, shifted(pair.T_first_second, {0.2, 0, 0})).trust,
            LinkTrust::kWrong);
  EXPECT_EQ(judgedAt(scans, shifted(pair.T_first_second, {1, 0, 0})).trust,
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
  EXPECT_NE(judged(half).trust, LinkTrust::kGood);
  const LinkEvidence none =
      linkEvidence(scans[2], scans[2], Eigen::Isometry3d::Identity());
  EXPECT_EQ(none.sight.points(), 0u);
  EXPECT_EQ(judged(none).trust, LinkTrust::kUnverified);
  EXPECT_EQ(judged(none).reason,
            "a scan has too few surfaces, or its rays contradict its own points");
}

TEST(LinkEvidence, ThatAbstainsWithoutCommonSurfacesIsWeak)
{
  // Nobody says anything: that ties no scans.
  VerifiedScans scans;
  scans.add(pcl6d::test::spoilt(ScannedPair().first));
  const LinkOpinion opinion =
      judged(linkEvidence(scans[0], scans[0], pcl6d::poseFromEuler({100, 0, 0}, {})));
  EXPECT_EQ(opinion.trust, LinkTrust::kWeak);
  EXPECT_EQ(opinion.reason, "only 0 patches of surface in common");
}

TEST(LinkOpinion, GetsWorseWithEachContradictedPatch)
{
  for (const std::size_t patches : {30u, 100u, 1000u}) {
    double before = 0;
    for (std::size_t k = 0; k <= patches / 2; ++k) {
      const double now = judged(seen(k, patches)).probability_wrong;
      EXPECT_GE(now, before) << k << " of " << patches;
      before = now;
    }
    EXPECT_GT(before, 0.999);
  }
}

TEST(LinkOpinion, GetsBetterWithEachConfirmedPatch)
{
  double before = 1;
  for (std::size_t patches = 0; patches <= 300; patches += 10) {
    const LinkOpinion opinion = judged(seen(0, patches));
    EXPECT_LT(opinion.probability_wrong, before) << patches;
    before = opinion.probability_wrong;
  }
}

TEST(LinkOpinion, IsTheRatioOfTwoBetaBinomials)
{
  // 2 of 3 patches, worked out by hand: (a)_k (b)_(n-k) / (a + b)_n of both, rising
  // factorials, at odds of one in ten before.
  const auto probability = [](double a, double b) {
    return a * (a + 1) * b / ((a + b) * (a + b + 1) * (a + b + 2));
  };
  const auto wrong = [](double odds) {
    // Surfaces that stay have odds of exp(-4^2 / 2), and are asked for themselves.
    const double beside = 0.1 * std::exp(-8.0);
    return 1 - 1 / (1 + odds) / (1 + beside);
  };
  const double odds = 0.1 * probability(2.75, 3.8) / probability(0.4, 39.6);
  EXPECT_NEAR(judgeLink(seen(2, 3), 0.01).probability_wrong, wrong(odds), 1e-12);
  EXPECT_NEAR(judgeLink(seen(0, 0), 0.01).probability_wrong, wrong(0.1), 1e-15);
}

TEST(LinkOpinion, IsMorePatientWhereRightLinksAreContradictedToo)
{
  EXPECT_EQ(judgeLink(seen(45, 300), 0.002).trust, LinkTrust::kWrong);
  EXPECT_NE(judgeLink(seen(45, 300), 0.05).trust, LinkTrust::kWrong);
  EXPECT_LT(judgeLink(seen(45, 300), 0.05).probability_wrong,
            judgeLink(seen(45, 300), 0.02).probability_wrong);
}

TEST(LinkOpinion, RefusesABackgroundThatIsNoShare)
{
  for (const float wrong : {0.0F, 1.0F, -0.1F, kNan})
    EXPECT_EQ(pcl6d::test::badArgumentOf([&] {
                judgeLink(seen(0, 30), wrong);
              }).find("background = "),
              0u)
        << wrong;
}

TEST(LinkOpinion, NeedsThirtyPatches)
{
  EXPECT_EQ(judged(seen(0, 30)).trust, LinkTrust::kGood);
  EXPECT_EQ(judged(seen(0, 29)).trust, LinkTrust::kWeak);
  EXPECT_EQ(judged(seen(0, 29)).reason, "only 29 patches of surface in common");
}

TEST(LinkOpinion, AsksForAnyPartOfThePointsToBeConfirmed)
{
  LinkEvidence evidence = seen(0, 200);
  evidence.sight.unseen = 17000; // of 2000 that are confirmed: a tenth
  EXPECT_EQ(judged(evidence).trust, LinkTrust::kGood);
  evidence.sight.unseen = 19000;
  EXPECT_EQ(judged(evidence).trust, LinkTrust::kWeak);
  EXPECT_EQ(judged(evidence).reason, "rays confirm only 9.5 % of the points");
}

TEST(LinkOpinion, AllowsThreeDeviationsOfSurfaces)
{
  EXPECT_EQ(judged(leaving(2.9)).trust, LinkTrust::kGood);
  EXPECT_EQ(judged(leaving(3.5)).trust, LinkTrust::kWeak);
  double before = 0;
  for (double sigmas = 0; sigmas < 6; sigmas += 0.5) {
    EXPECT_GT(judged(leaving(sigmas)).probability_wrong, before) << sigmas;
    before = judged(leaving(sigmas)).probability_wrong;
  }
  const LinkOpinion far = judged(leaving(100));
  EXPECT_EQ(far.trust, LinkTrust::kWrong);
  EXPECT_EQ(far.reason, "surfaces ask for a shift of 1.5 m, 100 standard deviations");
  EXPECT_EQ(judged(leaving(1e6)).probability_wrong, 1) << "no overflow";
}

TEST(ContradictionBackground, IsThatOfTheBetterHalf)
{
  // 40 of the prior, and of each link what 200 patches tell of one share in many: wrong links
  // do not count.
  const double weight = 40.0 / 240;
  EXPECT_NEAR(contradictionBackground(
                  {seen(80, 100), seen(2, 200), seen(3, 200), seen(90, 100)}),
              (0.006 * 40 + 5 * weight) / (40 + 400 * weight),
              1e-15);
  EXPECT_EQ(contradictionBackground({seen(0, 0), seen(0, 0)}), kBackground);
}

TEST(ContradictionBackground, IsNotLearnedFromOneLinkOrFromWrongOnes)
{
  EXPECT_EQ(contradictionBackground({seen(50, 300)}), kBackground);
  EXPECT_EQ(contradictionBackground({seen(120, 300), seen(100, 300), seen(90, 300)}),
            kBackground);
  EXPECT_GT(contradictionBackground({seen(30, 300), seen(31, 300), seen(60, 300)}),
            0.05)
      << "rays that are no judges";
}

TEST(ContradictionBackground, IsNeverNone)
{
  EXPECT_EQ(contradictionBackground(std::vector<LinkEvidence>(100, seen(0, 100000))),
            0.002);
}

TEST(LinkOpinion, OfRaysThatAreNoJudgesIsUnverifiedUnlessSurfacesObject)
{
  LinkEvidence evidence = seen(30, 300);
  evidence.fit.spread = 3;
  EXPECT_EQ(judgeLink(evidence, 0.08).trust, LinkTrust::kUnverified);
  EXPECT_EQ(judgeLink(evidence, 0.08).reason,
            "rays contradict too much even where the scans of this map fit best");
  evidence.fit.step(0) = 10 * evidence.deviation();
  EXPECT_EQ(judgeLink(evidence, 0.08).trust, LinkTrust::kWrong);
  EXPECT_EQ(judgeLink(seen(150, 300), 0.08).trust, LinkTrust::kWrong);
}

TEST(ContradictionBackground, DoesNotDependOnTheOrderOfLinks)
{
  std::vector<LinkEvidence> links;
  for (std::size_t i = 0; i < 20; ++i)
    links.push_back(seen(i % 7, 100 + 10 * i));
  const double expected = contradictionBackground(links);
  std::reverse(links.begin(), links.end());
  EXPECT_EQ(contradictionBackground(links), expected);
}
