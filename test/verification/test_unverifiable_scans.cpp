// SPDX-License-Identifier: BSD-3-Clause
// Verification of maps with too few scans, or with scans that cannot be verified.
#include "support/loose_scans.h"
#include "support/points.h"
#include "verified_rooms.h"

#include <pcl6d/verification/map_verifier.h>

#include <cmath>
#include <cstdint>
#include <deque>
#include <set>
#include <vector>

using pcl6d::MapTrust;
using pcl6d::MapVerification;
using pcl6d::MapVerifier;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::RejectReason;
using pcl6d::test::kNan;
using pcl6d::test::looseOf;
using pcl6d::test::namesOf;
using pcl6d::test::PillarRoom;
using pcl6d::test::roomPoses;
using pcl6d::test::shifted;
using pcl6d::test::VerifiedScans;
using Poses = std::vector<Eigen::Isometry3d>;

namespace {
/** \return the verdict on other scans at the same poses */
MapVerification
verifiedOf(const VerifiedScans& scans, const Poses& poses)
{
  return MapVerifier(scans.all(), namesOf(scans.all().size())).verify(poses);
}
} // namespace

TEST(MapVerifier, LeavesOneScanUnverified)
{
  VerifiedScans scans;
  Random random(1);
  scans.add(PillarRoom().scan(roomPoses()[0], random, 0.05));
  const MapVerification map = verifiedOf(scans, {roomPoses()[0]});
  EXPECT_EQ(map.trust, MapTrust::kUnverified);
  EXPECT_TRUE(map.trusted());
  EXPECT_TRUE(map.links.empty());
  EXPECT_TRUE(map.scans.at(0).tied);
}

TEST(MapVerifier, LeavesNoScanUnverified)
{
  const MapVerification map = verifiedOf({}, {});
  EXPECT_EQ(map.trust, MapTrust::kUnverified);
  EXPECT_TRUE(map.scans.empty());
}

TEST(MapVerifier, IsNeverGoodWithoutOverlap)
{
  VerifiedScans scans;
  Random random(1);
  Poses poses;
  for (int i = 0; i < 3; ++i) {
    poses.push_back(shifted(roomPoses()[0], {100.0 * i, 0, 0}));
    scans.add(PillarRoom().scan(roomPoses()[0], random, 0.05));
  }
  const MapVerification map = verifiedOf(scans, poses);
  EXPECT_EQ(map.trust, MapTrust::kDoubtful);
  EXPECT_EQ(looseOf(map), (std::set<std::size_t>{1, 2}));
  EXPECT_EQ(map.scans[1].doubt.reason, RejectReason::kLinkNotConsistent);
  EXPECT_EQ(toWords(map.scans[1].doubt),
            "with scan 0: only 0 patches of surface in common");
}

TEST(MapVerifier, TiesIdenticalScans)
{
  VerifiedScans scans;
  Random random(1);
  const Points points = PillarRoom().scan(roomPoses()[0], random, 0.04);
  for (int i = 0; i < 3; ++i)
    scans.add(points);
  EXPECT_EQ(verifiedOf(scans, Poses(3, roomPoses()[0])).trust, MapTrust::kGood);
}

TEST(MapVerifier, NamesEmptyAndTinyScans)
{
  VerifiedScans scans;
  Random random(1);
  for (std::size_t i = 0; i < 3; ++i)
    scans.add(PillarRoom().scan(roomPoses()[i], random, 0.04));
  scans.add({});
  scans.add({{1, 2, 1}});
  scans.add(Points(20, {kNan, 0, 0}));
  const MapVerification map = verifiedOf(scans, roomPoses());
  EXPECT_EQ(map.trust, MapTrust::kUnverified) << "nothing can tell where they are";
  EXPECT_EQ(looseOf(map), (std::set<std::size_t>{3, 4, 5}));
  EXPECT_EQ(map.doubts.at(0).reason, RejectReason::kScansNotVerified);
  EXPECT_EQ(map.doubts[0].measured, 3) << map.doubts[0];
}

