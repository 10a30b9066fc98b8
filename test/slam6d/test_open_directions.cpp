// SPDX-License-Identifier: BSD-3-Clause
// Corridors and tunnels without features: what surfaces measure is corrected, and the motion that
// they leave open comes from the given poses.
#include "corridor_drive.h"
#include "matching/balanced_match.h"
#include "matching/open_directions.h"
#include "recovery/second_look.h"
#include "registered_run.h"

#include <pcl6d/registration/localizability.h>
#include <pcl6d/registration/plane_sums.h>

#include <cmath>

namespace {
using pcl6d::IcpResult;
using pcl6d::Localizability;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::ScanState;
using pcl6d::Slam6DResult;
using pcl6d::Status;
using pcl6d::slam6d::holdOpenDirections;
using pcl6d::test::DriftingRun;
using pcl6d::test::PillarRoom;

/** \return a pose that ICP has found where surfaces leave so many motions open: along x, then
 * along y, then z, then turns */
IcpResult
foundWith(int open, const Eigen::Isometry3d& pose)
{
  IcpResult found;
  found.status = open > 0 ? Status::kRankDeficient : Status::kOk;
  found.T_target_source = pose;
  found.localizability = Localizability();
  found.localizability->centroid = {5, 1, 0};
  for (int k = 0; k < 6; ++k)
    found.localizability->eigenvalues(k) = k < open ? 0 : 0.3;
  return found;
}

TEST(OpenDirections, TakeTheOpenMotionFromThePrediction)
{
  const Eigen::Isometry3d predicted = poseFromEuler({0.5, 0.1, 0}, {});
  IcpResult found = foundWith(1, poseFromEuler({1.2, 0.12, 0.03}, {}));
  EXPECT_TRUE(holdOpenDirections(predicted, found));
  const Eigen::Vector3d expected(0.5, 0.12, 0.03);
  EXPECT_LT((found.T_target_source.translation() - expected).norm(), 1e-12);
  EXPECT_EQ(found.status, Status::kRankDeficient);
}

// In a tunnel of any direction, seen from anywhere: of a slide along it and a turn only the slide
// goes, and the slide is nowhere carried across.
TEST(OpenDirections, ATurnDoesNotCarryTheSlideAcross)
{
  Random random(7);
  const Eigen::Isometry3d T_world_tunnel = poseFromEuler({30, 20, 3}, {0.1, -0.2, 0.7});
  pcl6d::PlaneAccumulator walls;
  for (int k = 0; k < 4000; ++k) {
    const double x = random.uniform(-6, 9), a = random.uniform(-1.5, 1.5);
    const double side = k % 4 < 2 ? -1.5 : 1.5;
    const bool is_wall = k % 2 == 0;
    const Eigen::Vector3d p =
        is_wall ? Eigen::Vector3d(x, side, a) : Eigen::Vector3d(x, a, side);
    const Eigen::Vector3d place = T_world_tunnel * p;
    walls.add(
        place, place, T_world_tunnel.linear() * Eigen::Vector3d::Unit(is_wall ? 1 : 2));
  }
  IcpResult found;
  found.localizability = pcl6d::localizabilityOf(walls.sums());
  ASSERT_EQ(found.localizability->openDirections(), 1);
  const Eigen::Vector3d along = T_world_tunnel.linear().col(0);
  const Eigen::Translation3d middle(found.localizability->centroid);
  const Eigen::Isometry3d truth = T_world_tunnel * poseFromEuler({0.2, 0.1, 0}, {});
  for (const double turn : {0.0, 0.05, 0.2}) {
    const Eigen::Isometry3d off =
        poseFromEuler(0.6 * along, {turn / 3, turn / 2, turn});
    const Eigen::Isometry3d predicted = middle * off * middle.inverse() * truth;
    found.T_target_source = truth;
    found.status = Status::kMaxIterations;
    EXPECT_TRUE(holdOpenDirections(predicted, found));
    const Eigen::Isometry3d error = found.T_target_source * truth.inverse();
    const Eigen::Vector3d moved =
        error * found.localizability->centroid - found.localizability->centroid;
    // A turn of 0.2 rad tilts the direction in which nothing is measured.
    EXPECT_LT((moved - moved.dot(along) * along).norm(), 1e-3 + 0.02 * turn) << turn;
    EXPECT_NEAR(moved.dot(along), 0.6, 1e-3 + 0.6 * turn * turn) << turn;
    EXPECT_EQ(found.status, Status::kRankDeficient);
    EXPECT_FALSE(found.covariance);
  }
}

TEST(OpenDirections, KeepTurnsAboutTheMiddleOfThePoints)
{
  const Eigen::Translation3d middle(5, 1, 0);
  const Eigen::Isometry3d turn = poseFromEuler({0, 0, 0}, {0.01, -0.02, 0.05});
  const Eigen::Isometry3d predicted = poseFromEuler({0.5, 0.1, 0}, {0, 0, 0.3});
  IcpResult found = foundWith(1, middle * turn * middle.inverse() * predicted);
  const Eigen::Isometry3d pose = found.T_target_source;
  EXPECT_TRUE(holdOpenDirections(predicted, found));
  EXPECT_LT((found.T_target_source.matrix() - pose.matrix()).norm(), 1e-12);
}

TEST(OpenDirections, ChangeNothingWhereNoneOrSeveralAreOpen)
{
  const Eigen::Isometry3d pose = poseFromEuler({1.2, 0.12, 0.03}, {});
  for (const int open : {0, 2, 3, 6}) {
    IcpResult found = foundWith(open, pose);
    EXPECT_FALSE(holdOpenDirections(Eigen::Isometry3d::Identity(), found)) << open;
    EXPECT_EQ(found.T_target_source.matrix(), pose.matrix());
  }
  IcpResult unknown = foundWith(1, pose);
  unknown.localizability.reset();
  EXPECT_FALSE(holdOpenDirections(Eigen::Isometry3d::Identity(), unknown));
}

/** \return a drive through a straight tunnel whose ends are out of sight; the odometry drifts along
 * and across it, and turns */
DriftingRun
tunnelRun(int rests_at = -1)
{
  PillarRoom tunnel;
  tunnel.walls = {Eigen::Vector3d(-60, -1.5, -1), Eigen::Vector3d(60, 1.5, 1.5)};
  tunnel.pillars.clear();
  Random random(3);
  DriftingRun run;
  const Eigen::Isometry3d drift = poseFromEuler({0.02, 0.02, 0.005}, {0, 0, 0.012});
  for (int i = 0; i < 6; ++i) {
    run.truth.push_back(i == rests_at
                            ? run.truth.back()
                            : poseFromEuler({0.8 * i, 0.1 * i, 0}, {0, 0, 0.02 * i}));
    if (i == 0 || i == rests_at)
      run.odometry.push_back(i == 0 ? run.truth[0] : run.odometry.back());
    else
      run.odometry.push_back(run.odometry.back() *
                             run.truth[run.truth.size() - 2].inverse() *
                             run.truth.back() * drift);
    run.scans.push_back(pcl6d::test::shortSighted(tunnel, run.truth.back(), random));
  }
  return run;
}

void
expectStraight(const DriftingRun& run, const Slam6DResult& result)
{
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    const pcl6d::ScanResult& scan = result.scans[i];
    EXPECT_EQ(scan.state, ScanState::kUnconverged) << i;
    EXPECT_EQ(scan.status, Status::kRankDeficient) << i;
    const Eigen::Vector3d off =
        scan.T_world_scan.translation() - run.truth[i].translation();
    const Eigen::Vector3d was =
        run.odometry[i].translation() - run.truth[i].translation();
    EXPECT_LT(std::hypot(off.y(), off.z()), 0.03) << i << ", given " << was.transpose();
    // A drift along the way of 2 cm a step, which nothing measures, and no more.
    EXPECT_LT(std::abs(off.x()), 0.02 * static_cast<double>(i) + 0.02) << i;
  }
  EXPECT_FALSE(result.trusted());
}

