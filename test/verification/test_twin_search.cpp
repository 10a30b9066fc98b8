// SPDX-License-Identifier: BSD-3-Clause
// Second places: in a room that half a turn maps to itself, along a row of shelves, and in
// a room where there is none.
#include "support/bits.h"
#include "support/points.h"
#include "verified_rooms.h"

#include <pcl6d/verification/map_verifier.h>
#include <pcl6d/verification/twin_search.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

using pcl6d::distanceBetween;
using pcl6d::findTwins;
using pcl6d::MapTrust;
using pcl6d::MapVerification;
using pcl6d::MapVerifier;
using pcl6d::MapVerifierOptions;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::RejectReason;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::kVoxel;
using pcl6d::test::PillarRoom;
using pcl6d::test::sameBits;
using pcl6d::test::shifted;
using pcl6d::test::VerifiedScans;
using Poses = std::vector<Eigen::Isometry3d>;
using Vector = Eigen::Vector3d;

namespace {
// Surfaces of points with 5 mm of noise, a voxel apart: matching leaves a third of it.
constexpr double kPlaceTol = kVoxel / 3; // [m]
constexpr double kTurnTol = 0.01;        // [rad] the same at walls 5 m away
// What findTwins() takes for another place.
constexpr double kOther = 6 * kVoxel; // [m]
constexpr double kOtherTurn = 0.2;    // [rad]

/** \brief A room and poses in it, upright within a few degrees. */
struct Scanned {
  explicit Scanned(PillarRoom scanned_room,
                   Poses at = {pcl6d::poseFromEuler({0.2, -0.4, 0.1},
                                                    {0.02, -0.03, 0.5}),
                               pcl6d::poseFromEuler({1.2, 0.9, 0}, {-0.02, 0.03, 2.0})},
                   float range = std::numeric_limits<float>::infinity())
  : room(std::move(scanned_room)), poses(std::move(at))
  {
    Random random(8);
    for (const auto& pose : poses)
      scans.add(pcl6d::test::within(room.scan(pose, random, 0.04), range));
  }

  /** \return T_a_b */
  Eigen::Isometry3d
  known(std::size_t a = 0, std::size_t b = 1) const
  {
    return poses[a].inverse() * poses[b];
  }
  Vector
  up(std::size_t scan = 0) const
  {
    return poses[scan].linear().transpose() * Vector::UnitZ();
  }
  std::vector<Eigen::Isometry3d>
  twins() const
  {
    return findTwins(scans[0], scans[1], known(), up());
  }
  MapVerification
  verified(const std::vector<bool>& unsure, unsigned int threads = 0) const
  {
    MapVerifierOptions options;
    options.unsure = unsure;
    options.num_threads = threads;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < poses.size(); ++i)
      names.push_back("scan " + std::to_string(i));
    return MapVerifier(scans.all(), names, options).verify(poses);
  }

  PillarRoom room;
  Poses poses; ///< T_world_scan, the truth
  VerifiedScans scans;
};

/** Half a turn about the middle maps the room to itself. */
PillarRoom
symmetricRoom()
{
  PillarRoom room;
  room.walls = {Vector(-5, -4, -1), Vector(5, 4, 2)};
  room.pillars = {{Vector(1, 1.5, -1), Vector(2, 3, 2)},
                  {Vector(-2, -3, -1), Vector(-1, -1.5, 2)},
                  {Vector(3, -3, -1), Vector(3.6, -1.8, 1)},
                  {Vector(-3.6, 1.8, -1), Vector(-3, 3, 1)}};
  return room;
}

/** No turn does: closets that have no counterpart stand in it. */
PillarRoom
uniqueRoom()
{
  PillarRoom room;
  room.pillars.push_back({Vector(-5, -4, -1), Vector(-3.5, -3.2, 1.2)});
  room.pillars.push_back({Vector(5.8, -4, -1), Vector(7, -1, 1)});
  room.pillars.push_back({Vector(-1, 3.2, -1), Vector(2, 4, 0.8)});
  return room;
}

constexpr double kPeriod = 2.5; // [m]

/** An aisle along x between shelves that look alike, without ends in sight. */
PillarRoom
shelves()
{
  PillarRoom room = pcl6d::test::endlessCorridor();
  for (int i = -12; i <= 12; ++i) {
    const double x = kPeriod * i;
    room.pillars.push_back({Vector(x, -1.5, -1), Vector(x + 0.6, -0.8, 1.2)});
    room.pillars.push_back({Vector(x + 1.4, 0.9, -1), Vector(x + 1.8, 1.5, 1.5)});
  }
  return room;
}

