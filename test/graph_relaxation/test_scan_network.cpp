// SPDX-License-Identifier: BSD-3-Clause
#include "network_scans.h"
#include "support/bits.h"
#include "support/points.h"

#include <pcl6d/graph_relaxation/graph_slam.h>
#include <pcl6d/graph_relaxation/scan_network.h>

using pcl6d::IcpModel;
using pcl6d::LinkKind;
using pcl6d::LinkPairs;
using pcl6d::LinkRule;
using pcl6d::Metric;
using pcl6d::NetworkScan;
using pcl6d::Points;
using pcl6d::Poses;
using pcl6d::ScanLink;
using pcl6d::ScanNetwork;
using pcl6d::ScanNetworkOptions;
using pcl6d::ScanPair;
using pcl6d::test::badArgumentOf;
using pcl6d::test::NetworkScans;
using pcl6d::test::shifted;

namespace {

/** Copies of a row of 100 points along x, a metre apart: shifted by k metres, two of them
 * share 100 - k points. */
class Rows {
public:
  explicit Rows(std::size_t count)
  : model_(row(), {}), scans(count, NetworkScan(model_))
  {}

private:
  static Points
  row()
  {
    Points points;
    for (int i = 0; i < 100; ++i)
      points.emplace_back(static_cast<float>(i), 0.f, 0.f);
    return points;
  }
  IcpModel model_;

public:
  std::vector<NetworkScan> scans;
};

ScanNetworkOptions
by(LinkRule rule)
{
  ScanNetworkOptions options;
  options.rule = rule;
  return options;
}

std::vector<ScanPair>
linksOf(ScanNetwork& network, const Poses& poses)
{
  std::vector<ScanPair> links;
  for (const LinkPairs& link : network.pairs(poses))
    links.emplace_back(link.from, link.to);
  return links;
}

const std::vector<ScanPair> kNone, kBoth{{0, 1}};
} // namespace

TEST(LinkRule, HasNames)
{
  EXPECT_EQ(pcl6d::linkRuleNames(), (std::vector<std::string>{"overlap", "distance"}));
  for (const auto& name : pcl6d::linkRuleNames())
    EXPECT_EQ(toString(pcl6d::linkRuleFromName(name)), name);
  EXPECT_NE(badArgumentOf([] { pcl6d::linkRuleFromName("near"); }).find("overlap|dist"),
            std::string::npos);
}

TEST(ScanNetwork, LinksByOverlapAndKeepsALinkUntilATenthBelow)
{
  const Rows rows(2);
  ScanNetwork network(rows.scans, {true, true}, by(LinkRule::kOverlap));
  const auto linked = [&](double x) {
    return linksOf(network, {shifted(0), shifted(x)}) == kBoth;
  };
  EXPECT_FALSE(linked(41)) << "overlap 0.59";
  EXPECT_TRUE(linked(40)) << "0.60";
  EXPECT_TRUE(linked(45)) << "0.55: stays";
  EXPECT_FALSE(linked(47)) << "0.53";
  EXPECT_FALSE(linked(45)) << "0.55: does not come back";
  EXPECT_TRUE(linked(39));
}

TEST(ScanNetwork, LinksByDistanceAndKeepsALinkUntilATenthBeyond)
{
  const Rows rows(2);
  ScanNetwork network(rows.scans, {true, true}, by(LinkRule::kDistance));
  const auto linked = [&](double x) {
    return linksOf(network, {shifted(0), shifted(x)}) == kBoth;
  };
  EXPECT_FALSE(linked(7.6));
  EXPECT_TRUE(linked(7.4));
  EXPECT_TRUE(linked(8.2));
  EXPECT_FALSE(linked(8.3));
  EXPECT_FALSE(linked(8.2));
}

TEST(ScanNetwork, PairsPointsThatAreNearAtThePoses)
{
  const Rows rows(2);
  ScanNetworkOptions options;
  ScanNetwork network(rows.scans, {true, true}, options);
  const auto links = network.pairs({shifted(0), shifted(30.1)});
  ASSERT_EQ(links.size(), 1u);
  ASSERT_EQ(links[0].points_to.size(), 70u);
  ASSERT_EQ(links[0].points_from.size(), 70u);
  for (std::size_t k = 0; k < 70; ++k)
    EXPECT_EQ(links[0].points_from[k].x() - links[0].points_to[k].x(), 30);
  EXPECT_TRUE(links[0].norms.empty()) << "of the metric point";
  EXPECT_FALSE(links[0].trusted);

  options.points_per_link = 30;
  ScanNetwork fewer(rows.scans, {true, true}, options);
  EXPECT_EQ(fewer.pairs({shifted(0), shifted(0)})[0].points_to.size(), 25u);
}

