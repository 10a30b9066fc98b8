// SPDX-License-Identifier: BSD-3-Clause
#include "graph_relaxation/error_diffusion_cases.h"
#include "support/points.h"

namespace pcl6d::test {

TEST(ErrorDiffusion, ClosesLoopsOneAfterTheOther)
{
  // A figure of eight: two rounds over the same scan 0, both with the same drift.
  Round round;
  round.edges.clear();
  for (std::size_t i = 1; i < round.poses.size(); ++i)
    round.edges.push_back({i - 1, i});
  Loop one, two;
  one.last = 6;
  one.corrected_last = round.poses[6] * poseFromEuler({0.2, 0.1, 0}, {0, 0, 0.05});
  two.first = 6;
  two.last = 12;
  two.corrected_last = round.poses[12] * poseFromEuler({0, 0.1, 0.2}, {0, 0.02, 0.05});
  const auto result = closeLoops(round.poses, round.edges, {one, two});
  EXPECT_EQ(result.status, Status::kOk);
  // Each lies to its first as it was matched: these loops only share scan 6.
  EXPECT_LT(largestDistance({result.poses[6]}, {one.corrected_last}), 1e-14);
  EXPECT_LT(largestDistance({result.poses[6].inverse() * result.poses[12]},
                            {round.poses[6].inverse() * two.corrected_last}),
            1e-14);
  EXPECT_TRUE(sameBits(result.poses[0], round.poses[0]));
}

TEST(ErrorDiffusion, OfALaterLoopLeavesAnEarlierOneNearlyClosed)
{
  Round round;
  Loop outer = round.loop, inner;
  outer.corrected_last = round.poses[11];
  outer.corrected_last.translation() += Eigen::Vector3d(0.5, -0.3, 0.2);
  inner.first = 3;
  inner.last = 9;
  inner.corrected_last = round.poses[9];
  inner.corrected_last.translation() += Eigen::Vector3d(0.1, 0, 0.1);
  inner.cost = PerDimension::Constant(1e-3); // a firm match takes little error
  const auto result = closeLoops(round.poses, round.edges, {inner, outer});
  const auto errorOf = [&](const Loop& loop) {
    return largestDistance(
        {result.poses[loop.first].inverse() * result.poses[loop.last]},
        {round.poses[loop.first].inverse() * loop.corrected_last});
  };
  EXPECT_LT(errorOf(outer), 1e-14);
  EXPECT_LT(errorOf(inner), 1e-3 * 0.7); // its share of about 0.7 m, of a way above 1
  EXPECT_GT(errorOf(inner), 1e-6);
  EXPECT_EQ(result.poses.size(), round.poses.size());
}

TEST(ErrorDiffusion, ClosesTheOtherLoopsIfOneIsRefused)
{
  Round round;
  Loop turned = round.loop;
  turned.last = 6;
  turned.corrected_last = round.poses[6];
  turned.corrected_last.linear() =
      rotationFromVector({M_PI, 0, 0}) * round.poses[6].linear();
  const auto result = closeLoops(round.poses, round.edges, {turned, round.loop});
  EXPECT_EQ(result.status, Status::kDiverged);
  expectSameBits(result.poses, round.closed(LoopClosing::kElch).poses);
  const auto none = closeLoops(round.poses, round.edges, {});
  EXPECT_EQ(none.status, Status::kOk);
  expectSameBits(none.poses, round.poses);
}

TEST(ErrorDiffusion, RefusesBadInputBeforeAnyLoop)
{
  const Round round;
  auto poses = round.poses;
  poses[2].translation().x() = kNan;
  EXPECT_EQ(badArgumentOf([&] { closeLoops(poses, round.edges, {}); }),
            "pose = 2, but must be finite and rigid");
  EXPECT_EQ(badArgumentOf([&] {
              closeLoops(round.poses, {{0, 99}}, {});
            }),
            "end of an edge = 99, but must be less than the 13 poses");
  Loop broken = round.loop;
  broken.corrected_last(0, 3) = kNan;
  EXPECT_EQ(badArgumentOf([&] {
              closeLoops(round.poses, round.edges, {round.loop, broken});
            }),
            "corrected pose of scan = 11, but must be finite and rigid");
}

TEST(ErrorDiffusion, WeighsPathsOfAnyLength)
{
  const auto at = [](double x, double y) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << x, y, 0;
    return pose;
  };
  const std::vector<Eigen::Isometry3d> poses{at(0, 0), at(3, 0), at(3, 4), at(0, 4)};
  const auto expected = pathWeights(poses, 0, 3);
  EXPECT_EQ(expected, (std::vector<double>{0, 0.3, 0.7, 1}));
  for (const double size : {1e-300, 1e-170, 1e200, 4e307}) {
    auto sized = poses;
    for (auto& pose : sized)
      pose.translation() *= size;
    const auto weights = pathWeights(sized, 0, 3);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(weights[i], expected[i], 1e-12) << size;
  }
}

TEST(ErrorDiffusion, RefusesALoopWhoseShiftOverflows)
{
  std::vector<Eigen::Isometry3d> poses(3, Eigen::Isometry3d::Identity());
  poses[2].translation().x() = -1.5e308;
  Loop loop;
  loop.last = 2;
  loop.corrected_last.translation().x() = 1.5e308;
  const auto one = closeLoop(poses, {}, loop, {LoopClosing::kUniform});
  EXPECT_EQ(one.status, Status::kDiverged);
  expectSameBits(one.poses, poses);
  const auto several = closeLoops(poses, {}, {loop}, {LoopClosing::kUniform});
  EXPECT_EQ(several.status, Status::kDiverged);
  expectSameBits(several.poses, poses);
}

TEST(ErrorDiffusion, MakesTheCorrectedRotationExact)
{
  Round round;
  round.loop.corrected_last.linear() *= 1.0004; // as of a file with 4 digits
  for (const LoopClosing method : kMethods)
    for (const auto& pose : round.closed(method).poses)
      EXPECT_TRUE(isRigid(pose, 1e-12)) << toString(method);
}

} // namespace pcl6d::test
