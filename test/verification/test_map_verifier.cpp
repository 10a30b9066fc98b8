// SPDX-License-Identifier: BSD-3-Clause
#include "support/loose_scans.h"
#include "support/points.h"
#include "verified_rooms.h"

#include <pcl6d/verification/map_verifier.h>

#include <set>
#include <string>
#include <vector>

using pcl6d::LinkCheck;
using pcl6d::LinkTrust;
using pcl6d::MapTrust;
using pcl6d::MapVerification;
using pcl6d::MapVerifier;
using pcl6d::MapVerifierOptions;
using pcl6d::Random;
using pcl6d::RejectReason;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::kRoomScans;
using pcl6d::test::looseOf;
using pcl6d::test::namesOf;
using pcl6d::test::PillarRoom;
using pcl6d::test::roomPoses;
using pcl6d::test::shifted;
using pcl6d::test::VerifiedScans;
using Poses = std::vector<Eigen::Isometry3d>;
using Vector = Eigen::Vector3d;

namespace {
/** \brief A chain of scans of a room, made once for all tests. */
class MapOfARoom : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    scans = new VerifiedScans;
    Random random(11);
    for (const auto& pose : roomPoses())
      scans->add(PillarRoom().scan(pose, random, 0.04));
  }
  static void
  TearDownTestSuite()
  {
    delete scans;
    scans = nullptr;
  }
  static MapVerification
  verified(const Poses& poses, const MapVerifierOptions& options = {})
  {
    return MapVerifier(scans->all(), namesOf(kRoomScans), options).verify(poses);
  }
  static VerifiedScans* scans;
};
VerifiedScans* MapOfARoom::scans = nullptr;

void
expectSame(const MapVerification& a, const MapVerification& b)
{
  EXPECT_EQ(a.trust, b.trust);
  EXPECT_EQ(a.background, b.background);
  EXPECT_EQ(a.doubts, b.doubts);
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t k = 0; k < a.links.size(); ++k) {
    const LinkCheck &of_a = a.links[k], &of_b = b.links[k];
    EXPECT_EQ(of_a.from, of_b.from);
    EXPECT_EQ(of_a.to, of_b.to);
    EXPECT_EQ(of_a.trust, of_b.trust);
    EXPECT_EQ(of_a.probability_wrong, of_b.probability_wrong);
    EXPECT_EQ(of_a.patches, of_b.patches);
    EXPECT_EQ(of_a.contradicted, of_b.contradicted);
    EXPECT_EQ(of_a.shift, of_b.shift);
    EXPECT_EQ(of_a.deviation, of_b.deviation);
    EXPECT_EQ(of_a.rejection, of_b.rejection);
  }
}
} // namespace

TEST_F(MapOfARoom, IsGoodAtTheTruth)
{
  const MapVerification map = verified(roomPoses());
  EXPECT_EQ(map.trust, MapTrust::kGood);
  EXPECT_TRUE(map.trusted());
  EXPECT_TRUE(map.doubts.empty());
  EXPECT_GE(map.links.size(), kRoomScans - 1);
  EXPECT_EQ(map.count(LinkTrust::kGood), map.links.size());
  ASSERT_EQ(map.scans.size(), kRoomScans);
  for (const auto& scan : map.scans) {
    EXPECT_TRUE(scan.tied);
    EXPECT_FALSE(scan.abstains);
    EXPECT_FALSE(scan.doubt) << scan.doubt;
  }
}

TEST_F(MapOfARoom, IsNotProbedUnlessItIsKept)
{
  for (const bool is_kept : {true, false}) {
    std::vector<bool> asked;
    MapVerifierOptions options;
    options.is_kept = [&](const std::vector<bool>& connected) {
      asked = connected;
      return is_kept;
    };
    const MapVerification map = verified(roomPoses(), options);
    expectSame(map, verified(roomPoses())); // links and trust
    EXPECT_EQ(asked, std::vector<bool>(kRoomScans, true));
    for (const auto& scan : map.scans)
      EXPECT_EQ(scan.noticed.has_value(), is_kept);
  }
}

