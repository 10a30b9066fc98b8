// SPDX-License-Identifier: BSD-3-Clause
#include "ring_graph.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** What a pose is off, as the twist about its position, axes of the world. */
Twist
errorOf(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth)
{
  Twist error;
  error << found.translation() - truth.translation(),
      rotationVector(found.linear() * truth.linear().transpose());
  return error;
}

/** Sample covariance of the poses over many runs, beside the mean of those reported. */
struct Trials {
  std::vector<Matrix6> sampled, reported;
  double link_variance = 0; ///< mean s^2 [m^2]
};

Trials
runTrials(const GraphSlamOptions& options, int count)
{
  Trials trials;
  for (int trial = 0; trial < count; ++trial) {
    GraphRecipe recipe;
    recipe.pairs = 40;
    recipe.start_shift = recipe.start_turn = 0;
    recipe.seed = 1000 + trial;
    const GraphCase graph = makeGraph(recipe);
    const auto result = GraphSlam(options).relax(graph.start, graph.links);
    trials.sampled.resize(recipe.scans, Matrix6::Zero());
    trials.reported.resize(recipe.scans, Matrix6::Zero());
    for (std::size_t j = 0; j < recipe.scans; ++j) {
      const Twist error = errorOf(result.poses[j], graph.truth[j]);
      trials.sampled[j] += error * error.transpose() / count;
      trials.reported[j] += result.covariances[j] / count;
    }
    for (const LinkReport& link : result.links)
      trials.link_variance +=
          link.variance / (count * static_cast<double>(result.links.size()));
  }
  return trials;
}
} // namespace

// 300 runs: a sampled variance has a relative standard deviation of sqrt(2/300) = 8 %, the
// largest of 54 of them 3 of these; the mean of all about 2 to 3 %, as they are correlated.
TEST(PoseCovariances, AreThoseOfManyRuns)
{
  for (const LinkWeights weights : {LinkWeights::kPairs, LinkWeights::kCovariance}) {
    SCOPED_TRACE(toString(weights));
    GraphSlamOptions options = exactOptions(Relaxation::kHelix, weights);
    options.translation_epsilon = options.rotation_epsilon = 1e-6;
    const Trials trials = runTrials(options, 300);
    EXPECT_EQ(trials.reported[0], Matrix6::Zero());
    double mean = 0;
    for (std::size_t j = 1; j < trials.sampled.size(); ++j)
      for (int i = 0; i < 6; ++i) {
        const double ratio = trials.sampled[j](i, i) / trials.reported[j](i, i);
        EXPECT_NEAR(ratio, 1, 0.35) << "pose " << j << ", entry " << i;
        mean += ratio / 54;
      }
    EXPECT_NEAR(mean, 1, 0.1);
    // 3600 links with 114 degrees of freedom each: 0.2 %; both points have noise of 5 cm.
    EXPECT_NEAR(trials.link_variance, 2 * 0.05 * 0.05, 0.01 * 2 * 0.05 * 0.05);
  }
}

TEST(PoseCovariances, DoNotDependOnTheJointMethod)
{
  const GraphCase graph = makeGraph({});
  const auto helix =
      GraphSlam(exactOptions(Relaxation::kHelix)).relax(graph.start, graph.links);
  for (const Relaxation relaxation : {Relaxation::kEuler, Relaxation::kQuaternion}) {
    const auto other =
        GraphSlam(exactOptions(relaxation)).relax(graph.start, graph.links);
    for (std::size_t j = 1; j < graph.start.size(); ++j)
      EXPECT_LT((helix.covariances[j] - other.covariances[j]).norm(),
                1e-6 * helix.covariances[j].norm());
  }
}

TEST(PoseCovariances, OfSmallAnglesAreBlocks)
{
  const GraphCase graph = makeGraph({});
  const auto result =
      GraphSlam(exactOptions(Relaxation::kSmallAngle)).relax(graph.start, graph.links);
  for (std::size_t j = 1; j < graph.start.size(); ++j) {
    const Matrix6& C = result.covariances[j];
    EXPECT_EQ(C.topRightCorner(3, 3).norm(), 0);
    EXPECT_GT(C(0, 0), 0);
    EXPECT_EQ(C(0, 0), C(2, 2));
    EXPECT_GT(C.bottomRightCorner(3, 3).determinant(), 0);
  }
}

