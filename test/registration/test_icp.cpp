// SPDX-License-Identifier: BSD-3-Clause
#include "icp_cases.h"
#include "support/bits.h"
#include "support/constants.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/registration/icp.h>

using pcl6d::icp;
using pcl6d::IcpIteration;
using pcl6d::IcpOptions;
using pcl6d::IcpResult;
using pcl6d::Points;
using pcl6d::PointTree;
using pcl6d::Random;
using pcl6d::Status;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kIdentity;
using pcl6d::test::kNan;
using pcl6d::test::kTruth;
using pcl6d::test::roomCorner;
using pcl6d::test::sameBits;

namespace {
constexpr std::size_t kCount = 3000;
constexpr double kSide = 4; // [m] of the walls; points lie about 13 cm apart

Points
model()
{
  Random random(1);
  return roomCorner(random, kCount, kSide, 0.002);
}

/** The model's points as seen by a scanner that stands at kTruth. */
Points
data()
{
  return pcl6d::transformed(model(), kTruth.inverse());
}

// Every point has its exact partner, up to the rounding of both to float.
constexpr double kExactTol = 1e-6; // [m]

IcpResult
run(const Points& target,
    const Points& source,
    const IcpOptions& options = {},
    const pcl6d::IcpObserver& observer = {},
    const Eigen::Isometry3d& guess = kIdentity)
{
  return icp(PointTree(target),
             target,
             source,
             guess,
             options,
             pcl6d::minimiseByQuaternion,
             observer);
}

void
expectTruth(const IcpResult& result, double tolerance = kExactTol)
{
  EXPECT_EQ(result.status, Status::kOk);
  const auto error = pcl6d::distanceBetween(kTruth, result.T_target_source);
  EXPECT_LT(error.translation, tolerance);
  EXPECT_LT(error.rotation, tolerance); // [rad] by a lever arm of 1 m
}
} // namespace

TEST(Icp, FindsTheMotionBetweenCopies)
{
  const IcpResult result = run(model(), data());
  expectTruth(result);
  EXPECT_EQ(result.pairs, kCount);
  EXPECT_EQ(result.overlap, 1);
  EXPECT_LT(result.rms, kExactTol);
  EXPECT_LE(result.iterations, IcpOptions().max_iterations);
  EXPECT_TRUE(result.covariance);
}

TEST(Icp, ReportsPairsRmsAndOverlapOfTheFinalPose)
{
  // A tenth of the source has no partner; the others have theirs at a known distance.
  Random random(2);
  const Points target = roomCorner(random, 900, 40);
  Points source = target;
  for (int i = 0; i < 100; ++i)
    source.push_back({-20, -20, -20.0f - static_cast<float>(i)});
  source.push_back({kNan, 0, 0});
  const IcpResult result = run(target, source);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_EQ(result.pairs, 900u);
  EXPECT_EQ(result.overlap, 0.9) << "of the finite points";
}

TEST(Icp, SkipsNanOnBothSides)
{
  Points target = model(), source = data();
  target.insert(target.begin(), {kNan, kNan, kNan});
  target.push_back({0, kNan, 0});
  source.insert(source.begin() + 5, {0, 0, kNan});
  expectTruth(run(target, source));
}

TEST(Icp, GoesOnFromTheGuess)
{
  const Eigen::Isometry3d far = pcl6d::poseFromEuler({30, -20, 10}, {1, 0.5, 2});
  const Points source = pcl6d::transformed(data(), far.inverse());
  const IcpResult result = run(model(), source, {}, {}, far);
  EXPECT_EQ(result.status, Status::kOk);
  const auto error = pcl6d::distanceBetween(kTruth * far, result.T_target_source);
  EXPECT_LT(error.translation, 20 * kExactTol); // floats 40 m from their origin
}

TEST(Icp, SaysThatTheIterationLimitWasReached)
{
  IcpOptions options;
  options.max_iterations = 2;
  const IcpResult result = run(model(), data(), options);
  EXPECT_EQ(result.status, Status::kMaxIterations);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_FALSE(sameBits(result.T_target_source, kIdentity)) << "the last iterate";
}