TEST(ScanNetwork, LastRoundLooksAtAsManyPointsAsTheRoundsBefore)
{
  const Rows rows(2);
  ScanNetworkOptions options;
  options.points_per_link = 10;
  const Poses poses{shifted(0), shifted(0)};
  for (const auto& [rounds, points] : {std::pair(0, 10), {1, 10}, {3, 25}, {20, 100}}) {
    ScanNetwork network(rows.scans, {true, true}, options);
    for (int round = 0; round < rounds; ++round) {
      const LinkPairs link = network.pairs(poses)[0];
      EXPECT_EQ(link.points_to.size(), 10u);
      EXPECT_EQ(link.redundancy, 1);
    }
    const LinkPairs link = network.pairsOfLastRound(poses)[0];
    EXPECT_EQ(link.points_to.size(), static_cast<std::size_t>(points)) << rounds;
    EXPECT_EQ(link.points_from.size(), link.points_to.size());
    EXPECT_EQ(link.redundancy, points / 10.0)
        << "counts as the pairs of a round before";
    EXPECT_EQ(network.pairs(poses)[0].points_to.size(), 10u);
  }
}

TEST(ScanNetwork, LeavesOutScansThatAreNotUsable)
{
  const Rows rows(3);
  ScanNetwork network(rows.scans, {true, false, true}, {});
  EXPECT_EQ(linksOf(network, {shifted(0), shifted(1), shifted(2)}),
            (std::vector<ScanPair>{{0, 2}}));
}

TEST(ScanNetwork, KeepsLinksThatAreGiven)
{
  const Rows rows(3);
  ScanNetwork network(rows.scans, {true, true, true}, {});
  network.keep(2, 0, LinkKind::kLoop, true);
  network.keep(0, 2, LinkKind::kSequence, false); // the first word counts
  const Poses poses{shifted(0), shifted(1), shifted(300)};
  const auto links = network.pairs(poses);
  ASSERT_EQ(links.size(), 2u);
  EXPECT_EQ(links[1].from, 0u);
  EXPECT_EQ(links[1].to, 2u);
  EXPECT_TRUE(links[1].trusted);
  EXPECT_TRUE(links[1].points_from.empty()) << "nothing is near";
  const auto described = network.describe(poses);
  ASSERT_EQ(described.size(), 2u);
  EXPECT_EQ(described[0].kind, LinkKind::kNetwork);
  EXPECT_EQ(described[1].kind, LinkKind::kLoop);
  EXPECT_EQ(described[1].pairs, 0u);
  EXPECT_EQ(described[1].overlap, 0);
}

TEST(ScanNetwork, DescribesItsLinks)
{
  const Rows rows(2);
  ScanNetwork network(rows.scans, {true, true}, {});
  const Poses poses{shifted(0), shifted(30.125)};
  EXPECT_TRUE(network.describe(poses).empty()) << "none chosen yet";
  network.pairs(poses);
  const std::vector<ScanLink> links = network.describe(poses);
  ASSERT_EQ(links.size(), 1u);
  EXPECT_EQ(links[0].pairs, 70u);
  EXPECT_DOUBLE_EQ(links[0].overlap, 0.7);
  EXPECT_NEAR(links[0].rms, 0.125, 1e-6);
  EXPECT_DOUBLE_EQ(links[0].distance, 30.125);
  EXPECT_EQ(links[0].verdict, pcl6d::LinkVerdict::kUsed);
}

