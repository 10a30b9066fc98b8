// SPDX-License-Identifier: BSD-3-Clause
#include "plane_pairs.h"
#include "support/fit_oracles.h"

#include <pcl6d/common/error.h>
#include <pcl6d/registration/plane_minimiser.h>

#include <gtest/gtest.h>

#include <limits>

using pcl6d::PlaneAccumulator;
using pcl6d::PlaneMinimiser;
using pcl6d::PlaneSums;
using pcl6d::Random;
using pcl6d::Status;
using pcl6d::Twist;
using pcl6d::test::kHalf;
using pcl6d::test::kPairs;
using pcl6d::test::makePlanes;
using pcl6d::test::Planes;
using pcl6d::test::randomPose;
using pcl6d::test::roomPlanes;

namespace {
/** The definition: all rows, and QR. */
Twist
denseSolution(const Planes& planes, const Eigen::Vector3d& centroid)
{
  Eigen::MatrixXd J(planes.source.size(), 6);
  Eigen::VectorXd r(planes.source.size());
  for (std::size_t i = 0; i < planes.source.size(); ++i) {
    const Eigen::Vector3d& n = planes.normal[i];
    J.row(i) << n.transpose(), (planes.source[i] - centroid).cross(n).transpose();
    r(i) = n.dot(planes.target[i] - planes.source[i]);
  }
  return pcl6d::test::leastSquares(J, r);
}

/** Steps until they rest. */
Eigen::Isometry3d
iterate(const PlaneMinimiser& step, const Planes& planes, int steps = 20)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int i = 0; i < steps; ++i) {
    const auto found = step(planes.moved(T).sums());
    EXPECT_EQ(found.status, Status::kOk);
    T = found.transform * T;
  }
  return T;
}

} // namespace

class PlaneSteps : public testing::TestWithParam<std::string> {
protected:
  PlaneMinimiser step_ = pcl6d::planeMinimiserFromName(GetParam());
};

TEST_P(PlaneSteps, SolveTheNormalEquations)
{
  Random random(6);
  const Planes planes = roomPlanes(random, Eigen::Isometry3d::Identity(), 1e-4);
  const PlaneSums sums = planes.sums();
  const Twist expected = denseSolution(planes, sums.mean_source);
  const auto found = step_(sums);
  ASSERT_EQ(found.status, Status::kOk);
  // Motions of 1e-5: the retraction differs from the twist by its square.
  EXPECT_LT(
      (pcl6d::rotationVector(found.transform.linear()) - expected.tail<3>()).norm(),
      1e-10);
  EXPECT_LT((found.transform * sums.mean_source - sums.mean_source - expected.head<3>())
                .norm(),
            1e-9);
}

TEST_P(PlaneSteps, GiveBackTheMotionThatMadeThePairs)
{
  Random random(7);
  for (const double angle : {0.0, 1e-6, 0.1, 0.5})
    for (int trial = 0; trial < 5; ++trial) {
      const Eigen::Isometry3d truth = randomPose(random, 1, angle);
      const auto error =
          pcl6d::distanceBetween(truth, iterate(step_, roomPlanes(random, truth)));
      EXPECT_LT(error.rotation, 1e-13);
      EXPECT_LT(error.translation, 1e-12);
    }
}

TEST_P(PlaneSteps, ComeToRestAtTheMinimumOfNoisyPairs)
{
  Random random(8);
  const Eigen::Isometry3d truth = randomPose(random, 1, 0.2);
  const Planes planes = roomPlanes(random, truth, 0.05);
  const Eigen::Isometry3d T = iterate(step_, planes);
  const double least = planes.moved(T).sums().residual_sq;
  for (int trial = 0; trial < 100; ++trial)
    EXPECT_GT(planes.moved(randomPose(random, 1e-3, 1e-4) * T).sums().residual_sq,
              least);
  // Both retractions end at the same pose.
  const auto other = iterate(pcl6d::planeStepByHelix, planes);
  EXPECT_LT(pcl6d::distanceBetween(T, other).translation, 1e-11);
}

