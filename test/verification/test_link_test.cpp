// SPDX-License-Identifier: BSD-3-Clause
#include "judged.h"
#include "support/points.h"
#include "verified_rooms.h"

#include <pcl6d/verification/link_evidence.h>

#include <algorithm>
#include <cmath>
#include <vector>

using pcl6d::contradictionBackground;
using pcl6d::LinkEvidence;
using pcl6d::LinkTestResult;
using pcl6d::LinkTrust;
using pcl6d::testLink;
using pcl6d::withThingsOnce;
using pcl6d::test::evaluated;
using pcl6d::test::kBackground;
using pcl6d::test::kNan;
using pcl6d::test::kVoxel;

namespace {

/** \return evidence of rays, and of surfaces that meet and stay where they are */
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
  evidence.fit.spread = 3;
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

} // namespace

TEST(LinkTestResult, GetsWorseWithEachContradictedPatch)
{
  for (const std::size_t patches : {30u, 100u, 1000u}) {
    double before = 0;
    for (std::size_t k = 0; k <= patches / 2; ++k) {
      const double now = evaluated(seen(k, patches)).probability_wrong;
      EXPECT_GE(now, before) << k << " of " << patches;
      before = now;
    }
    EXPECT_GT(before, 0.999);
  }
}

TEST(LinkTestResult, GetsBetterWithEachConfirmedPatch)
{
  double before = 1;
  for (std::size_t patches = 0; patches <= 300; patches += 10) {
    const LinkTestResult test_result = evaluated(seen(0, patches));
    EXPECT_LT(test_result.probability_wrong, before) << patches;
    before = test_result.probability_wrong;
  }
}

TEST(LinkTestResult, IsTheRatioOfBetaBinomials)
{
  // 2 of 3 patches, worked out by hand: (a)_k (b)_(n-k) / (a + b)_n of both, rising
  // factorials, at odds of one in ten before.
  const auto probability = [](double a, double b) {
    return a * (a + 1) * b / ((a + b) * (a + b + 1) * (a + b + 2));
  };
  const auto wrong = [](double odds) {
    // Surfaces that stay have odds of exp(-3.3^2 / 2), and are asked for themselves.
    const double beside = 0.1 * std::exp(-3.3 * 3.3 / 2);
    return 1 - 1 / (1 + odds) / (1 + beside);
  };
  const double odds = 0.1 *
                      (0.985 * probability(2.75, 3.8) + 0.015 * probability(1, 19)) /
                      probability(0.4, 39.6);
  EXPECT_NEAR(testLink(seen(2, 3), 0.01).probability_wrong, wrong(odds), 1e-12);
  EXPECT_NEAR(testLink(seen(0, 0), 0.01).probability_wrong, wrong(0.1), 1e-15);
}

TEST(LinkTestResult, IsMorePatientWhereRightLinksAreContradictedToo)
{
  EXPECT_EQ(testLink(seen(45, 300), 0.002).trust, LinkTrust::kWrong);
  EXPECT_NE(testLink(seen(45, 300), 0.05).trust, LinkTrust::kWrong);
  EXPECT_LT(testLink(seen(45, 300), 0.05).probability_wrong,
            testLink(seen(45, 300), 0.02).probability_wrong);
}

TEST(LinkTestResult, RefusesABackgroundThatIsNoShare)
{
  for (const float wrong : {0.0F, 1.0F, -0.1F, kNan})
    EXPECT_EQ(pcl6d::test::badArgumentOf([&] {
                testLink(seen(0, 30), wrong);
              }).find("background = "),
              0u)
        << wrong;
}

TEST(LinkTestResult, NeedsThirtyPatches)
{
  EXPECT_EQ(evaluated(seen(0, 30)).trust, LinkTrust::kGood);
  EXPECT_EQ(evaluated(seen(0, 29)).trust, LinkTrust::kWeak);
  EXPECT_EQ(evaluated(seen(0, 29)).rejection,
            pcl6d::Rejection(pcl6d::RejectReason::kTooFewPatches, 29, 30));
}

TEST(LinkTestResult, NeedsSurfacesThatMeet)
{
  LinkEvidence evidence = seen(0, 200);
  evidence.fit.spread = 0;
  EXPECT_EQ(evaluated(evidence).trust, LinkTrust::kWeak);
  EXPECT_EQ(evaluated(evidence).rejection.reason, pcl6d::RejectReason::kNoSurfacesMeet);
}

TEST(LinkTestResult, AsksForAnyPartOfThePointsToBeConfirmed)
{
  LinkEvidence evidence = seen(0, 200);
  evidence.sight.unseen = 17000; // of 2000 that are confirmed: a tenth
  EXPECT_EQ(evaluated(evidence).trust, LinkTrust::kGood);
  evidence.sight.unseen = 19000;
  EXPECT_EQ(evaluated(evidence).trust, LinkTrust::kWeak);
  EXPECT_EQ(toWords(evaluated(evidence).rejection),
            "rays confirm only 9.5 % of the points");
}