TEST(ScanNetwork, KeepsNoLinkOfAScanThatIsNotUsable)
{
  const Rows rows(3);
  ScanNetwork network(rows.scans, {true, false, true}, {});
  network.keep(0, 1, LinkKind::kGiven, true);
  const pcl6d::Poses poses(3, shifted(0));
  for (const auto& link : network.pairs(poses))
    EXPECT_TRUE(link.from != 1 && link.to != 1);
  const auto links = network.describe(poses);
  ASSERT_FALSE(links.empty());
  EXPECT_EQ(links[0].from, 0u);
  EXPECT_EQ(links[0].to, 1u);
  EXPECT_EQ(links[0].verdict, pcl6d::LinkVerdict::kRefused);
  EXPECT_EQ(links[0].rejection.reason, pcl6d::RejectReason::kScanUnregistered);
}

TEST(ScanNetwork, RefusesWhatCannotBe)
{
  const Rows rows(2);
  EXPECT_NE(badArgumentOf([&] { ScanNetwork(rows.scans, {true}, {}); }).find("usable"),
            std::string::npos);
  ScanNetwork network(rows.scans, {true, true}, {});
  for (const auto& [a, b] : {ScanPair{0, 2}, ScanPair{2, 0}, ScanPair{1, 1}})
    EXPECT_NE(badArgumentOf(
                  [&, a = a, b = b] { network.keep(a, b, LinkKind::kGiven, false); }),
              "");
  EXPECT_NE(badArgumentOf([&] { network.pairs({shifted(0)}); }).find("poses"),
            std::string::npos);
  ScanNetworkOptions plane;
  plane.metric = Metric::kPlane;
  EXPECT_NE(badArgumentOf([&] {
              ScanNetwork(rows.scans, {true, true}, plane);
            }).find("normals"),
            std::string::npos);
}

TEST(ScanNetworkOptions, NamesTheFieldThatBreaksItsRule)
{
  const auto expectRefused = [](const std::string& name, const auto& change) {
    ScanNetworkOptions options;
    change(options);
    EXPECT_NE(badArgumentOf([&] { options.validate(); }).find(name), std::string::npos)
        << name;
  };
  EXPECT_NO_THROW(ScanNetworkOptions().validate());
  expectRefused("max_distance", [](auto& o) { o.max_distance = 0; });
  expectRefused("min_overlap", [](auto& o) { o.min_overlap = 1.1; });
  expectRefused("min_overlap", [](auto& o) { o.min_overlap = -0.1; });
  expectRefused("link_distance", [](auto& o) { o.link_distance = 0; });
  expectRefused("points_per_link", [](auto& o) { o.points_per_link = 0; });
  expectRefused("gicp_epsilon", [](auto& o) { o.gicp_epsilon = 0; });
  expectRefused("gicp_epsilon", [](auto& o) { o.gicp_epsilon = 2; });
}

TEST(ScanNetwork, RemembersNoPartnerThatASearchWouldNotFind)
{
  // A fresh network searches for all partners; the other one remembers those of poses before.
  const NetworkScans room = pcl6d::test::scansFrom(pcl6d::test::ringPoses(4));
  Poses poses = room.truth;
  ScanNetworkOptions options;
  options.min_overlap = 0.2;
  options.max_distance = 0.4;
  ScanNetwork remembering(room.scans, std::vector<bool>(4, true), options);
  pcl6d::Random random(3);
  for (int round = 0; round < 12; ++round) {
    ScanNetwork fresh(room.scans, std::vector<bool>(4, true), options);
    const auto expected = fresh.pairs(poses), found = remembering.pairs(poses);
    for (const LinkPairs& link : found) {
      const auto same =
          std::find_if(expected.begin(), expected.end(), [&](const LinkPairs& other) {
            return other.from == link.from && other.to == link.to;
          });
      if (same == expected.end())
        continue; // kept until a tenth below
      ASSERT_EQ(link.points_from.size(), same->points_from.size()) << round;
      for (std::size_t i = 0; i < link.points_from.size(); ++i) {
        ASSERT_EQ(link.points_from[i], same->points_from[i]) << round;
        ASSERT_EQ(link.points_to[i], same->points_to[i]) << round;
      }
    }
    // From motions within what is remembered to far beyond it.
    const double size = 0.002 * (1 << (round % 9));
    for (std::size_t i = 1; i < poses.size(); ++i)
      poses[i] =
          poses[i] * pcl6d::poseFromEuler({random.uniform(-size, size),
                                           random.uniform(-size, size),
                                           random.uniform(-size, size)},
                                          {0, 0, random.uniform(-size, size) / 4});
  }
}