TEST(OpenDirections, ATunnelIsStraightAndItsLengthIsThatOfTheOdometry)
{
  const DriftingRun run = tunnelRun();
  expectStraight(run, pcl6d::test::registered(run));
}

TEST(OpenDirections, ARestInATunnelChangesNothing)
{
  const DriftingRun run = tunnelRun(3);
  expectStraight(run, pcl6d::test::registered(run));
}

// Tracking saw more than the keyframes do: its step is a measurement, as the match is.
TEST(OpenDirections, AMeasuredStepFixesTheOpenMotion)
{
  const DriftingRun run = tunnelRun();
  const Slam6DResult given = pcl6d::test::registered(run);
  pcl6d::Slam6D slam;
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    slam.addScan(run.scans[i], run.odometry[i], "", pcl6d::test::measuredStep(i != 3));
  EXPECT_TRUE(slam.optimize());
  for (std::size_t i = 1; i < run.scans.size(); ++i) {
    const pcl6d::ScanResult& scan = slam.result().scans[i];
    EXPECT_EQ(scan.state, i == 3 ? ScanState::kUnconverged : ScanState::kMatched) << i;
    EXPECT_EQ(scan.status, Status::kRankDeficient) << i;
    EXPECT_TRUE(pcl6d::test::sameBits(scan.T_world_scan, given.scans[i].T_world_scan));
  }
}