/** Two scans along the aisle, between the same shelves. */
Scanned
alongShelves()
{
  return Scanned(
      shelves(), {pcl6d::planarPose(0, 0, 0.1), pcl6d::planarPose(0.8, 0.1, 0)}, 7);
}

bool
isNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  const auto apart = distanceBetween(a, b);
  return apart.translation < kPlaceTol && apart.rotation < kTurnTol;
}

bool
contains(const std::vector<Eigen::Isometry3d>& places, const Eigen::Isometry3d& place)
{
  return std::any_of(places.begin(), places.end(), [&](const auto& one) {
    return isNear(one, place);
  });
}

/** The places differ from the known one and from each other. */
void
expectDistinct(std::vector<Eigen::Isometry3d> places, const Eigen::Isometry3d& known)
{
  places.push_back(known);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto apart = distanceBetween(places[i], places[k]);
      EXPECT_TRUE(apart.translation >= kOther || apart.rotation >= kOtherTurn)
          << i << " and " << k;
    }
}

/** The doubt holds how far away [m] and turned [deg] the second place is. */
void
expectSecondPlace(const pcl6d::Rejection& doubt,
                  const Eigen::Isometry3d& first,
                  const Eigen::Isometry3d& second)
{
  const auto apart = distanceBetween(first, second);
  EXPECT_EQ(doubt.reason, RejectReason::kFitsElsewhere);
  EXPECT_NEAR(doubt.measured, apart.translation, 0.1 * apart.translation) << doubt;
  EXPECT_NEAR(doubt.needed, apart.rotation * 180 / M_PI, 5) << doubt;
  EXPECT_EQ(doubt.text, "scan 0");
}
} // namespace

TEST(FindTwins, FindsTheOtherPlaceInARoomThatHalfATurnMapsToItself)
{
  const Scanned scanned(symmetricRoom());
  const Eigen::Isometry3d fold = pcl6d::test::foldOf(scanned.room);
  const Eigen::Isometry3d other = scanned.poses[0].inverse() * fold * scanned.poses[1];
  const auto twins = scanned.twins();
  EXPECT_TRUE(contains(twins, other));
  expectDistinct(twins, scanned.known());
  // And the truth, if the other place is the one that is known.
  const auto back = findTwins(scanned.scans[0], scanned.scans[1], other, scanned.up());
  EXPECT_TRUE(contains(back, scanned.known()));
  expectDistinct(back, other);
}

TEST(FindTwins, FindsThePlacesAlongARowOfShelves)
{
  const Scanned scanned = alongShelves();
  const auto twins = scanned.twins();
  for (const double way : {kPeriod, -kPeriod})
    EXPECT_TRUE(contains(
        twins, scanned.poses[0].inverse() * shifted(scanned.poses[1], {way, 0, 0})))
        << way;
  expectDistinct(twins, scanned.known());
}

TEST(FindTwins, DoesNotDependOnWhereTheScanIsThoughtToBe)
{
  const Scanned scanned(symmetricRoom());
  const auto twinsIf = [&](const Vector& far) {
    Eigen::Isometry3d known = scanned.known();
    known.pretranslate(far);
    return findTwins(scanned.scans[0], scanned.scans[1], known, scanned.up());
  };
  // Sideways, so that the height stays the right one; beyond 1e10 m nothing is left of it.
  const Vector aside = scanned.up().unitOrthogonal();
  EXPECT_TRUE(contains(twinsIf(50 * aside), scanned.known()));
  EXPECT_TRUE(contains(twinsIf(1e6 * aside), scanned.known()));
  for (const double far : {1e100, 1e300})
    EXPECT_NO_THROW(twinsIf(far * aside));
  for (const double far : {50.0, 1e19, 1e100, 1e300}) // upwards, out of reach
    EXPECT_TRUE(twinsIf(far * scanned.up()).empty()) << far;
}

