// SPDX-License-Identifier: BSD-3-Clause
#include "support/loose_scans.h"
#include "support/points.h"
#include "verified_rooms.h"

#include <pcl6d/verification/map_verifier.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

using pcl6d::LinkCheck;
using pcl6d::LinkTrust;
using pcl6d::MapTrust;
using pcl6d::MapVerification;
using pcl6d::MapVerifier;
using pcl6d::MapVerifierOptions;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::kVoxel;
using pcl6d::test::looseOf;
using pcl6d::test::PillarRoom;
using pcl6d::test::shifted;
using pcl6d::test::VerifiedScans;
using Poses = std::vector<Eigen::Isometry3d>;
using Vector = Eigen::Vector3d;

namespace {
constexpr std::size_t kScans = 6;

std::vector<std::string>
namesOf(std::size_t count)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back("scan " + std::to_string(i));
  return names;
}

/** \return a way through the room, up, down and turning */
Poses
way()
{
  Poses poses;
  for (std::size_t i = 0; i < kScans; ++i) {
    const double s = static_cast<double>(i);
    poses.push_back(
        pcl6d::poseFromEuler({-1.5 + s, 0.5 * std::sin(s), 0.1 * std::cos(s)},
                             {0.03 * std::sin(s), 0.02, 0.4 * s}));
  }
  return poses;
}

/** \brief A chain of scans of a room, made once for all tests. */
class MapOfARoom : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    scans = new VerifiedScans;
    Random random(11);
    for (const auto& pose : way())
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
    return MapVerifier(scans->all(), namesOf(kScans), options).verify(poses);
  }
  static VerifiedScans* scans;
};
VerifiedScans* MapOfARoom::scans = nullptr;

/** \return the verdict on other scans at the same poses */
MapVerification
verifiedOf(const VerifiedScans& scans, const Poses& poses)
{
  return MapVerifier(scans.all(), namesOf(scans.all().size())).verify(poses);
}

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
  const MapVerification map = verified(way());
  EXPECT_EQ(map.trust, MapTrust::kGood);
  EXPECT_TRUE(map.trusted());
  EXPECT_TRUE(map.doubts.empty());
  EXPECT_GE(map.links.size(), kScans - 1);
  EXPECT_EQ(map.count(LinkTrust::kGood), map.links.size());
  ASSERT_EQ(map.scans.size(), kScans);
  for (const auto& scan : map.scans) {
    EXPECT_TRUE(scan.tied);
    EXPECT_FALSE(scan.abstains);
    EXPECT_EQ(scan.doubt, "");
  }
}

TEST_F(MapOfARoom, JudgesEachScanWithTheOneBeforeAndAFewMore)
{
  MapVerifierOptions options;
  options.links_per_scan = 1;
  const MapVerification few = verified(way(), options);
  EXPECT_EQ(few.links.size(), (kScans - 1) + (kScans - 2));
  const MapVerification all = verified(way());
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (const LinkCheck& link : all.links) {
    EXPECT_LT(link.from, link.to);
    EXPECT_TRUE(pairs.emplace(link.from, link.to).second) << "each once";
  }
  EXPECT_EQ(pairs.size(), kScans * (kScans - 1) / 2) << "all see all";
}

TEST_F(MapOfARoom, NamesTheScanThatIsDisplacedAndNoOther)
{
  for (std::size_t i = 0; i < kScans; ++i) {
    SCOPED_TRACE(i);
    Poses poses = way();
    poses[i] = shifted(poses[i], {0.6, 0.7, 0.3});
    const MapVerification map = verified(poses);
    EXPECT_EQ(map.trust, MapTrust::kDoubtful);
    EXPECT_FALSE(map.trusted());
    EXPECT_EQ(looseOf(map), std::set<std::size_t>{i});
    ASSERT_EQ(map.doubts.size(), 1u);
    EXPECT_EQ(map.doubts[0].find("1 scan not connected to the rest: scan " +
                                 std::to_string(i) + " (with scan "),
              0u)
        << map.doubts[0];
    for (std::size_t k = 0; k < kScans; ++k)
      EXPECT_EQ(map.scans[k].doubt.empty(), k != i) << k;
  }
}

