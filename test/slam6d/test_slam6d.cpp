// SPDX-License-Identifier: BSD-3-Clause
#include "registered_run.h"
#include "support/points.h"

using pcl6d::Points;
using pcl6d::Random;
using pcl6d::RecoveryEffort;
using pcl6d::ScanState;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::Status;
using pcl6d::test::DriftingRun;
using pcl6d::test::expectSameBits;
using pcl6d::test::makeDriftingRun;
using pcl6d::test::registered;
using pcl6d::test::sameBits;

namespace {
const Eigen::Isometry3d kTilted = pcl6d::poseFromEuler({2, -3, 1}, {0.2, -0.3, 2.5});

// Two scans never meet the same points, and a reduced point stands for its voxel: what
// point-to-point matching leaves over is a share of the voxel. Against the union of
// scans a quarter; pairwise it adds up on the way. The odometry drifts by 30 cm.
constexpr double kShareOfUnion = 0.25, kSharePairwise = 0.5;
constexpr double kLever = 2.5; // [m] from the scanner to the nearer walls

void
expectTruth(const Slam6DResult& result,
            const DriftingRun& run,
            double share = kShareOfUnion)
{
  const double tolerance = share * result.parameters.voxel.value; // [m]
  ASSERT_EQ(result.scans.size(), run.truth.size());
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    SCOPED_TRACE("scan " + std::to_string(i));
    const auto error =
        pcl6d::distanceBetween(run.truth[i], result.scans[i].T_world_scan);
    EXPECT_LT(error.translation, tolerance);
    EXPECT_LT(error.rotation, tolerance / kLever);
  }
}
} // namespace

TEST(Slam6D, FollowsThePathWhereTheOdometryDrifts)
{
  const DriftingRun run = makeDriftingRun(8, {}, kTilted);
  const Slam6DResult result = registered(run);
  ASSERT_GT(pcl6d::distanceBetween(run.truth.back(), run.odometry.back()).translation,
            0.3);
  expectTruth(result, run);
  EXPECT_TRUE(result.trusted());
  EXPECT_EQ(result.count(ScanState::kFixed), 1u);
  EXPECT_EQ(result.count(ScanState::kMatched), 7u);
  EXPECT_TRUE(sameBits(result.scans[0].T_world_scan, run.odometry[0]));
  for (std::size_t i = 1; i < run.scans.size(); ++i) {
    const auto& scan = result.scans[i];
    EXPECT_EQ(scan.status, Status::kOk);
    EXPECT_TRUE(sameBits(scan.initial_pose, run.odometry[i]));
    EXPECT_EQ(scan.points, run.scans[i].size());
    EXPECT_GT(scan.reduced, 3u);
    EXPECT_LE(scan.reduced, scan.points);
    EXPECT_GT(scan.overlap, 0.5);
    EXPECT_NEAR(scan.overlap, static_cast<double>(scan.pairs) / scan.reduced, 1e-12);
    EXPECT_GT(scan.iterations, 0);
    EXPECT_GT(scan.rms, 0);
    EXPECT_LE(scan.rms, result.parameters.max_distance.value);
    EXPECT_TRUE(scan.covariance);
  }
  EXPECT_EQ(*result.scans[0].covariance, pcl6d::PoseCovariance::Zero());
}

TEST(Slam6D, MatchesAgainstOneOrThreeOrAllScans)
{
  const DriftingRun run = makeDriftingRun(5);
  std::vector<Slam6DResult> results;
  for (const int metascan : {0, 1, 3, 5}) {
    SCOPED_TRACE("metascan " + std::to_string(metascan));
    Slam6DOptions options;
    options.max_distance_start = 1; // for speed
    options.loop_closing = pcl6d::LoopClosing::kNone;
    options.relaxation.reset();
    options.metascan = metascan;
    results.push_back(registered(run, options));
    expectTruth(results.back(), run, metascan == 1 ? kSharePairwise : kShareOfUnion);
  }
  // Only the fifth scan can tell 3 from all; 5 are all.
  EXPECT_TRUE(
      sameBits(results[0].scans[3].T_world_scan, results[2].scans[3].T_world_scan));
  EXPECT_FALSE(
      sameBits(results[0].scans[4].T_world_scan, results[2].scans[4].T_world_scan));
  EXPECT_FALSE(
      sameBits(results[0].scans[2].T_world_scan, results[1].scans[2].T_world_scan));
  expectSameBits(results[0], results[3]);
}

