// SPDX-License-Identifier: BSD-3-Clause
// Which scans links hold together.

#include <pcl6d/verification/ties.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using pcl6d::LinkCheck;
using pcl6d::LinkTrust;
using pcl6d::verification::Ties;
using pcl6d::verification::tiesOf;

namespace {
constexpr double kTieBackground = 0.002;

LinkCheck
link(std::size_t from,
     std::size_t to,
     LinkTrust trust = LinkTrust::kGood,
     std::size_t contradicted = 0,
     std::size_t patches = 300)
{
  LinkCheck check;
  check.from = from;
  check.to = to;
  check.trust = trust;
  check.patches = patches;
  check.contradicted = contradicted;
  return check;
}

/** Two triangles, 0 1 2 and 3 4 5, and what is between them. */
Ties
triangles(const std::vector<LinkCheck>& between)
{
  std::vector<LinkCheck> links = {
      link(0, 1), link(1, 2), link(0, 2), link(3, 4), link(4, 5), link(3, 5)};
  links.insert(links.end(), between.begin(), between.end());
  return tiesOf(6, links, kTieBackground);
}

const std::vector<bool> kAll(6, true);
const std::vector<bool> kFirstThree = {true, true, true, false, false, false};
} // namespace

TEST(Ties, HoldThroughOneSureLink)
{
  EXPECT_EQ(triangles({link(2, 3)}).tied, kAll);
}

TEST(Ties, AreNotOneLinkThatContradictsALittle)
{
  const Ties ties = triangles({link(2, 3, LinkTrust::kGood, 2, 98)});
  EXPECT_EQ(ties.tied, kFirstThree);
  EXPECT_EQ(ties.cut_from[3],
            pcl6d::Rejection(pcl6d::RejectReason::kInconsistentTogether, 2, 98));
  EXPECT_FALSE(ties.cut_from[4]);
}

TEST(Ties, CountLinksBesideTheOneThatHolds)
{
  // The link itself is sure; weak ones between the same parts contradict.
  EXPECT_EQ(triangles({link(2, 3), link(1, 4, LinkTrust::kWeak, 30, 300)}).tied,
            kFirstThree);
  EXPECT_EQ(triangles({link(2, 3), link(1, 4, LinkTrust::kWeak, 0, 20)}).tied, kAll);
}

TEST(Ties, DoNotCountLinksOfScansThatBelongToNeither)
{
  // Scan 2 is elsewhere: what it contradicts says nothing of 0 and 1.
  EXPECT_EQ(tiesOf(3,
                   {link(0, 1),
                    link(1, 2, LinkTrust::kWrong, 200, 300),
                    link(0, 2, LinkTrust::kWrong, 200, 300)},
                   kTieBackground)
                .tied,
            (std::vector<bool>{true, true, false}));
}

TEST(Ties, AreNotSeveralLinksThatEachContradictALittle)
{
  EXPECT_EQ(triangles({link(2, 3, LinkTrust::kGood, 2, 98),
                       link(1, 4, LinkTrust::kGood, 2, 98)})
                .tied,
            kFirstThree);
}

TEST(Ties, HoldIfOneOfManyLinksContradicts)
{
  // Something moved in front of one of the scans.
  EXPECT_EQ(triangles({link(2, 3),
                       link(1, 4),
                       link(2, 4),
                       link(1, 3),
                       link(0, 3, LinkTrust::kWeak, 10, 300)})
                .tied,
            kAll);
}

TEST(Ties, HoldAcrossScansAmongMovingObjects)
{
  // Links across contradict 4 % of their patches. If the links of these scans to their own sides
  // do, too, cars passed by; else the two sides lie at different places.
  const auto sides = [](std::size_t of_own_sides) {
    std::vector<LinkCheck> links;
    for (std::size_t i = 0; i < 12; ++i)
      for (std::size_t k = i + 1; k < std::min<std::size_t>(12, i + 3); ++k) {
        const bool is_across = i < 6 && k >= 6, is_near = i < 8 && k > 3;
        links.push_back(link(i,
                             k,
                             LinkTrust::kGood,
                             is_across ? 12
                             : is_near ? of_own_sides
                                       : 0));
      }
    return tiesOf(12, links, kTieBackground).tied;
  };
  EXPECT_EQ(sides(12), std::vector<bool>(12, true));
  EXPECT_NE(sides(0), std::vector<bool>(12, true));
}

TEST(Ties, AreNotManyLinksThatContradictLittleWhereTheRestContradictsNothing)
{
  // A car park symmetric under half a turn, after a jump: 1.6 % across, 0.1 % elsewhere.
  std::vector<LinkCheck> links;
  for (std::size_t i = 0; i < 20; ++i)
    for (std::size_t k = i + 1; k < std::min<std::size_t>(20, i + 5); ++k) {
      const bool is_across = i < 6 && k >= 6;
      links.push_back(is_across ? link(i, k, LinkTrust::kGood, k % 2 == 0 ? 3 : 0, 100)
                                : link(i, k, LinkTrust::kGood, 0, 150));
    }
  const Ties ties = tiesOf(20, links, kTieBackground);
  EXPECT_FALSE(ties.tied[0]);
  EXPECT_TRUE(ties.tied[19]);
}