TEST_F(MapOfARoom, NamesTheSmallerPartBehindABreak)
{
  for (const std::size_t first_behind : {2u, 4u}) {
    Poses poses = way();
    for (std::size_t i = first_behind; i < kScans; ++i)
      poses[i] = shifted(poses[i], {0.6, 0.7, 0.3});
    const MapVerification map = verified(poses);
    EXPECT_EQ(map.trust, MapTrust::kDoubtful);
    EXPECT_EQ(looseOf(map),
              first_behind == 2 ? (std::set<std::size_t>{0, 1})
                                : (std::set<std::size_t>{4, 5}));
    EXPECT_EQ(map.doubts[0].find("2 scans not connected to the rest: "), 0u)
        << map.doubts[0];
  }
}

TEST_F(MapOfARoom, OfEqualPartsKeepsThatOfTheFirstScan)
{
  Poses poses = way();
  for (std::size_t i = kScans / 2; i < kScans; ++i)
    poses[i] = shifted(poses[i], {0.6, 0.7, 0.3});
  EXPECT_EQ(looseOf(verified(poses)), (std::set<std::size_t>{3, 4, 5}));
}

TEST_F(MapOfARoom, DoesNotDependOnWhereItStands)
{
  const Eigen::Isometry3d motion =
      pcl6d::poseFromEuler({300, -200, 50}, {0.3, -0.2, 2});
  Poses poses = way();
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
  Poses poses = way();
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
  MapVerifier verifier(scans->all(), namesOf(kScans));
  const MapVerification map = verifier.verify(way());
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
  Poses poses = way();
  for (auto& pose : poses)
    pose.translation() /= 0.3048;
  EXPECT_EQ(verified(poses).trust, MapTrust::kDoubtful);
}