TEST(Slam6D, CarriesTheOdometryOverInAllSixDegreesOfFreedom)
{
  // Nothing to match, so that poses are predictions: T0 O0^-1 O1.
  const Points cube = [] {
    Random random(5);
    return pcl6d::test::randomCube(random, 500, 4);
  }();
  const Points far = pcl6d::transformed(cube, pcl6d::poseFromEuler({0, 0, 40}, {}));
  const Eigen::Isometry3d o0 = kTilted;
  const Eigen::Isometry3d o1 = pcl6d::poseFromEuler({3, -2, 1.5}, {-0.4, 0.6, 1});
  Slam6D slam;
  slam.addScan(cube, o0);
  slam.addScan(far, o1);
  EXPECT_EQ(slam.result().scans[1].state, ScanState::kPending);
  EXPECT_TRUE(slam.optimize());
  const auto& scan = slam.result().scans[1];
  EXPECT_EQ(scan.state, ScanState::kPredicted);
  const auto error = pcl6d::distanceBetween(o1, scan.T_world_scan);
  EXPECT_LT(error.translation, 1e-12);
  EXPECT_LT(error.rotation, 1e-12);
}

TEST(Slam6D, KeepsThePoseOfASingleScan)
{
  const DriftingRun run = makeDriftingRun(1, {}, kTilted);
  const Slam6DResult result = registered(run);
  EXPECT_EQ(result.scans[0].state, ScanState::kFixed);
  EXPECT_TRUE(sameBits(result.scans[0].T_world_scan, run.odometry[0]));
  EXPECT_TRUE(result.trusted());
}

TEST(Slam6D, GoesOnAfterAScanOfAnotherWorld)
{
  DriftingRun run = makeDriftingRun(6);
  Random random(9);
  run.scans[3] = pcl6d::transformed(pcl6d::test::randomCube(random, 2000, 5),
                                    pcl6d::poseFromEuler({0, 0, 60}, {}));
  Slam6DOptions options;
  options.relaxation.reset(); // which moves it with its neighbours
  const Slam6DResult result = registered(run, options);
  EXPECT_EQ(result.scans[3].state, ScanState::kPredicted);
  EXPECT_FALSE(result.scans[3].covariance);
  EXPECT_FALSE(result.trusted());
  const Eigen::Isometry3d predicted =
      result.scans[2].T_world_scan * run.odometry[2].inverse() * run.odometry[3];
  EXPECT_LT(pcl6d::distanceBetween(predicted, result.scans[3].T_world_scan).translation,
            1e-9);
  for (const std::size_t i : {1u, 2u, 4u, 5u})
    EXPECT_EQ(result.scans[i].state, ScanState::kMatched);
  run.truth[3] = result.scans[3].T_world_scan;
  expectTruth(result, run);
}

TEST(Slam6D, DoesNotMatchAgainstAScanThatWasOnlyPredicted)
{
  // Pairwise: the scan after the lost one is matched against the last good one.
  DriftingRun run = makeDriftingRun(4);
  Random random(9);
  run.scans[2] = pcl6d::transformed(pcl6d::test::randomCube(random, 2000, 5),
                                    pcl6d::poseFromEuler({0, 0, 60}, {}));
  Slam6DOptions options;
  options.metascan = 1;
  const Slam6DResult result = registered(run, options);
  EXPECT_EQ(result.scans[2].state, ScanState::kPredicted);
  EXPECT_EQ(result.scans[3].state, ScanState::kMatched);
  run.truth[2] = result.scans[2].T_world_scan;
  expectTruth(result, run, kSharePairwise);
}

TEST(Slam6D, SaysWhenIcpStoppedAtItsLimit)
{
  Slam6DOptions options;
  options.max_iterations = 3;
  options.verify = false;
  const Slam6DResult result = registered(makeDriftingRun(3), options);
  EXPECT_EQ(result.scans[1].state, ScanState::kUnconverged);
  EXPECT_EQ(result.scans[1].status, Status::kMaxIterations);
  EXPECT_EQ(result.scans[1].iterations, 3);
  EXPECT_FALSE(result.trusted());
  options.verify = true;
  const Slam6DResult verified = registered(makeDriftingRun(3), options);
  EXPECT_EQ(verified.scans[1].state, ScanState::kUnconverged);
  EXPECT_EQ(verified.trusted(), verified.verification->trust == pcl6d::MapTrust::kGood)
      << "points and rays may confirm where it stopped";
}

TEST(Slam6D, DoesNotBelieveASmallOverlap)
{
  Slam6DOptions options;
  options.min_overlap = 1; // no scan of another place has a partner for every point
  const Slam6DResult result = registered(makeDriftingRun(3), options);
  EXPECT_EQ(result.count(ScanState::kPredicted), 2u);
}

TEST(Slam6D, DoesNotBelievePairsAsFarApartAsThoseOfUnrelatedClouds)
{
  // A blob fills the room and finds partners on its walls, evenly near and far.
  DriftingRun run = makeDriftingRun(2);
  Random random(12);
  for (auto& p : run.scans[1])
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = static_cast<float>(2 * random.normal());
  Slam6DOptions options;
  options.max_range = 20;
  options.voxel = 0.25;
  options.max_distance = 0.5;
  options.metric = pcl6d::Metric::kPoint;
  const Slam6DResult result = registered(run, options);
  const auto& blob = result.scans[1];
  EXPECT_GE(blob.overlap, options.min_overlap) << "which is not the reason";
  EXPECT_EQ(blob.status, Status::kOk) << "nor is this";
  EXPECT_GT(blob.rms, 0.6 * 0.5) << "this is";
  EXPECT_EQ(blob.rejections.front().reason, pcl6d::RejectReason::kUnrelatedPoints);
  EXPECT_EQ(blob.rejections.front().measured, blob.rms);
  EXPECT_EQ(blob.state, ScanState::kPredicted);
  EXPECT_FALSE(blob.covariance);
  EXPECT_LT(pcl6d::distanceBetween(run.odometry[1], blob.T_world_scan).translation,
            1e-9);
  for (const auto metric : {pcl6d::Metric::kPlane, pcl6d::Metric::kGicp}) {
    options.metric = metric;
    EXPECT_EQ(registered(run, options).scans[1].state, ScanState::kPredicted)
        << toString(metric);
  }
}