TEST_F(MapOfARoom, TakesOverLinksWithTheSamePoseFromTheVerdictBefore)
{
  pcl6d::LinkMemory memory;
  MapVerifierOptions options;
  options.memory = &memory;
  const MapVerification first = verified(roomPoses(), options);
  EXPECT_EQ(memory.size(), first.links.size());
  expectSame(verified(roomPoses(), options), first);
  for (auto& [pair, evidence] : memory)
    evidence.sight.confirmed_patches = evidence.sight.patches = 7;
  for (const LinkCheck& link : verified(roomPoses(), options).links)
    EXPECT_EQ(link.patches, 7U) << "not tested again";
  Poses moved = roomPoses();
  moved[1].translation().x() += 1e-12;
  for (const LinkCheck& link : verified(moved, options).links)
    EXPECT_EQ(link.patches != 7, link.from == 1 || link.to == 1)
        << link.from << " and " << link.to;
}

TEST(MapOfAnEmptyRoom, IsNotSearchedForSecondPosesUnlessItIsKept)
{
  PillarRoom room; // half a turn maps it to itself
  room.pillars.clear();
  Random random(14);
  VerifiedScans scans;
  for (const auto& pose : roomPoses())
    scans.add(room.scan(pose, random, 0.04));
  for (const bool is_kept : {true, false}) {
    MapVerifierOptions options;
    options.unsure.assign(kRoomScans, true);
    options.is_kept = [&](const std::vector<bool>&) { return is_kept; };
    const MapVerification map =
        MapVerifier(scans.all(), namesOf(kRoomScans), options).verify(roomPoses());
    EXPECT_EQ(map.trust, is_kept ? MapTrust::kAmbiguous : MapTrust::kGood);
    for (const auto& scan : map.scans)
      EXPECT_TRUE(scan.tied);
  }
}

TEST_F(MapOfARoom, JudgesEachScanWithTheOneBeforeAndAFewMore)
{
  MapVerifierOptions options;
  options.links_per_scan = 1;
  const MapVerification few = verified(roomPoses(), options);
  EXPECT_EQ(few.links.size(), (kRoomScans - 1) + (kRoomScans - 2));
  const MapVerification all = verified(roomPoses());
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (const LinkCheck& link : all.links) {
    EXPECT_LT(link.from, link.to);
    EXPECT_TRUE(pairs.emplace(link.from, link.to).second) << "each once";
  }
  EXPECT_EQ(pairs.size(), kRoomScans * (kRoomScans - 1) / 2) << "all see all";
}

TEST_F(MapOfARoom, NamesTheScanThatIsDisplacedAndNoOther)
{
  for (std::size_t i = 0; i < kRoomScans; ++i) {
    SCOPED_TRACE(i);
    Poses poses = roomPoses();
    poses[i] = shifted(poses[i], {0.6, 0.7, 0.3});
    const MapVerification map = verified(poses);
    EXPECT_EQ(map.trust, MapTrust::kDoubtful);
    EXPECT_FALSE(map.trusted());
    EXPECT_EQ(looseOf(map), std::set<std::size_t>{i});
    ASSERT_EQ(map.doubts.size(), 1u);
    EXPECT_EQ(map.doubts[0].reason, RejectReason::kScansDisconnected);
    EXPECT_EQ(map.doubts[0].measured, 1);
    EXPECT_EQ(map.doubts[0].text, "scan " + std::to_string(i));
    EXPECT_EQ(map.doubts[0].causes.at(0).reason, RejectReason::kLinkNotConsistent);
    for (std::size_t k = 0; k < kRoomScans; ++k)
      EXPECT_EQ(static_cast<bool>(map.scans[k].doubt), k == i) << k;
  }
}

TEST_F(MapOfARoom, NamesTheSmallerPartBehindABreak)
{
  for (const std::size_t first_behind : {2u, 4u}) {
    Poses poses = roomPoses();
    for (std::size_t i = first_behind; i < kRoomScans; ++i)
      poses[i] = shifted(poses[i], {0.6, 0.7, 0.3});
    const MapVerification map = verified(poses);
    EXPECT_EQ(map.trust, MapTrust::kDoubtful);
    EXPECT_EQ(looseOf(map),
              first_behind == 2 ? (std::set<std::size_t>{0, 1})
                                : (std::set<std::size_t>{4, 5}));
    EXPECT_EQ(map.doubts[0].reason, RejectReason::kScansDisconnected);
    EXPECT_EQ(map.doubts[0].measured, 2) << map.doubts[0];
  }
}

