// SPDX-License-Identifier: BSD-3-Clause
#include "graph_relaxation/error_diffusion_cases.h"
#include "support/points.h"

namespace pcl6d::test {

TEST(ErrorDiffusion, KeepsTheFirstAndPutsTheLastWhereItWasMatched)
{
  const Round round;
  for (const auto method : kMethods) {
    SCOPED_TRACE(toString(method));
    const auto result = round.closed(method);
    EXPECT_EQ(result.status, Status::kOk);
    EXPECT_TRUE(sameBits(result.poses[0], round.poses[0]));
    EXPECT_TRUE(sameBits(result.poses[11], round.loop.corrected_last));
    for (const auto& pose : result.poses)
      EXPECT_TRUE(isRigid(pose, 1e-14));
  }
}

TEST(ErrorDiffusion, MovesEachPoseByItsShareOfTheClosingMotion)
{
  const Round round;
  const Eigen::Isometry3d& last = round.poses[11];
  const Eigen::Vector3d shift =
      round.loop.corrected_last.translation() - last.translation();
  const double angle = distanceBetween(last, round.loop.corrected_last).rotation;
  for (const bool per_axis : {false, true}) {
    const auto result = round.closed(LoopClosing::kElch, per_axis);
    for (std::size_t i = 0; i < round.poses.size(); ++i) {
      const PerDimension w = result.weights[i];
      const Eigen::Vector3d moved =
          result.poses[i].translation() - round.poses[i].translation();
      EXPECT_LT((moved - w.head<3>().cwiseProduct(shift)).norm(), 1e-14) << i;
      EXPECT_NEAR(distanceBetween(round.poses[i], result.poses[i]).rotation,
                  w[3] * angle,
                  1e-14);
      // about an axis of the world: in the middle, slerp between the ends
      const Eigen::Matrix3d turn =
          result.poses[i].linear() * round.poses[i].linear().transpose();
      const Eigen::Matrix3d whole =
          round.loop.corrected_last.linear() * last.linear().transpose();
      EXPECT_LT((turn - slerp(Eigen::Matrix3d::Identity(), whole, w[3])).norm(), 1e-14);
    }
    EXPECT_EQ(result.weights[3][0] != result.weights[3][1], per_axis);
    EXPECT_TRUE(result.weights[12] == result.weights[4]); // the branch
  }
}

TEST(ErrorDiffusion, MovesWithTheWorld)
{
  // 1e-12 m for positions of 1000 m: their rounding, times a few operations.
  Random random(6);
  const Round round;
  for (const double extent : {5.0, 500.0})
    for (const auto method : kMethods) {
      SCOPED_TRACE(toString(method));
      const Eigen::Isometry3d world = randomPose(random, extent, 2.5);
      auto expected = round.closed(method).poses;
      Round moved = round;
      for (auto& pose : moved.poses)
        pose = world * pose;
      for (auto& pose : expected)
        pose = world * pose;
      moved.loop.corrected_last = world * round.loop.corrected_last;
      EXPECT_LT(largestDistance(moved.closed(method).poses, expected), 5e-12);
    }
}

TEST(ErrorDiffusion, MovesWithTheWorldWhenCostsComeFromCovariances)
{
  Random random(7);
  Round round, turned;
  const Eigen::Isometry3d world = randomPose(random, 100, 2);
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = world.linear();
  for (std::size_t i = 0; i < round.edges.size(); ++i) {
    Eigen::Matrix<double, 6, 6> A;
    for (double& a : A.reshaped())
      a = random.normal();
    const Eigen::Matrix<double, 6, 6> covariance = A * A.transpose();
    round.edges[i].cost = costOfCovariance(covariance);
    turned.edges[i].cost = costOfCovariance(turn * covariance * turn.transpose());
  }
  for (auto& pose : turned.poses)
    pose = world * pose;
  turned.loop.corrected_last = world * turned.loop.corrected_last;
  auto expected = round.closed(LoopClosing::kElch).poses;
  for (auto& pose : expected)
    pose = world * pose;
  EXPECT_LT(largestDistance(turned.closed(LoopClosing::kElch).poses, expected), 1e-12);
  // The published weights, for each axis, depend on the axes: the test can tell.
  EXPECT_GT(largestDistance(turned.closed(LoopClosing::kElch, true).poses, expected),
            1e-3);
}

TEST(ErrorDiffusion, DoesNotMoveFarScansByTheLeverOfTheOrigin)
{
  // 10 scans 500 m from the origin, closed by 0.3 m and 0.02 rad.
  Round round(10);
  for (auto& pose : round.poses)
    pose.pretranslate(Eigen::Vector3d(500, 0, 0));
  round.loop.corrected_last = round.poses[9];
  round.loop.corrected_last.pretranslate(Eigen::Vector3d(0, 0.3, 0));
  round.loop.corrected_last.linear() =
      rotationFromVector({0, 0, 0.02}) * round.poses[9].linear();
  for (const auto method : kMethods) {
    const auto result = round.closed(method);
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_LE(distanceBetween(round.poses[i], result.poses[i]).translation,
                0.3 + 1e-12);
  }
}

TEST(ErrorDiffusion, ChangesNoBitWithoutMotion)
{
  Round round;
  round.loop.corrected_last = round.poses[round.loop.last];
  for (const auto method : kMethods)
    expectSameBits(round.closed(method).poses, round.poses);
}

TEST(ErrorDiffusion, OfNoneChangesNothing)
{
  const Round round;
  const auto result = round.closed(LoopClosing::kNone);
  EXPECT_EQ(result.status, Status::kOk);
  expectSameBits(result.poses, round.poses);
}

TEST(ErrorDiffusion, WeighsByIndexOrByPath)
{
  EXPECT_EQ(uniformWeights(7, 1, 5), (std::vector<double>{0, 0, .25, .5, .75, 1, 1}));
  EXPECT_EQ(uniformWeights(7, 5, 1), (std::vector<double>{1, 1, .75, .5, .25, 0, 0}));
  std::vector<Eigen::Isometry3d> poses(5, Eigen::Isometry3d::Identity());
  EXPECT_EQ(pathWeights(poses, 0, 4), (std::vector<double>{0, .25, .5, .75, 1}));
  for (int i = 0; i < 5; ++i)
    poses[i].translation().x() = i * i; // steps of 1, 3, 5, 7
  EXPECT_EQ(pathWeights(poses, 0, 4),
            (std::vector<double>{0, 1. / 16, 4. / 16, 9. / 16, 1}));
  EXPECT_EQ(pathWeights(poses, 3, 0),
            (std::vector<double>{1, 1 - 1. / 9, 1 - 4. / 9, 0, 0}));
}

TEST(ErrorDiffusion, IsUniformAndSaysSoWhereNoEdgesJoinTheLoop)
{
  Round round;
  const auto expected = round.closed(LoopClosing::kUniform).poses;
  round.edges.clear();
  round.edges.push_back({0, 1});
  const auto result = round.closed(LoopClosing::kElch);
  EXPECT_EQ(result.status, Status::kRankDeficient);
  expectSameBits(result.poses, expected);
}

TEST(ErrorDiffusion, RefusesAClosingRotationOfHalfATurn)
{
  Random random(8);
  for (const double angle : {M_PI, M_PI - 1e-9, M_PI - 1e-4}) {
    Round round;
    round.loop.corrected_last.linear() =
        randomRotation(random, angle) * round.poses[11].linear();
    for (const auto method : kMethods) {
      const auto result = round.closed(method);
      EXPECT_EQ(result.status, Status::kDiverged);
      expectSameBits(result.poses, round.poses);
    }
  }
  Round round;
  round.loop.corrected_last.linear() =
      randomRotation(random, 3.1) * round.poses[11].linear();
  EXPECT_EQ(round.closed(LoopClosing::kElch).status, Status::kOk);
}

TEST(ErrorDiffusion, KnowsItsMethodsByName)
{
  EXPECT_EQ(loopClosingNames(),
            (std::vector<std::string>{"elch", "uniform", "path", "none"}));
  for (const auto& name : loopClosingNames())
    EXPECT_EQ(toString(loopClosingFromName(name)), name);
  EXPECT_EQ(badArgumentOf([] { loopClosingFromName("lum"); }),
            "loop-closing = lum, but must be elch|uniform|path|none");
}

TEST(ErrorDiffusion, RefusesPosesAndLoopsThatAreNone)
{
  const auto message = [](auto&& spoil) {
    Round round;
    spoil(round);
    return badArgumentOf([&] { round.closed(LoopClosing::kUniform); });
  };
  EXPECT_EQ(message([](Round& r) { r.poses[4](0, 3) = kNan; }),
            "pose = 4, but must be finite and rigid");
  EXPECT_EQ(message([](Round& r) { r.poses[4].linear() *= 2; }),
            "pose = 4, but must be finite and rigid");
  EXPECT_EQ(message([](Round& r) { r.loop.corrected_last(1, 1) = kNan; }),
            "corrected pose of scan = 11, but must be finite and rigid");
  EXPECT_EQ(message([](Round& r) { r.loop.last = 13; }),
            "last = 13, but must be less than the 13 poses");
  EXPECT_EQ(message([](Round& r) { r.loop.last = 0; }),
            "last = 0, but must be another scan than the first of the loop");
  EXPECT_EQ(message([](Round& r) { r.edges[0].b = 99; }),
            "end of an edge = 99, but must be less than the 13 poses");
  EXPECT_NE(message([](Round& r) { r.edges[0].cost[2] = -1; }).find("cost of an edge"),
            std::string::npos);
  EXPECT_NE(message([](Round& r) { r.poses.clear(); }).find("0 poses"),
            std::string::npos);
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
  covariance(5, 5) = -1;
  EXPECT_NE(badArgumentOf([&] { costOfCovariance(covariance); }), "");
}

} // namespace pcl6d::test