// A scan that is refused on the way leaves nothing behind: each step keeps its own statement.
TEST(OpenDirections, ARefusedScanMovesNoMeasuredStep)
{
  const DriftingRun run = tunnelRun();
  const pcl6d::Points inside_the_gate(10, {0.01F, 0, 0});
  pcl6d::Slam6D slam;
  slam.addScan(run.scans[0], run.odometry[0]);
  EXPECT_TRUE(slam.optimize()); // derives the range gate
  for (std::size_t i = 1; i < run.scans.size(); ++i) {
    EXPECT_THROW(
        slam.addScan(
            inside_the_gate, run.odometry[i], "", pcl6d::test::measuredStep(i == 3)),
        pcl6d::ComputeFailed);
    slam.addScan(run.scans[i], run.odometry[i], "", pcl6d::test::measuredStep(i != 3));
  }
  EXPECT_TRUE(slam.optimize());
  for (std::size_t i = 1; i < run.scans.size(); ++i)
    EXPECT_EQ(slam.result().scans[i].state,
              i == 3 ? ScanState::kUnconverged : ScanState::kMatched)
        << i;
}

/** \return a model of the walls of a hall, and of floor in 16 places, 0.4 % of the points
 * \param[in] patch [m] distance of the places */
pcl6d::IcpModel
hallModel(Random& random, double height, double patch)
{
  pcl6d::Points points;
  for (int i = 0; i < 15000; ++i) {
    const double along = random.uniform(-10, 10), side = i % 2 == 0 ? -10 : 10;
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    const double up = random.uniform(-1, 3);
    const Eigen::Vector3d p =
        i % 4 < 2 ? Eigen::Vector3d(along, side, up) : Eigen::Vector3d(side, along, up);
    points.push_back((p + 0.01 * noise).cast<float>());
  }
  for (int i = 0; i < 64; ++i)
    points.push_back(Eigen::Vector3d(patch * (i % 4 - 1.5) + random.uniform(0, 0.4),
                                     patch * (i / 4 % 4 - 1.5) + random.uniform(0, 0.4),
                                     height + 0.01 * random.normal())
                         .cast<float>());
  pcl6d::IcpModel::Options options;
  options.normals = true;
  options.neighbours = 10;
  options.num_threads = 1;
  return {std::move(points), options};
}