TEST(MapVerifier, LeavesScansThatAbstainUnverified)
{
  VerifiedScans scans;
  Random random(1);
  for (std::size_t i = 0; i < 3; ++i) {
    const Points points = PillarRoom().scan(roomPoses()[i], random, 0.04);
    scans.add(i == 2 ? pcl6d::test::spoilt(points) : points);
  }
  ASSERT_TRUE(scans[2].abstains());
  // At the place that its own points agree on, if there is any: what is said is not that
  // the map is good.
  const MapVerification map =
      verifiedOf(scans, {roomPoses()[0], roomPoses()[1], roomPoses()[2]});
  EXPECT_NE(map.trust, MapTrust::kGood);
  EXPECT_TRUE(map.scans[2].abstains);
  EXPECT_EQ(map.doubts.back().reason, RejectReason::kScansNotVerified);
  EXPECT_EQ(toWords(map.doubts.back())
                .find("1 scan cannot be verified: too few surfaces, or rays "
                      "contradicting points of their own scan"),
            0u)
      << map.doubts.back();
}

TEST(MapVerifier, ComparesOnlySurfacesOfCutOutsInACommonFrame)
{
  // The room looks alike after half a turn: with rays from the wrong origin a second pose fits.
  const Eigen::Isometry3d offset(Eigen::Translation3d(6, 31, 49));
  VerifiedScans scans;
  Poses poses;
  Random random(1);
  for (std::size_t i = 0; i < 3; ++i) {
    scans.add(
        pcl6d::transformed(PillarRoom().scan(roomPoses()[i], random, 0.04), offset));
    poses.push_back(roomPoses()[i] * offset.inverse());
  }
  const std::deque<pcl6d::VerifiedScan>& all = scans.all();
  pcl6d::MapVerifierOptions options;
  options.unsure.assign(3, true);
  const MapVerification map =
      pcl6d::MapVerifier(all, {"a", "b", "c"}, options).verify(poses);
  EXPECT_EQ(map.trust, MapTrust::kUnverified);
  EXPECT_TRUE(map.trusted());
  EXPECT_EQ(map.links.size(), 3u) << "a and c are compared, too, by their surfaces";
  for (const auto& scan : map.scans)
    EXPECT_TRUE(scan.tied && scan.abstains && scan.off_centre);
  ASSERT_EQ(map.doubts.size(), 1u);
  EXPECT_EQ(map.doubts[0].reason, RejectReason::kScansOffCentre);
  EXPECT_EQ(map.doubts[0].measured, 3) << map.doubts[0];
}

TEST(MapVerifier, DoesNotTieScansThatAbstainAndShareNothing)
{
  VerifiedScans scans;
  Random random(1);
  Poses poses;
  for (int i = 0; i < 2; ++i) {
    scans.add(pcl6d::test::spoilt(PillarRoom().scan(roomPoses()[0], random, 0.04)));
    poses.push_back(shifted(roomPoses()[0], {100.0 * i, 0, 0}));
  }
  const MapVerification map = verifiedOf(scans, poses);
  EXPECT_EQ(map.trust, MapTrust::kDoubtful);
  EXPECT_EQ(looseOf(map), std::set<std::size_t>{1});
}

TEST(MapVerifier, DoubtsOneOfThreeScansAtAWrongPlace)
{
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    VerifiedScans scans;
    Random random(seed);
    for (std::size_t i = 0; i < 3; ++i)
      scans.add(PillarRoom().scan(roomPoses()[i], random, 0.04));
    Poses poses = roomPoses();
    poses.resize(3);
    EXPECT_EQ(verifiedOf(scans, poses).trust, MapTrust::kGood);
    const double angle = random.uniform(0, 6.2832), away = random.uniform(0.5, 3);
    poses[2] = shifted(poses[2], {away * std::cos(angle), away * std::sin(angle), 0});
    EXPECT_EQ(verifiedOf(scans, poses).trust, MapTrust::kDoubtful) << away << " m";
  }
}

TEST(MapVerifier, TellsScansOfOneNameApart)
{
  VerifiedScans scans;
  Random random(1);
  for (std::size_t i = 0; i < 3; ++i)
    scans.add(PillarRoom().scan(roomPoses()[i], random, 0.04));
  Poses poses = {
      roomPoses()[0], roomPoses()[1], shifted(roomPoses()[2], {0.6, 0.7, 0.3})};
  const MapVerification map =
      MapVerifier(scans.all(), {"same", "same", "same"}).verify(poses);
  ASSERT_FALSE(map.doubts.empty());
  EXPECT_EQ(toWords(map.doubts[0])
                .find("1 scan not connected to the rest: same (with same: "),
            0u)
      << map.doubts[0];
}