TEST_F(MapOfARoom, OfEqualPartsKeepsThatOfTheFirstScan)
{
  Poses poses = roomPoses();
  for (std::size_t i = kRoomScans / 2; i < kRoomScans; ++i)
    poses[i] = shifted(poses[i], {0.6, 0.7, 0.3});
  EXPECT_EQ(looseOf(verified(poses)), (std::set<std::size_t>{3, 4, 5}));
}

TEST_F(MapOfARoom, DoesNotDependOnWhereItStands)
{
  const Eigen::Isometry3d motion =
      pcl6d::poseFromEuler({300, -200, 50}, {0.3, -0.2, 2});
  Poses poses = roomPoses();
  poses[2] = shifted(poses[2], {0.3, 0, 0});
  const MapVerification expected = verified(poses);
  for (auto& pose : poses)
    pose = motion * pose;
  const MapVerification moved = verified(poses);
  EXPECT_EQ(moved.trust, expected.trust);
  EXPECT_EQ(looseOf(moved), looseOf(expected));
  ASSERT_EQ(moved.links.size(), expected.links.size());
  for (std::size_t k = 0; k < moved.links.size(); ++k) {
    EXPECT_EQ(moved.links[k].trust, expected.links[k].trust);
    EXPECT_NEAR(
        moved.links[k].probability_wrong, expected.links[k].probability_wrong, 1e-3);
  }
}

TEST_F(MapOfARoom, HasTheSameBitsForAnyNumberOfThreads)
{
  Poses poses = roomPoses();
  poses[3] = shifted(poses[3], {0.2, 0.1, 0});
  MapVerifierOptions options;
  options.num_threads = 1;
  const MapVerification expected = verified(poses, options);
  for (const unsigned int threads : {2u, 8u, 0u}) {
    options.num_threads = threads;
    expectSame(verified(poses, options), expected);
  }
}

TEST_F(MapOfARoom, GivesTheEvidenceOfItsLinks)
{
  MapVerifier verifier(scans->all(), namesOf(kRoomScans));
  const MapVerification map = verifier.verify(roomPoses());
  ASSERT_EQ(verifier.evidence().size(), map.links.size());
  for (std::size_t k = 0; k < map.links.size(); ++k) {
    EXPECT_EQ(verifier.evidence()[k].sight.patches, map.links[k].patches);
    EXPECT_EQ(verifier.evidence()[k].leaving(), map.links[k].shift);
    EXPECT_EQ(verifier.evidence()[k].deviation(), map.links[k].deviation);
  }
  EXPECT_EQ(map.background, contradictionBackground(verifier.evidence()));
}

TEST_F(MapOfARoom, InFeetOnPosesInMetresIsDoubtful)
{
  Poses poses = roomPoses();
  for (auto& pose : poses)
    pose.translation() /= 0.3048;
  EXPECT_EQ(verified(poses).trust, MapTrust::kDoubtful);
}

TEST_F(MapOfARoom, MirroredOrTurnedByHalfATurnIsDoubtful)
{
  Poses mirrored = roomPoses(), turned = roomPoses();
  for (std::size_t i = 0; i < kRoomScans; ++i) {
    // Poses of a left-handed frame, read as right-handed: y turned round.
    const Vector t = mirrored[i].translation();
    Eigen::Matrix3d R = mirrored[i].linear();
    const Eigen::Matrix3d M = Vector(1, -1, 1).asDiagonal();
    R = M * R * M;
    mirrored[i].linear() = R;
    mirrored[i].translation() = M * t;
    turned[i] = turned[i] * Eigen::AngleAxisd(M_PI, Vector::UnitZ());
  }
  EXPECT_EQ(verified(mirrored).trust, MapTrust::kDoubtful);
  EXPECT_EQ(verified(turned).trust, MapTrust::kDoubtful);
}

TEST_F(MapOfARoom, DoesNotConnectAnUnregisteredScanEvenAtTheTruth)
{
  MapVerifierOptions options;
  options.unregistered.assign(kRoomScans, false);
  EXPECT_EQ(verified(roomPoses(), options).trust, MapTrust::kGood);
  options.unregistered[2] = true;
  const MapVerification map = verified(roomPoses(), options);
  EXPECT_EQ(map.count(LinkTrust::kGood), map.links.size()) << "links are still tested";
  for (std::size_t i = 0; i < kRoomScans; ++i) {
    EXPECT_EQ(map.scans[i].tied, i != 2) << i;
    EXPECT_EQ(map.scans[i].doubt.reason,
              i == 2 ? RejectReason::kScanUnregistered : RejectReason::kNone)
        << i;
  }
  EXPECT_EQ(map.trust, MapTrust::kDoubtful);
  ASSERT_EQ(map.doubts.size(), 1U);
  EXPECT_EQ(map.doubts[0].reason, RejectReason::kScansDisconnected);
  EXPECT_EQ(map.doubts[0].text, "scan 2");
}