TEST(Slam6D, DoesNotBelieveUnrelatedHeapsOfPointsByAnyMetric)
{
  // Points so sparse that a partner lies anywhere within the largest distance.
  Random random(3);
  Slam6DOptions options;
  options.max_range = 20;
  options.voxel = 0.1;
  options.max_distance = 0.5;
  options.max_distance_start = 0.5;
  options.max_correction = std::numeric_limits<double>::infinity();
  DriftingRun run;
  for (int i = 0; i < 2; ++i) {
    run.scans.push_back(pcl6d::test::randomCube(random, 400, 8));
    run.odometry.push_back(Eigen::Isometry3d::Identity());
  }
  for (const auto metric :
       {pcl6d::Metric::kPoint, pcl6d::Metric::kPlane, pcl6d::Metric::kGicp}) {
    SCOPED_TRACE(toString(metric));
    options.metric = metric;
    const auto heap = registered(run, options).scans[1];
    EXPECT_EQ(heap.state, ScanState::kPredicted);
    EXPECT_FALSE(heap.rejections.empty());
  }
}

TEST(Slam6D, GivesTheSameBitsForEveryNumberOfThreads)
{
  const DriftingRun run = makeDriftingRun(3, {}, kTilted);
  Slam6DOptions options;
  options.num_threads = 1;
  const Slam6DResult one = registered(run, options);
  for (const unsigned int threads : {2u, 8u}) {
    options.num_threads = threads;
    expectSameBits(registered(run, options), one);
  }
}

TEST(Slam6D, GivesTheSameFarFromTheOrigin)
{
  const Eigen::Isometry3d utm =
      pcl6d::poseFromEuler({691234.567, 5336789.123, 512}, {});
  const DriftingRun near = makeDriftingRun(4);
  DriftingRun far = near;
  for (auto& pose : far.odometry)
    pose = utm * pose;
  const Slam6DResult a = registered(near), b = registered(far);
  for (std::size_t i = 0; i < near.scans.size(); ++i) {
    SCOPED_TRACE("scan " + std::to_string(i));
    const auto error = pcl6d::distanceBetween(
        a.scans[0].T_world_scan.inverse() * a.scans[i].T_world_scan,
        b.scans[0].T_world_scan.inverse() * b.scans[i].T_world_scan);
    EXPECT_LT(error.translation, 1e-6);
    EXPECT_LT(error.rotation, 1e-6);
  }
}

TEST(Slam6D, DoesNotBelieveAMatchThatDeniesTheOdometry)
{
  // The last odometry step is 0.3 m longer than the way, most of its own length.
  DriftingRun run = makeDriftingRun(4);
  run.odometry = run.truth;
  run.odometry.back().translation() += Eigen::Vector3d(0.3, 0, 0);
  Slam6DOptions options;
  options.voxel = 0.1;
  options.max_distance_start = 1.0;
  options.recovery = RecoveryEffort::kOff; // which would ask points and rays
  const auto careful = registered(run, options).scans.back();
  EXPECT_EQ(careful.state, ScanState::kPredicted);
  EXPECT_EQ(careful.rejections.front().reason,
            pcl6d::RejectReason::kCorrectionTooLarge);
  EXPECT_EQ(careful.rejections.front().measured, careful.correction);
  EXPECT_NEAR(careful.correction, 0.3, kShareOfUnion * *options.voxel);
  options.max_correction = std::numeric_limits<double>::infinity();
  const auto trusting = registered(run, options).scans.back();
  EXPECT_EQ(trusting.state, ScanState::kMatched);
  EXPECT_TRUE(trusting.rejections.empty());
  const auto error =
      pcl6d::distanceBetween(run.truth.back(), trusting.T_world_scan).translation;
  EXPECT_LT(error, kShareOfUnion * *options.voxel);
}

TEST(Slam6D, BelievesAnyCorrectionWhereTheOdometryHasNoStep)
{
  DriftingRun run = makeDriftingRun(2);
  run.odometry.assign(2, run.truth.front()); // 0.4 m from the second
  Slam6DOptions options;
  options.voxel = 0.1;
  options.max_distance_start = 1.0;
  EXPECT_EQ(registered(run, options).scans.back().state, ScanState::kMatched);
}