TEST(FindTwins, FindsNothingWithoutUprightSurfaces)
{
  Random random(2);
  Points floor;
  for (int i = 0; i < 20000; ++i)
    floor.emplace_back(random.uniform(-6, 6), random.uniform(-6, 6), -1.F);
  VerifiedScans scans;
  scans.add({});
  scans.add({{1, 2, 3}});
  scans.add({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {2, 1, 0}});
  scans.add(Points(100, {kNan, kNan, kNan}));
  scans.add(Points(100, {1, 2, 3}));
  scans.add(floor);
  const std::size_t without = scans.all().size();
  Random again(8);
  scans.add(symmetricRoom().scan(pcl6d::planarPose(0, 0, 0), again, 0.04));
  for (std::size_t i = 0; i < without; ++i)
    for (const std::size_t k : {i, without}) {
      const Eigen::Isometry3d known = pcl6d::planarPose(0.3, 0, 0);
      EXPECT_TRUE(findTwins(scans[i], scans[k], known, Vector::UnitZ()).empty()) << i;
      EXPECT_TRUE(findTwins(scans[k], scans[i], known, Vector::UnitZ()).empty()) << i;
    }
}

TEST(FindTwins, RefusesWhatIsNoPoseAndNoDirection)
{
  VerifiedScans scans;
  scans.add({{1, 2, 3}});
  const auto messageOf = [&](const Eigen::Isometry3d& T, const Vector& up) {
    return badArgumentOf([&] { findTwins(scans[0], scans[0], T, up); });
  };
  const Eigen::Isometry3d here = Eigen::Isometry3d::Identity();
  EXPECT_EQ(messageOf(here, Vector::UnitZ()), "");
  EXPECT_EQ(messageOf(here, -Vector::UnitZ()), "") << "upside down";
  EXPECT_EQ(messageOf(here, Vector::Zero()), "up = 0 0 0, but must be a unit vector");
  EXPECT_EQ(messageOf(here, {0, 0, 2}), "up = 0 0 2, but must be a unit vector");
  EXPECT_NE(messageOf(here, {0, 0, static_cast<double>(kNan)}), "");
  for (const double bad : {2.0, static_cast<double>(kNan)}) {
    Eigen::Isometry3d T = here;
    T.linear() *= bad;
    EXPECT_EQ(messageOf(T, Vector::UnitZ()), "T_first_second is not a rigid motion");
  }
  Eigen::Isometry3d T = here;
  T.translation().x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(messageOf(T, Vector::UnitZ()), "T_first_second is not a rigid motion");
}

TEST(Ambiguity, NamesTheScanThatFitsAtTwoPlacesOfASymmetricRoom)
{
  const Scanned scanned(symmetricRoom());
  const MapVerification map = scanned.verified({false, true});
  EXPECT_EQ(map.trust, MapTrust::kAmbiguous);
  EXPECT_FALSE(map.trusted());
  EXPECT_FALSE(map.scans[0].doubt);
  expectSecondPlace(map.scans[1].doubt,
                    scanned.poses[1],
                    pcl6d::test::foldOf(scanned.room) * scanned.poses[1]);
  ASSERT_EQ(map.doubts.size(), 1u);
  EXPECT_EQ(map.doubts[0].reason, RejectReason::kPosesAmbiguous);
  EXPECT_EQ(
      toWords(map.doubts[0]).find("AMBIGUOUS, two places fit: scan 1 (fits as well "),
      0u)
      << map.doubts[0];
}

TEST(Ambiguity, NamesTheScanThatFitsAlongARowOfShelves)
{
  const Scanned scanned = alongShelves();
  const MapVerification map = scanned.verified({false, true});
  EXPECT_EQ(map.trust, MapTrust::kAmbiguous);
  expectSecondPlace(
      map.scans[1].doubt, scanned.poses[1], shifted(scanned.poses[1], {kPeriod, 0, 0}));
}

TEST(Ambiguity, IsNoneWhereAllScansAroundTellWhatTheOneBeforeDoesNot)
{
  // Half a turn about the first scan maps the corridor to itself. The second scan is confirmed by
  // five others at its place, and by none of these there.
  PillarRoom corridor;
  corridor.walls = {Vector(-20, -1.5, -1), Vector(20, 1.5, 1.5)};
  corridor.pillars.clear();
  Random random(4);
  double x = -19;
  while (x < -0.5) {
    const double side = random.uniform() < 0.5 ? -1 : 1;
    const Vector low(x, std::min(side, 1.5 * side), -1);
    const Vector high =
        low + Vector(random.uniform(0.4, 1), 0.5, random.uniform(1, 2.4));
    corridor.pillars.emplace_back(low, high);
    corridor.pillars.emplace_back(Vector(-high.x(), -high.y(), -1),
                                  Vector(-low.x(), -low.y(), high.z()));
    x += random.uniform(1.2, 2.5);
  }
  Poses poses;
  for (const double x : {0.0, -7.0, -8.2, -5.8, -4.5, -3.0, -1.5})
    poses.push_back(pcl6d::planarPose(x, 0, 0.1 * x));
  const Scanned scanned(corridor, poses, 7);
  const MapVerification map =
      scanned.verified({false, true, false, false, false, false, false});
  EXPECT_FALSE(map.scans[1].doubt) << toWords(map.scans[1].doubt);
  EXPECT_EQ(map.trust, MapTrust::kGood);
}