TEST(PoseCovariances, TurnIntoEulerAnglesByTheirDerivatives)
{
  Random random(1);
  const Eigen::Isometry3d pose = poseFromEuler({1, 2, 3}, {0.4, -0.7, 2});
  Eigen::Matrix<double, 6, 6> root;
  for (int i = 0; i < 36; ++i)
    root(i) = random.uniform(-1, 1);
  constexpr double kStep = 1e-6;
  Matrix6 H_inverse; // d (x, y, z, roll, pitch, yaw) / d X, by differences
  for (int i = 0; i < 6; ++i) {
    const auto vectorAt = [&](double step) {
      const Eigen::Isometry3d moved = moveByHelix(pose, step * Twist::Unit(i));
      const EulerAngles a = eulerFromRotation(moved.linear());
      return (Twist() << moved.translation(), a.roll, a.pitch, a.yaw).finished();
    };
    H_inverse.col(i) = (vectorAt(-kStep) - vectorAt(kStep)) / (2 * kStep);
  }
  const Matrix6 C = root * root.transpose();
  const Matrix6 expected = H_inverse * C * H_inverse.transpose();
  EXPECT_LT((eulerCovariance(pose, C) - expected).norm(), 1e-7 * expected.norm());
  EXPECT_LT((twistCovariance(pose, eulerCovariance(pose, C)) - C).norm(),
            1e-12 * C.norm());
}

TEST(PoseCovariances, MoveToAnotherOriginAndBack)
{
  const Eigen::Isometry3d pose = poseFromEuler({10, -20, 3}, {0.4, -0.7, 2});
  // A pure turn about the pose moves the world's origin by -x x t.
  Matrix6 turn = Matrix6::Zero();
  turn(5, 5) = 1;
  const Matrix6 C = covarianceAbout(Eigen::Vector3d::Zero(), pose, turn);
  const Eigen::Vector3d velocity =
      -Eigen::Vector3d::UnitZ().cross(Eigen::Vector3d(10, -20, 3));
  EXPECT_LT((C.topLeftCorner(3, 3) - velocity * velocity.transpose()).norm(), 1e-12);
}

TEST(LinkReports, BecomeMeasuredPosesWithTheSameOptimum)
{
  const GraphCase graph = makeGraph({});
  const GraphSlamOptions options =
      exactOptions(Relaxation::kHelix, LinkWeights::kCovariance);
  const auto by_pairs = GraphSlam(options).relax(graph.start, graph.links);
  std::vector<PoseLink> measured;
  for (const LinkReport& link : by_pairs.links)
    measured.push_back(poseLinkOf(link, by_pairs.poses));
  GraphSlam slam(options);
  slam.setMeasuredLinks(measured);
  const auto by_poses = slam.relax(graph.start, std::vector<LinkPairs>{});
  ASSERT_EQ(by_poses.status, Status::kOk);
  // The corrections are linearised at the optimum, where they are centimetres.
  EXPECT_LT(largestDistance(by_pairs.poses, by_poses.poses), 1e-3);
  EXPECT_LT(largestTurn(by_pairs.poses, by_poses.poses), 1e-4);
  for (std::size_t j = 1; j < graph.start.size(); ++j)
    EXPECT_LT((by_pairs.covariances[j] - by_poses.covariances[j]).norm(),
              0.02 * by_pairs.covariances[j].norm());
}

TEST(LinkReports, KnowTheRelativePoseOfTheirPairs)
{
  GraphRecipe recipe;
  recipe.noise = 0;
  recipe.start_shift = 0.05;
  recipe.start_turn = 1e-3;
  const GraphCase graph = makeGraph(recipe);
  GraphSlamOptions options;
  options.max_iterations = 1;
  options.num_threads = 1;
  const auto result = GraphSlam(options).relax(graph.start, graph.links);
  for (const LinkReport& link : result.links) {
    const PoseLink measured = poseLinkOf(link, result.poses);
    const MotionSize off = distanceBetween(
        measured.T_from_to, graph.truth[link.from].inverse() * graph.truth[link.to]);
    EXPECT_LT(off.translation, 1e-5);
    EXPECT_LT(off.rotation, 1e-6);
  }
}
