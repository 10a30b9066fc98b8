// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/map_verification.h>

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace pcl6d {
namespace {

constexpr LinkTrust kLinks[] = {LinkTrust::kGood,
                                LinkTrust::kWeak,
                                LinkTrust::kUnverified,
                                LinkTrust::kWrong};
constexpr MapTrust kMaps[] = {MapTrust::kGood,
                              MapTrust::kDoubtful,
                              MapTrust::kAmbiguous,
                              MapTrust::kUnverified};

TEST(MapVerification, HasAWordForEachTrust)
{
  std::set<std::string> of_links, of_maps;
  for (const LinkTrust trust : kLinks) {
    EXPECT_EQ(linkTrustFromName(toString(trust)), trust);
    of_links.insert(toString(trust));
  }
  for (const MapTrust trust : kMaps) {
    EXPECT_EQ(mapTrustFromName(toString(trust)), trust);
    of_maps.insert(toString(trust));
  }
  EXPECT_EQ(of_links, (std::set<std::string>{"good", "unverified", "weak", "wrong"}));
  EXPECT_EQ(of_maps,
            (std::set<std::string>{"ambiguous", "doubtful", "good", "unverified"}));
}

TEST(MapVerification, ListsItsWordsWhereOneIsWrong)
{
  const auto expectError = [](auto call, const std::string& message) {
    try {
      call();
      FAIL() << message;
    } catch (const BadArgument& error) {
      EXPECT_EQ(error.what(), message);
    }
  };
  expectError(
      [] { linkTrustFromName("fine"); },
      "trust of a link = fine, but must be one of good, weak, unverified, wrong");
  expectError([] { mapTrustFromName(""); },
              "trust of a map = , but must be one of good, doubtful, ambiguous, "
              "unverified");
}

TEST(MapVerification, IsToBeUsedUnlessSomethingSpeaksAgainstIt)
{
  MapVerification map;
  EXPECT_EQ(map.trust, MapTrust::kUnverified) << "before anything is known";
  for (const MapTrust trust : kMaps) {
    map.trust = trust;
    EXPECT_EQ(map.trusted(),
              trust == MapTrust::kGood || trust == MapTrust::kUnverified);
  }
}

TEST(MapVerification, CountsItsLinks)
{
  MapVerification map;
  EXPECT_EQ(map.count(LinkTrust::kGood), 0u);
  for (int i = 0; i < 6; ++i)
    map.links.emplace_back().trust = i < 3   ? LinkTrust::kGood
                                     : i < 5 ? LinkTrust::kWrong
                                             : LinkTrust::kWeak;
  EXPECT_EQ(map.count(LinkTrust::kGood), 3u);
  EXPECT_EQ(map.count(LinkTrust::kWrong), 2u);
  EXPECT_EQ(map.count(LinkTrust::kWeak), 1u);
  EXPECT_EQ(map.count(LinkTrust::kUnverified), 0u);
}

} // namespace
} // namespace pcl6d