TEST(Icp, ReturnsTheGuessWithFewerThanThreePairs)
{
  const Eigen::Isometry3d guess = pcl6d::poseFromEuler({1, 2, 3}, {0.1, 0.2, 0.3});
  const Points two{{0, 0, 0}, {1, 0, 0}}, none{{kNan, 0, 0}};
  const Points far = pcl6d::transformed(data(), pcl6d::poseFromEuler({0, 0, 99}, {}));
  for (const auto& source : {two, none, Points(), far}) {
    const IcpResult result = run(model(), source, {}, {}, guess);
    EXPECT_EQ(result.status, Status::kTooFewPairs);
    EXPECT_TRUE(sameBits(result.T_target_source, guess));
    EXPECT_FALSE(result.covariance);
    EXPECT_LT(result.pairs, 3u);
  }
  EXPECT_EQ(run({}, data()).status, Status::kTooFewPairs);
  EXPECT_EQ(run({{kNan, 0, 0}}, data()).overlap, 0);
}

TEST(Icp, ReturnsTheGuessWhenPairsRunOutOnTheWay)
{
  // Annealing: pairs within 2 m at the start, none within 0.1 m at the end.
  const Points target{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {9, 9, 0}};
  const Points source{{0, 0, 1}, {9, 0, -1}, {0, 9, -1}, {9, 9, 1}};
  IcpOptions options;
  options.max_distance_start = 2;
  options.max_distance = 0.1;
  const Eigen::Isometry3d guess = pcl6d::poseFromEuler({0.01, 0, 0}, {});
  const IcpResult result = run(target, source, options, {}, guess);
  EXPECT_EQ(result.status, Status::kTooFewPairs);
  EXPECT_GT(result.iterations, 1);
  EXPECT_TRUE(sameBits(result.T_target_source, guess));
}

TEST(Icp, SaysThatPairsOnALineFixNoMotion)
{
  Points line;
  for (int i = 0; i < 50; ++i)
    line.push_back({0.5f * static_cast<float>(i), 0, 0});
  EXPECT_EQ(run(line, line).status, Status::kRankDeficient);
}

TEST(Icp, ReturnsTheGuessWhenTheMinimiserDiverges)
{
  const Points target = model();
  const auto broken = [](const pcl6d::PairSums&) {
    pcl6d::RigidEstimate estimate{Status::kOk, kIdentity};
    estimate.transform.translation().x() = kNan;
    return estimate;
  };
  const IcpResult result = icp(PointTree(target), target, data(), kTruth, {}, broken);
  EXPECT_EQ(result.status, Status::kDiverged);
  EXPECT_TRUE(sameBits(result.T_target_source, kTruth));
}

TEST(Icp, GivesTheSameBitsForEveryNumberOfThreads)
{
  IcpOptions options;
  options.max_distance_start = 1;
  IcpResult first;
  for (const unsigned int threads : {1u, 2u, 3u, 8u}) {
    options.num_threads = threads;
    const IcpResult result = run(model(), data(), options);
    if (threads == 1)
      first = result;
    EXPECT_TRUE(sameBits(result.T_target_source, first.T_target_source));
    EXPECT_EQ(result.rms, first.rms);
    EXPECT_EQ(result.iterations, first.iterations);
    EXPECT_TRUE(sameBits(*result.covariance, *first.covariance));
  }
}

TEST(Icp, TellsItsObserverOfEveryIteration)
{
  std::vector<IcpIteration> seen;
  const IcpResult result = run(model(), data(), {}, [&](const IcpIteration& i) {
    seen.push_back(i);
    return true;
  });
  ASSERT_EQ(seen.size(), static_cast<std::size_t>(result.iterations));
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].number, static_cast<int>(i) + 1);
    EXPECT_EQ(seen[i].max_distance, IcpOptions().max_distance);
    EXPECT_GT(seen[i].pairs, 0u);
  }
  EXPECT_LT(seen.back().rms, seen.front().rms);
  EXPECT_LT(seen.back().translation, IcpOptions().translation_epsilon);
  EXPECT_LT(seen.back().rotation, IcpOptions().rotation_epsilon);
  EXPECT_TRUE(sameBits(seen.back().T_target_source, result.T_target_source));
}