TEST_F(MapOfARoom, MirroredOrTurnedByHalfATurnIsDoubtful)
{
  Poses mirrored = way(), turned = way();
  for (std::size_t i = 0; i < kScans; ++i) {
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

TEST_F(MapOfARoom, RefusesWrongNumbersOfNamesAndPosesAndLinks)
{
  EXPECT_EQ(badArgumentOf([&] { MapVerifier(scans->all(), namesOf(2)); }),
            "names = 2, but must be one per scan");
  MapVerifier verifier(scans->all(), namesOf(kScans));
  EXPECT_EQ(badArgumentOf([&] { verifier.verify(Poses(2, way()[0])); }),
            "poses = 2, but must be one per scan");
  MapVerifierOptions options;
  options.links_per_scan = 0;
  EXPECT_EQ(badArgumentOf([&] { MapVerifier(scans->all(), namesOf(kScans), options); }),
            "links_per_scan = 0, but must be > 0");
}

TEST_F(MapOfARoom, RefusesAPoseThatIsNoMotion)
{
  MapVerifier verifier(scans->all(), namesOf(kScans));
  Poses poses = way();
  poses[1].translation().x() = kNan;
  EXPECT_EQ(badArgumentOf([&] { verifier.verify(poses); }),
            "scan 1: the pose is not a rigid motion");
  poses = way();
  poses[2].linear().col(1) *= -1;
  EXPECT_EQ(badArgumentOf([&] { verifier.verify(poses); }),
            "scan 2: the pose is not a rigid motion");
}

TEST(MapVerifier, LeavesOneScanUnverified)
{
  VerifiedScans scans;
  Random random(1);
  scans.add(PillarRoom().scan(way()[0], random, 0.05));
  const MapVerification map = verifiedOf(scans, {way()[0]});
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
    poses.push_back(shifted(way()[0], {100.0 * i, 0, 0}));
    scans.add(PillarRoom().scan(way()[0], random, 0.05));
  }
  const MapVerification map = verifiedOf(scans, poses);
  EXPECT_EQ(map.trust, MapTrust::kDoubtful);
  EXPECT_EQ(looseOf(map), (std::set<std::size_t>{1, 2}));
  EXPECT_EQ(map.scans[1].doubt, "with scan 0: only 0 patches of surface in common");
}

TEST(MapVerifier, TiesIdenticalScans)
{
  VerifiedScans scans;
  Random random(1);
  const Points points = PillarRoom().scan(way()[0], random, 0.04);
  for (int i = 0; i < 3; ++i)
    scans.add(points);
  EXPECT_EQ(verifiedOf(scans, Poses(3, way()[0])).trust, MapTrust::kGood);
}

TEST(MapVerifier, NamesEmptyAndTinyScans)
{
  VerifiedScans scans;
  Random random(1);
  for (std::size_t i = 0; i < 3; ++i)
    scans.add(PillarRoom().scan(way()[i], random, 0.04));
  scans.add({});
  scans.add({{1, 2, 1}});
  scans.add(Points(20, {kNan, 0, 0}));
  const MapVerification map = verifiedOf(scans, way());
  EXPECT_EQ(map.trust, MapTrust::kUnverified) << "nothing can tell where they are";
  EXPECT_EQ(looseOf(map), (std::set<std::size_t>{3, 4, 5}));
  EXPECT_EQ(map.doubts.at(0).find("3 scans cannot be verified: "), 0u) << map.doubts[0];
}

TEST(MapVerifier, LeavesScansThatAbstainUnverified)
{
  VerifiedScans scans;
  Random random(1);
  for (std::size_t i = 0; i < 3; ++i) {
    const Points points = PillarRoom().scan(way()[i], random, 0.04);
    scans.add(i == 2 ? pcl6d::test::spoilt(points) : points);
  }
  ASSERT_TRUE(scans[2].abstains());
  // At the place that its own points agree on, if there is any: what is said is not that
  // the map is good.
  const MapVerification map = verifiedOf(scans, {way()[0], way()[1], way()[2]});
  EXPECT_NE(map.trust, MapTrust::kGood);
  EXPECT_TRUE(map.scans[2].abstains);
  EXPECT_EQ(
      map.doubts.back().find("1 scan cannot be verified: too few surfaces, or rays "
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
    scans.add(pcl6d::transformed(PillarRoom().scan(way()[i], random, 0.04), offset));
    poses.push_back(way()[i] * offset.inverse());
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
  EXPECT_EQ(map.doubts[0].find("3 scans not centred on the scanner"), 0u)
      << map.doubts[0];
}

TEST(MapVerifier, DoesNotTieScansThatAbstainAndShareNothing)
{
  VerifiedScans scans;
  Random random(1);
  Poses poses;
  for (int i = 0; i < 2; ++i) {
    scans.add(pcl6d::test::spoilt(PillarRoom().scan(way()[0], random, 0.04)));
    poses.push_back(shifted(way()[0], {100.0 * i, 0, 0}));
  }
  const MapVerification map = verifiedOf(scans, poses);
  EXPECT_EQ(map.trust, MapTrust::kDoubtful);
  EXPECT_EQ(looseOf(map), std::set<std::size_t>{1});
}

TEST(MapVerifier, TellsScansOfOneNameApart)
{
  VerifiedScans scans;
  Random random(1);
  for (std::size_t i = 0; i < 3; ++i)
    scans.add(PillarRoom().scan(way()[i], random, 0.04));
  Poses poses = {way()[0], way()[1], shifted(way()[2], {0.6, 0.7, 0.3})};
  const MapVerification map =
      MapVerifier(scans.all(), {"same", "same", "same"}).verify(poses);
  ASSERT_FALSE(map.doubts.empty());
  EXPECT_EQ(map.doubts[0].find("1 scan not connected to the rest: same (with same: "),
            0u)
      << map.doubts[0];
}