TEST_P(PlaneSteps, SlideNotAlongASinglePlane)
{
  Random random(9);
  const Eigen::Matrix3d frame = pcl6d::test::randomRotation(random, 1);
  const Eigen::Vector3d n = frame.col(2);
  Planes planes =
      makePlanes(random, Eigen::Isometry3d::Identity(), 0, [&](auto&) { return n; });
  for (std::size_t i = 0; i < kPairs; ++i) { // all on the plane, the source 0.1 m off
    planes.target[i] -= n * n.dot(planes.target[i]);
    planes.source[i] += n * (0.1 - n.dot(planes.source[i]));
  }
  const auto found = step_(planes.sums());
  EXPECT_EQ(found.status, Status::kRankDeficient);
  EXPECT_LT((found.transform.translation() + 0.1 * n).norm(), 1e-12);
  EXPECT_LT((found.transform.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST_P(PlaneSteps, SlideNotAlongACorridor)
{
  // Walls with normals across x: x is free, all else is fixed.
  Random random(10);
  const Eigen::Isometry3d truth = pcl6d::poseFromEuler({0.7, 0.1, -0.2}, {0, 0, 0});
  const Planes planes = makePlanes(random, truth, 0, [&](const Eigen::Vector3d&) {
    return random.uniform() < 0.5 ? Eigen::Vector3d(Eigen::Vector3d::UnitY())
                                  : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
  });
  const auto found = step_(planes.sums());
  EXPECT_EQ(found.status, Status::kRankDeficient);
  EXPECT_LT((found.transform.translation() - Eigen::Vector3d(0, 0.1, -0.2)).norm(),
            1e-12);
}

TEST_P(PlaneSteps, TurnNotABall)
{
  Random random(11);
  Planes planes;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Eigen::Vector3d n = pcl6d::test::normalVector(random, 1).normalized();
    planes.normal.push_back(n);
    planes.target.push_back(2 * n);
    planes.source.push_back(2 * n + Eigen::Vector3d(0.1, 0, 0));
  }
  const auto found = step_(planes.sums());
  EXPECT_EQ(found.status, Status::kRankDeficient);
  // The smallest motion: the shift alone, no turn about the middle of the ball. The
  // centroid of random points is 2 m / sqrt(300) off it: a turn seen from there.
  EXPECT_LT((found.transform * Eigen::Vector3d(0.1, 0, 0)).norm(), 0.02);
}

TEST_P(PlaneSteps, DoNotDependOnTheUnitOfLength)
{
  Random random(14);
  const Eigen::Isometry3d truth = randomPose(random, 1, 0.1);
  const Planes planes = roomPlanes(random, truth);
  for (const double unit : {1e-8, 1e8}) {
    Planes scaled = planes;
    for (std::size_t i = 0; i < kPairs; ++i) {
      scaled.source[i] *= unit;
      scaled.target[i] *= unit;
    }
    const Eigen::Isometry3d found = iterate(step_, scaled);
    EXPECT_LT((found.linear() - truth.linear()).norm(), 1e-13);
    EXPECT_LT((found.translation() / unit - truth.translation()).norm(), 1e-12);
  }
}

TEST_P(PlaneSteps, SayWhatIsMissing)
{
  EXPECT_EQ(step_(PlaneSums()).status, Status::kTooFewPairs);
  Random random(12);
  const Planes planes = roomPlanes(random, randomPose(random, 0.1, 0.01));
  for (const std::size_t count : {1u, 2u, 5u})
    EXPECT_EQ(step_(planes.sums(0, count)).status, Status::kRankDeficient);
  EXPECT_EQ(step_(planes.sums(0, 30)).status, Status::kOk);
  PlaneSums sums = planes.sums();
  sums.A(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(step_(sums).status, Status::kDiverged);
  EXPECT_EQ(step_(sums).transform.matrix(), Eigen::Matrix4d::Identity());
  // One pair moves by its distance along the normal.
  PlaneAccumulator one;
  one.add({1, 2, 3}, {1, 5, 8}, {0, 0, 2});
  EXPECT_LT((step_(one.sums()).transform * Eigen::Vector3d(1, 2, 3) -
             Eigen::Vector3d(1, 2, 8))
                .norm(),
            1e-12);
}

TEST_P(PlaneSteps, KeepTheirDigitsFarFromTheOrigin)
{
  Random random(13);
  const Eigen::Vector3d centre(1e6, -1e6, 1e6);
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity(); // about the centre
  truth.linear() = pcl6d::test::randomRotation(random, 0.1);
  truth.translation() = centre - truth.linear() * centre + Eigen::Vector3d(1, 2, 3);
  const Planes planes = makePlanes(
      random,
      truth,
      0,
      [&](const Eigen::Vector3d&) { return pcl6d::test::randomVector(random, 1); },
      centre);
  const Eigen::Isometry3d found = iterate(step_, planes);
  // Coordinates are rounded to 2e-10 m; over 10 m that is 2e-11 rad, times 5.
  EXPECT_LT(pcl6d::distanceBetween(truth, found).rotation, 1e-10);
  EXPECT_LT((found * planes.source[0] - truth * planes.source[0]).norm(), 5e-9);
}

INSTANTIATE_TEST_SUITE_P(All,
                         PlaneSteps,
                         testing::ValuesIn(pcl6d::planeMinimiserNames()),
                         [](const auto& tested) { return tested.param; });