TEST(LinkTestResult, AllowsTwoAndAHalfDeviationsOfSurfaces)
{
  EXPECT_EQ(evaluated(leaving(2.4)).trust, LinkTrust::kGood);
  EXPECT_EQ(evaluated(leaving(2.6)).trust, LinkTrust::kWeak);
  EXPECT_EQ(evaluated(leaving(4.4)).trust, LinkTrust::kWeak);
  EXPECT_EQ(evaluated(leaving(4.6)).trust, LinkTrust::kWrong);
  double before = 0;
  for (double sigmas = 0; sigmas < 6; sigmas += 0.5) {
    EXPECT_GT(evaluated(leaving(sigmas)).probability_wrong, before) << sigmas;
    before = evaluated(leaving(sigmas)).probability_wrong;
  }
  const LinkTestResult far = evaluated(leaving(100));
  EXPECT_EQ(far.trust, LinkTrust::kWrong);
  EXPECT_EQ(toWords(far.rejection),
            "surfaces ask for a shift of 1.5 m, 100 standard deviations");
  EXPECT_EQ(evaluated(leaving(1e6)).probability_wrong, 1) << "no overflow";
}

TEST(ContradictionBackground, IsThatOfTheBetterHalf)
{
  // 40 of the prior, and of each link what 200 patches tell of one share in many: wrong links
  // do not count.
  const double weight = 40.0 / 240;
  EXPECT_NEAR(contradictionBackground(
                  {seen(80, 100), seen(2, 200), seen(3, 200), seen(90, 100)}),
              (kBackground * 40 + 5 * weight) / (40 + 400 * weight),
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

TEST(ContradictionBackground, IsOfLinksThatAgree)
{
  // Three scans, one at a wrong place: the better half of the links has a wrong one.
  EXPECT_LT(contradictionBackground({seen(0, 520), seen(85, 440), seen(95, 430)}),
            kBackground);
  // An old scanner in a corridor with glass: all links are contradicted alike.
  EXPECT_GT(contradictionBackground({seen(22, 289), seen(31, 324), seen(50, 155)}),
            0.05);
}

TEST(ContradictionBackground, IsNeverNone)
{
  EXPECT_EQ(contradictionBackground(std::vector<LinkEvidence>(100, seen(0, 100000))),
            0.002);
}

TEST(LinkTestResult, OfRaysThatAreNoJudgesIsUnverifiedUnlessSurfacesObject)
{
  LinkEvidence evidence = seen(30, 300);
  EXPECT_EQ(testLink(evidence, 0.08).trust, LinkTrust::kUnverified);
  EXPECT_EQ(testLink(evidence, 0.08).rejection.reason,
            pcl6d::RejectReason::kRaysUnreliable);
  evidence.fit.step(0) = 10 * evidence.deviation();
  EXPECT_EQ(testLink(evidence, 0.08).trust, LinkTrust::kWrong);
  EXPECT_EQ(testLink(seen(150, 300), 0.08).trust, LinkTrust::kWrong);
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

TEST(LinkTestResult, DoubtsALinkLessWhereThingsCountOnce)
{
  // Five people, as far as both scans see them: 21 of 531 patches, all of things.
  LinkEvidence evidence = seen(21, 531);
  evidence.sight.things = 6;
  evidence.sight.patches_of_things = 21;
  EXPECT_EQ(evaluated(evidence).trust, LinkTrust::kWeak);
  const LinkEvidence once = withThingsOnce(evidence);
  EXPECT_EQ(once.sight.contradicted_patches, 6u);
  EXPECT_EQ(once.sight.patches, 516u);
  EXPECT_EQ(once.sight.confirmed_patches, evidence.sight.confirmed_patches);
  EXPECT_EQ(evaluated(once).trust, LinkTrust::kGood);
  EXPECT_EQ(withThingsOnce(once).sight.contradicted_patches, 6u)
      << "done once, and for all";
}

TEST(LinkTestResult, IsTheSameWithoutThings)
{
  for (const std::size_t k : {0u, 21u, 250u}) {
    const LinkEvidence evidence = seen(k, 531);
    EXPECT_EQ(evaluated(withThingsOnce(evidence)).probability_wrong,
              evaluated(evidence).probability_wrong);
  }
}

TEST(LinkTestResult, CountsTheRestOfWhatIsContradictedAsEver)
{
  LinkEvidence evidence = seen(250, 531); // a wall, and a thing before it
  evidence.sight.things = 1;
  evidence.sight.patches_of_things = 6;
  EXPECT_EQ(withThingsOnce(evidence).sight.contradicted_patches, 245u);
  EXPECT_EQ(evaluated(withThingsOnce(evidence)).trust, LinkTrust::kWrong);
}