TEST(Ties, OfPartsInAnyOrderAreCutAtTheLinkThatHolds)
{
  // Even and odd scans: no part of scans that follow each other.
  std::vector<LinkCheck> links;
  for (std::size_t i = 0; i + 2 < 12; ++i)
    links.push_back(link(i, i + 2));
  links.push_back(link(4, 7, LinkTrust::kGood, 3, 98));
  const Ties ties = tiesOf(12, links, kTieBackground);
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_EQ(ties.tied[i], i % 2 == 0) << i;
}

TEST(Ties, HoldThroughALinkWhoseRaysAbstain)
{
  EXPECT_EQ(triangles({link(2, 3, LinkTrust::kUnverified, 0, 0)}).tied, kAll);
}

TEST(Ties, AreNotWeakOrWrongLinks)
{
  EXPECT_EQ(triangles({link(2, 3, LinkTrust::kWeak)}).tied, kFirstThree);
  EXPECT_EQ(triangles({link(2, 3, LinkTrust::kWrong, 200, 300)}).tied, kFirstThree);
  EXPECT_EQ(triangles({}).tied, kFirstThree);
}

TEST(Ties, KeepTheLargerPart)
{
  const Ties ties = tiesOf(4, {link(1, 2), link(2, 3)}, kTieBackground);
  EXPECT_EQ(ties.tied, (std::vector<bool>{false, true, true, true}));
}

TEST(Ties, OfALongChainAreFoundWithoutRecursion)
{
  std::vector<LinkCheck> links;
  for (std::size_t i = 0; i + 1 < 3000; ++i)
    links.push_back(link(i, i + 1));
  links[1000] = link(1000, 1001, LinkTrust::kGood, 3, 100);
  const Ties ties = tiesOf(3000, links, kTieBackground);
  EXPECT_FALSE(ties.tied[1000]);
  EXPECT_TRUE(ties.tied[1001]);
  EXPECT_TRUE(tiesOf(0, {}, kTieBackground).tied.empty());
}

// Three scans of a crowd, where one patch in twenty is contradicted, and a fourth with its links.
TEST(Ties, ACutBetweenOtherScansDoesNotContradictAScan)
{
  using pcl6d::verification::contradictionOfScan;
  const std::size_t scan = 3, rest = 4;
  const auto links_of = [&](std::size_t contradicted) {
    std::vector<LinkCheck> links;
    for (std::size_t k = 0; k < scan; ++k) {
      links.push_back(link(k, scan, LinkTrust::kGood, contradicted));
      links.push_back(link(k, rest, LinkTrust::kGood, 0, 0));
    }
    links.back().patches = 600; // the links between the three
    links.back().contradicted = 30;
    return links;
  };
  constexpr double kRatherWrong = 0.5, kOfCrowd = 0.04;
  EXPECT_FALSE(
      contradictionOfScan(scan, rest + 1, links_of(16), kOfCrowd, kRatherWrong));
  const auto found =
      contradictionOfScan(scan, rest + 1, links_of(90), kOfCrowd, kRatherWrong);
  EXPECT_EQ(found.reason, pcl6d::RejectReason::kInconsistentTogether);
  EXPECT_EQ(found.measured, 270);
  EXPECT_EQ(found.needed, 900);
  // All parts tested: a cut with every link leaves none for a background.
  EXPECT_TRUE(tiesOf(rest + 1, links_of(16), kOfCrowd).cut_from[scan]);
}

TEST(Ties, AreNotScansOfAWrongPlaceThatAreNotConsecutive)
{
  // Scans 3, 10, 11 and 12 lie in an equal room: their links with each other contradict nothing, those
  // with the rest 1.5 %.
  const auto isDisplaced = [](std::size_t i) { return i == 3 || i >= 10; };
  std::vector<LinkCheck> links;
  for (std::size_t i = 0; i < 13; ++i)
    for (std::size_t k = i + 1; k < 13; ++k)
      if (k < i + 5 || i == 3) {
        const bool is_across = isDisplaced(i) != isDisplaced(k);
        links.push_back(link(i, k, LinkTrust::kGood, is_across ? 3 : 0, 200));
      }
  const Ties ties = tiesOf(13, links, kTieBackground);
  for (std::size_t i = 0; i < 13; ++i)
    EXPECT_EQ(ties.tied[i], !isDisplaced(i)) << i;
}

TEST(Ties, WithTheConstantsInUseAreThoseWithoutConstants)
{
  const std::vector<LinkCheck> links = {link(0, 1),
                                        link(1, 2),
                                        link(0, 2),
                                        link(3, 4),
                                        link(4, 5),
                                        link(3, 5),
                                        link(2, 3, LinkTrust::kGood, 2, 98)};
  const auto tied = [&](const pcl6d::verification::CutConstants& constants) {
    return tiesOf(6, links, kTieBackground, constants).tied;
  };
  pcl6d::verification::CutConstants constants = pcl6d::verification::cutConstants();
  EXPECT_EQ(tied(constants), kFirstThree);
  constants.cut_from = 1.1; // no probability is that large
  EXPECT_EQ(tied(constants), kAll);
  constants = pcl6d::verification::cutConstants();
  constants.least_background = 0.02; // as many contradictions as the link has
  EXPECT_EQ(tied(constants), kAll);
}