TEST(Icp, StopsWhenItsObserverSaysSo)
{
  const auto result =
      run(model(), data(), {}, [](const IcpIteration& i) { return i.number < 3; });
  EXPECT_EQ(result.iterations, 3);
  EXPECT_EQ(result.status, Status::kMaxIterations);
}

TEST(Icp, ShrinksTheLimitToMaxDistanceBeforeItStops)
{
  IcpOptions options;
  options.max_distance_start = 1;
  options.max_distance = 0.1;
  options.distance_decay = 0.8;
  std::vector<double> limits;
  // Start at the solution: without annealing one iteration would be enough.
  const auto result = run(
      model(),
      data(),
      options,
      [&](const IcpIteration& i) {
        limits.push_back(i.max_distance);
        return true;
      },
      kTruth);
  EXPECT_EQ(result.status, Status::kOk);
  ASSERT_EQ(limits.size(), 12u); // 0.8^10 = 0.107 > 0.1 > 0.8^11
  for (std::size_t k = 0; k < limits.size(); ++k)
    EXPECT_NEAR(limits[k], std::max(0.1, std::pow(0.8, k)), 1e-12);
}

TEST(Icp, ComesFromFartherWithAnnealingAndIgnoresOutliers)
{
  // Points without a partner pull ICP with a fixed wide limit away: 27 mm, annealed 6 mm.
  Random random(3);
  Points source = data();
  for (std::size_t i = 0; i < kCount / 6; ++i) // 15 % of points behind the walls
    source.push_back((kTruth.inverse() * Eigen::Vector3d(random.uniform(0, 4),
                                                         random.uniform(0, 4),
                                                         random.uniform(-0.9, -0.3)))
                         .cast<float>());
  IcpOptions wide, annealed;
  wide.max_distance = 1;
  annealed.max_distance_start = 1;
  annealed.max_distance = 0.1;
  const auto error = [&](const IcpOptions& options) {
    const auto result = run(model(), source, options);
    return pcl6d::distanceBetween(kTruth, result.T_target_source).translation;
  };
  EXPECT_LT(error(annealed), kExactTol);
  EXPECT_GT(error(wide), 0.01);
}

TEST(IcpOptions, NameTheValueThatBreaksItsRule)
{
  const auto message = [](auto change) {
    IcpOptions options;
    change(options);
    return badArgumentOf([&] { run(model(), data(), options); });
  };
  EXPECT_EQ(message([](auto& o) { o.max_iterations = 0; }).find("max_iterations = 0"),
            0u);
  EXPECT_EQ(message([](auto& o) { o.max_distance = 0; }).find("max_distance = 0"), 0u);
  EXPECT_EQ(message([](auto& o) { o.max_distance = kNan; }).find("max_distance ="), 0u);
  EXPECT_EQ(message([](auto& o) {
              o.max_distance_start = -1;
            }).find("max_distance_start = -1"),
            0u);
  EXPECT_EQ(message([](auto& o) {
              o.max_distance_start = kNan;
            }).find("max_distance_start ="),
            0u);
  for (const double decay : {0.0, 1.0, -0.5, 1.5, double{kNan}})
    EXPECT_EQ(
        message([&](auto& o) { o.distance_decay = decay; }).find("distance_decay ="),
        0u);
  EXPECT_EQ(message([](auto& o) {
              o.translation_epsilon = -1;
            }).find("translation_epsilon ="),
            0u);
  EXPECT_EQ(
      message([](auto& o) { o.rotation_epsilon = -1; }).find("rotation_epsilon ="), 0u);
  EXPECT_NO_THROW(IcpOptions().validate());
}