TEST(MapOfTwoScans, AnUnregisteredFirstScanIsNotConnected)
{
  const PillarRoom room;
  Random random(12);
  VerifiedScans scans;
  Poses poses;
  for (const std::size_t pose : {0U, 1U}) {
    scans.add(room.scan(roomPoses()[pose], random, 0.04));
    poses.push_back(roomPoses()[pose]);
  }
  MapVerifierOptions options;
  options.unregistered = {true, false};
  const MapVerification map =
      MapVerifier(scans.all(), namesOf(poses.size()), options).verify(poses);
  EXPECT_FALSE(map.scans[0].tied);
}

TEST(MapOfTwoRooms, IsNotConnectedByAnUnregisteredScan)
{
  // Two rooms 30 m apart, with three and two scans; scan 3 has the points of both rooms, so that its
  // links to either room are consistent.
  const Eigen::Isometry3d T_world_other(Eigen::Translation3d(30, 0, 0));
  const PillarRoom room;
  Random random(12);
  VerifiedScans scans;
  Poses poses;
  const auto add = [&](std::size_t pose, const Eigen::Isometry3d& T_world_room) {
    scans.add(room.scan(roomPoses()[pose], random, 0.04));
    poses.push_back(T_world_room * roomPoses()[pose]);
  };
  for (const std::size_t pose : {0U, 1U, 2U})
    add(pose, Eigen::Isometry3d::Identity());
  pcl6d::Points both = room.scan(roomPoses()[3], random, 0.04);
  for (const auto& p : room.scan(roomPoses()[3], random, 0.04))
    both.push_back(
        (roomPoses()[3].inverse() * T_world_other * roomPoses()[3] * p.cast<double>())
            .cast<float>());
  scans.add(both);
  poses.push_back(roomPoses()[3]);
  for (const std::size_t pose : {4U, 5U})
    add(pose, T_world_other);
  MapVerifierOptions options;
  options.unregistered.assign(poses.size(), false);
  const auto connected = [&] {
    const MapVerification map =
        MapVerifier(scans.all(), namesOf(poses.size()), options).verify(poses);
    std::vector<bool> tied;
    for (const auto& scan : map.scans)
      tied.push_back(scan.tied);
    return tied;
  };
  EXPECT_EQ(connected(), std::vector<bool>(6, true));
  options.unregistered[3] = true;
  EXPECT_EQ(connected(), (std::vector<bool>{true, true, true, false, false, false}));
}

TEST_F(MapOfARoom, RefusesWrongNumbersOfNamesAndPosesAndLinks)
{
  EXPECT_EQ(badArgumentOf([&] { MapVerifier(scans->all(), namesOf(2)); }),
            "names = 2, but must be one per scan");
  MapVerifier verifier(scans->all(), namesOf(kRoomScans));
  EXPECT_EQ(badArgumentOf([&] { verifier.verify(Poses(2, roomPoses()[0])); }),
            "poses = 2, but must be one per scan");
  MapVerifierOptions options;
  options.links_per_scan = 0;
  EXPECT_EQ(
      badArgumentOf([&] { MapVerifier(scans->all(), namesOf(kRoomScans), options); }),
      "links_per_scan = 0, but must be > 0");
  options = {};
  options.unregistered.assign(2, true);
  EXPECT_EQ(
      badArgumentOf([&] { MapVerifier(scans->all(), namesOf(kRoomScans), options); }),
      "unregistered = 2, but must be empty or equal to the number of scans");
}

TEST_F(MapOfARoom, RefusesAPoseThatIsNoMotion)
{
  MapVerifier verifier(scans->all(), namesOf(kRoomScans));
  Poses poses = roomPoses();
  poses[1].translation().x() = kNan;
  EXPECT_EQ(badArgumentOf([&] { verifier.verify(poses); }),
            "scan 1: the pose is not a rigid motion");
  poses = roomPoses();
  poses[2].linear().col(1) *= -1;
  EXPECT_EQ(badArgumentOf([&] { verifier.verify(poses); }),
            "scan 2: the pose is not a rigid motion");
}
