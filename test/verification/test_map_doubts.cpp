// SPDX-License-Identifier: BSD-3-Clause
// What is said of a map whose links are evaluated.
#include "map_doubts.h"

#include <gtest/gtest.h>

namespace {
using pcl6d::LinkCheck;
using pcl6d::LinkTestResult;
using pcl6d::LinkTrust;
using pcl6d::MapTrust;
using pcl6d::MapVerification;
using pcl6d::RejectReason;
using pcl6d::VerifiedScan;
using pcl6d::verification::MapDoubts;

/** Tied scans in a ring, each with links to the next four, some of which ask for shifts. */
struct Ring {
  explicit Ring(std::size_t count) : scans(count)
  {
    map.scans.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      names.push_back("scan" + std::to_string(i));
      map.scans[i].tied = true;
      for (std::size_t k = 1; k <= 4; ++k) {
        LinkCheck link;
        link.from = i;
        link.to = (i + k) % count;
        link.trust = LinkTrust::kGood;
        map.links.push_back(link);
      }
    }
    test_results.resize(map.links.size());
  }

  /** One link of every eighth scan asks for a shift, that of so many scans in all. */
  void
  contradictBySurfaces(std::size_t wrong)
  {
    for (std::size_t w = 0; w < wrong; ++w) {
      const std::size_t k = 4 * 8 * w;
      map.links[k].trust = LinkTrust::kWrong;
      map.links[k].rejection = {pcl6d::RejectReason::kShifted, 0.3, 0.1};
      test_results[k].elsewhere = 0;
      test_results[k].beside = 1;
    }
  }

  MapVerification
  told() const
  {
    MapVerification result = map;
    MapDoubts(scans, names, test_results).tell(result);
    return result;
  }

  std::deque<VerifiedScan> scans;
  std::vector<std::string> names;
  std::vector<LinkTestResult> test_results;
  MapVerification map;
};
} // namespace

TEST(MapDoubts, AFewOutvotedLinksAreNamedAndManyContradictTheMap)
{
  // 400 links: 4 are expected at most, and three deviations more are 10, with one for luck 11.
  Ring few(100);
  few.contradictBySurfaces(11);
  const MapVerification good = few.told();
  EXPECT_EQ(good.trust, MapTrust::kGood);
  ASSERT_EQ(good.doubts.size(), 1U);
  EXPECT_EQ(good.doubts[0].reason, RejectReason::kSingleLinksContradict);
  EXPECT_EQ(good.doubts[0].measured, 11);
  EXPECT_EQ(good.doubts[0].causes.size(), 11U);

  Ring many(100);
  many.contradictBySurfaces(12);
  const MapVerification doubtful = many.told();
  EXPECT_EQ(doubtful.trust, MapTrust::kDoubtful);
  ASSERT_EQ(doubtful.doubts.size(), 1U);
  EXPECT_EQ(doubtful.doubts[0].reason, RejectReason::kScansContradict);
  ASSERT_EQ(doubtful.doubts[0].causes.size(), 12U);
  EXPECT_EQ(doubtful.doubts[0].causes[0].reason, RejectReason::kOfScans);
  EXPECT_EQ(doubtful.doubts[0].causes[0].text, "scan0 and scan1");
  EXPECT_EQ(toWords(doubtful.doubts[0]).find("scans contradict each other: scan0 and"),
            0U)
      << doubtful.doubts[0];
  EXPECT_EQ(doubtful.scans[0].doubt.reason, RejectReason::kContradictsScan);
  EXPECT_EQ(doubtful.scans[0].doubt.text, "scan1");
}

TEST(MapDoubts, ALinkThatRaysAndSurfacesAreAgainstIsProof)
{
  Ring ring(40);
  ring.contradictBySurfaces(1);
  EXPECT_EQ(ring.told().trust, MapTrust::kGood);
  ring.test_results[0].elsewhere = 1;
  EXPECT_EQ(ring.told().trust, MapTrust::kDoubtful);
}

TEST(MapDoubts, ARightMapIsGoodAndOneScanAloneUnverified)
{
  EXPECT_EQ(Ring(20).told().trust, MapTrust::kGood);
  EXPECT_TRUE(Ring(20).told().doubts.empty());
  Ring one(1);
  one.map.links.clear();
  EXPECT_EQ(one.told().trust, MapTrust::kUnverified);
}

TEST(MapDoubts, ScansNotSearchedForASecondPlaceAreNamedAfterTheDoubtThatDecided)
{
  Ring ring(100);
  ring.map.scans[7].doubt = RejectReason::kSecondPoseNotSought;
  ring.contradictBySurfaces(12); // what decided
  const MapVerification map = ring.told();
  EXPECT_EQ(map.trust, MapTrust::kDoubtful);
  ASSERT_EQ(map.doubts.size(), 2U);
  EXPECT_EQ(map.doubts[0].reason, RejectReason::kScansContradict);
  EXPECT_EQ(map.doubts[1].reason, RejectReason::kSecondPosesNotSought);
  EXPECT_EQ(map.doubts[1].measured, 1);
  EXPECT_EQ(map.doubts[1].text, "scan7");
}

TEST(MapDoubts, AreKnownBeforeSecondPlaces)
{
  const auto isDoubtful = [](const Ring& ring) {
    return MapDoubts(ring.scans, ring.names, ring.test_results).isDoubtful(ring.map);
  };
  Ring few(100), many(100);
  few.contradictBySurfaces(11);
  EXPECT_FALSE(isDoubtful(few));
  many.contradictBySurfaces(12);
  EXPECT_TRUE(isDoubtful(many));
}