TEST(Ambiguity, IsNoneInARoomWithoutSymmetry)
{
  const MapVerification map = Scanned(uniqueRoom()).verified({true, true});
  EXPECT_EQ(map.trust, MapTrust::kGood);
  EXPECT_TRUE(map.doubts.empty());
  for (const auto& scan : map.scans)
    EXPECT_FALSE(scan.doubt) << scan.doubt;
}

TEST(Ambiguity, IsNotLookedForWhereThePlaceWasKnown)
{
  const Scanned scanned(symmetricRoom());
  for (const std::vector<bool>& unsure :
       {std::vector<bool>{}, std::vector<bool>{false, false}}) {
    const MapVerification map = scanned.verified(unsure);
    EXPECT_EQ(map.trust, MapTrust::kGood);
    EXPECT_TRUE(map.doubts.empty());
  }
}

TEST(Ambiguity, IsNotLookedForInAMapThatIsDoubtedAnyway)
{
  Scanned scanned(symmetricRoom(),
                  {pcl6d::poseFromEuler({0.2, -0.4, 0.1}, {0.02, -0.03, 0.5}),
                   pcl6d::poseFromEuler({1.2, 0.9, 0}, {-0.02, 0.03, 2.0}),
                   pcl6d::poseFromEuler({-1, 0.5, 0}, {0, 0, -1})});
  EXPECT_EQ(scanned.verified({false, true, true}).trust, MapTrust::kAmbiguous);
  scanned.poses[2].translation() += Vector(0.6, 0.5, 0); // a wrong pose
  const MapVerification map = scanned.verified({false, true, true});
  EXPECT_EQ(map.trust, MapTrust::kDoubtful);
  ASSERT_TRUE(map.scans[1].tied);
  EXPECT_EQ(map.scans[1].doubt.reason, RejectReason::kSecondPoseNotSought);
  EXPECT_EQ(map.doubts.back().reason, RejectReason::kSecondPosesNotSought);
}

TEST(Ambiguity, OfOneScanEndsTheSearchAfterAFewMore)
{
  Poses poses;
  for (int i = 0; i < 12; ++i)
    poses.push_back(pcl6d::poseFromEuler({0.15 * i - 0.9, 0.1 * i - 0.6, 0},
                                         {0.01, 0.01 * (i % 3), 0.5 * i}));
  const Scanned scanned(symmetricRoom(), poses);
  const MapVerification map = scanned.verified(std::vector<bool>(12, true));
  EXPECT_EQ(map.trust, MapTrust::kAmbiguous);
  std::size_t named = 0, left_out = 0;
  for (const auto& scan : map.scans) {
    named += scan.doubt.reason == RejectReason::kFitsElsewhere ? 1 : 0;
    left_out += scan.doubt.reason == RejectReason::kSecondPoseNotSought ? 1 : 0;
  }
  EXPECT_EQ(left_out, 4U); // eight at a time
  EXPECT_GE(named, 1U);
}

TEST(Ambiguity, IsNotLookedForOfAScanBeyondAllNumbers)
{
  Scanned scanned(symmetricRoom());
  for (const double far : {1e19, 1e100, 1e300}) {
    scanned.poses[1].translation() << far, -far, 0;
    const MapVerification map = scanned.verified({true, true});
    EXPECT_EQ(map.trust, MapTrust::kDoubtful) << far;
    EXPECT_FALSE(map.scans[1].tied) << far;
  }
}

TEST(Ambiguity, IsTheSameForAnyNumberOfThreads)
{
  const Scanned scanned(symmetricRoom());
  const MapVerification one = scanned.verified({true, true}, 1);
  for (const unsigned int threads : {2u, 8u}) {
    const MapVerification many = scanned.verified({true, true}, threads);
    EXPECT_EQ(many.trust, one.trust);
    EXPECT_EQ(many.doubts, one.doubts);
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_EQ(many.scans[i].doubt, one.scans[i].doubt);
  }
  const auto twins = scanned.twins(), again = scanned.twins();
  ASSERT_EQ(twins.size(), again.size());
  for (std::size_t i = 0; i < twins.size(); ++i)
    EXPECT_TRUE(sameBits(twins[i], again[i]));
}