/** \return what is left of a height of 8 cm after a match, and one with balanced points */
double
heightLeft(double patch, Status& status)
{
  Random random(13);
  const pcl6d::IcpModel target = hallModel(random, -1.2, patch),
                        source = hallModel(random, -1.12, patch);
  pcl6d::IcpOptions options;
  options.metric = pcl6d::Metric::kGicp;
  options.facing_normals = true;
  options.max_distance = 0.25;
  options.max_iterations = 10;
  options.num_threads = 1;
  const pcl6d::IcpTarget parts = {target.part()};
  IcpResult found =
      pcl6d::icp(parts, source.source(), Eigen::Isometry3d::Identity(), options);
  EXPECT_EQ(found.localizability->openDirections(), 1);
  options.max_iterations = 100;
  pcl6d::slam6d::matchBalanced(parts, source.source(), options, found);
  status = found.status;
  return found.T_target_source.translation().z() + 0.08;
}

TEST(MatchBalanced, FewPatchesOfAFloorFixTheHeight)
{
  Status status = Status::kDiverged;
  EXPECT_NEAR(heightLeft(4, status), 0, 0.01);
  EXPECT_EQ(status, Status::kOk);
}

TEST(MatchBalanced, OnePatchOfAFloorDoesNot)
{
  Status status = Status::kDiverged;
  heightLeft(0, status);
  EXPECT_NE(status, Status::kOk);
}

/** \return a map of five scans along x, all with given poses; scan 2 was found far off, and scan 3
 * is lost behind it */
Slam6DResult
mapWithAFind(bool is_confirmed)
{
  Slam6DResult map;
  map.verification.emplace();
  map.verification->scans.resize(5);
  for (int i = 0; i < 5; ++i) {
    pcl6d::ScanResult scan;
    scan.initial_pose = pcl6d::test::movedBy(i);
    scan.T_world_scan = pcl6d::test::movedBy(1.1 * i);
    scan.state = i == 3 ? ScanState::kPredicted : ScanState::kMatched;
    map.scans.push_back(scan);
  }
  map.scans[2].recovered = pcl6d::RecoveredBy::kSearch;
  map.scans[2].T_world_scan = pcl6d::test::movedBy(-7);
  map.scans[3].T_world_scan = pcl6d::test::movedBy(-6);
  pcl6d::LinkCheck link;
  link.from = 1;
  link.to = 2;
  link.trust = is_confirmed ? pcl6d::LinkTrust::kGood : pcl6d::LinkTrust::kWeak;
  map.verification->links.push_back(link);
  pcl6d::ScanLink used;
  used.from = 1;
  used.to = 2;
  map.links.push_back(used);
  return map;
}

TEST(ReturnUnconfirmed, AFindThatNoLinkConfirmsGoesBackWithTheLostBehindIt)
{
  Slam6DResult map = mapWithAFind(false);
  EXPECT_TRUE(pcl6d::slam6d::returnUnconfirmed(0, map));
  const double expected[] = {0, 1.1, 2.1, 3.1, 4.4}; // steps of the given poses
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(map.scans[i].T_world_scan.translation().x(), expected[i], 1e-12) << i;
  EXPECT_EQ(map.scans[2].state, ScanState::kPredicted);
  EXPECT_EQ(map.scans[2].rejections.front().reason,
            pcl6d::RejectReason::kNoConsistentLink);
  EXPECT_EQ(map.links[0].verdict, pcl6d::LinkVerdict::kRefused);
}

TEST(ReturnUnconfirmed, WhatIsConfirmedOrEarlierOrWithoutGivenPosesStays)
{
  Slam6DResult confirmed = mapWithAFind(true);
  EXPECT_FALSE(pcl6d::slam6d::returnUnconfirmed(0, confirmed));
  EXPECT_NEAR(confirmed.scans[2].T_world_scan.translation().x(), -7, 1e-12);
  Slam6DResult earlier = mapWithAFind(false);
  EXPECT_FALSE(pcl6d::slam6d::returnUnconfirmed(3, earlier));
  Slam6DResult unverified = mapWithAFind(false);
  unverified.verification.reset();
  EXPECT_FALSE(pcl6d::slam6d::returnUnconfirmed(0, unverified));
  Slam6DResult without = mapWithAFind(false);
  for (pcl6d::ScanResult& scan : without.scans)
    scan.initial_pose = pcl6d::test::movedBy(3);
  EXPECT_FALSE(pcl6d::slam6d::returnUnconfirmed(0, without));
}
} // namespace
