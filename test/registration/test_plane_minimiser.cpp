// SPDX-License-Identifier: BSD-3-Clause
#include "support/pairs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/registration/plane_minimiser.h>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <limits>

using pcl6d::PlaneAccumulator;
using pcl6d::PlaneMinimiser;
using pcl6d::PlaneSums;
using pcl6d::Random;
using pcl6d::Status;
using pcl6d::Twist;
using pcl6d::test::randomPose;

namespace {
constexpr std::size_t kPairs = 300;
constexpr double kHalf = 10; // [m] half side of the cube that holds the points
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/** Rounding of a sum of kPairs terms up to (2 kHalf)^2, grown like the root of their
 * number (bounded by 32). */
constexpr double kSumTol = 32 * kEpsilon * kPairs * 4 * kHalf * kHalf;

/** Points and the planes that they belong to. */
struct Planes {
  std::vector<Eigen::Vector3d> source, target, normal;

  PlaneSums
  sums(std::size_t begin, std::size_t end) const
  {
    PlaneAccumulator accumulator;
    for (std::size_t i = begin; i < end; ++i)
      accumulator.add(source[i], target[i], normal[i]);
    return accumulator.sums();
  }
  PlaneSums
  sums() const
  {
    return sums(0, source.size());
  }

  Planes
  moved(const Eigen::Isometry3d& T) const
  {
    Planes result = *this;
    for (auto& d : result.source)
      d = T * d;
    return result;
  }
};

/** Pairs whose source was moved by truth^-1 and then slid along the planes, which the
 * distance to a plane does not feel; noise along the normals.
 * \param[in] normal_of gives the normal of a point */
template <typename NormalOf>
Planes
makePlanes(Random& random,
           const Eigen::Isometry3d& truth,
           double sigma,
           NormalOf normal_of,
           const Eigen::Vector3d& centre = Eigen::Vector3d::Zero())
{
  Planes planes;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Eigen::Vector3d m = centre + pcl6d::test::randomVector(random, kHalf);
    const Eigen::Vector3d n = normal_of(m).normalized();
    const Eigen::Vector3d slide = n.cross(pcl6d::test::randomVector(random, 0.5));
    planes.target.push_back(m);
    planes.normal.push_back(n);
    planes.source.push_back(truth.inverse() *
                            (m + slide + sigma * random.normal() * n));
  }
  return planes;
}

Planes
roomPlanes(Random& random, const Eigen::Isometry3d& truth, double sigma = 0)
{
  return makePlanes(random, truth, sigma, [&](const Eigen::Vector3d&) {
    return pcl6d::test::randomVector(random, 1);
  });
}

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
  return J.colPivHouseholderQr().solve(r);
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

void
expectNear(const PlaneSums& found, const PlaneSums& expected, double scale = 1)
{
  EXPECT_EQ(found.count, expected.count);
  EXPECT_EQ(found.weight, expected.weight);
  EXPECT_LT((found.mean_source - expected.mean_source).norm(), kSumTol * scale);
  EXPECT_LT((found.A - expected.A).norm(), kSumTol * scale);
  EXPECT_LT((found.b - expected.b).norm(), kSumTol * scale);
  EXPECT_NEAR(found.residual_sq, expected.residual_sq, kSumTol * scale);
  EXPECT_LT((found.scatter - expected.scatter).norm(), kSumTol * scale);
}
} // namespace

TEST(PlaneSums, EqualTheirDefinitions)
{
  Random random(1);
  const Planes planes = roomPlanes(random, randomPose(random, 1, 0.1), 0.05);
  const PlaneSums sums = planes.sums();
  PlaneSums expected;
  expected.count = kPairs;
  expected.weight = kPairs;
  for (const auto& d : planes.source)
    expected.mean_source += d / kPairs;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Eigen::Vector3d& n = planes.normal[i];
    const Eigen::Vector3d d = planes.source[i] - expected.mean_source;
    const double r = n.dot(planes.target[i] - planes.source[i]);
    Twist a;
    a << n, d.cross(n);
    expected.A += a * a.transpose();
    expected.b += a * r;
    expected.residual_sq += r * r;
    expected.scatter += d * d.transpose();
  }
  expectNear(sums, expected);
}

TEST(PlaneSums, MergeToTheSumsOfTheWholeForEverySplit)
{
  Random random(2);
  const Planes planes = roomPlanes(random, randomPose(random, 1, 0.1), 0.05);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<PlaneSums> parts{PlaneSums()}; // nothing changes nothing
    for (std::size_t begin = 0; begin < kPairs;) {
      const std::size_t end =
          std::min(kPairs, begin + 1 + static_cast<std::size_t>(random.uniform() * 60));
      parts.push_back(planes.sums(begin, end));
      begin = end;
    }
    expectNear(pcl6d::mergeTree(parts, &PlaneSums::merge), planes.sums());
  }
}

TEST(PlaneSums, LoseNoDigitsFarFromTheOrigin)
{
  Random near_random(3), far_random(3);
  const auto normal = [](const Eigen::Vector3d& m) {
    return Eigen::Vector3d(std::sin(m.x()), std::cos(m.y()), std::sin(m.z() * m.x()));
  };
  const Planes near =
      makePlanes(near_random, Eigen::Isometry3d::Identity(), 0.05, normal);
  Planes far = near;
  const Eigen::Vector3d away(1048576, -1048576, 1048576); // 2^20 m
  for (std::size_t i = 0; i < kPairs; ++i) {
    far.source[i] += away;
    far.target[i] += away;
  }
  // Coordinates are rounded to 1.2e-10 m there; times a lever of 20 m and kPairs.
  const double rounding = 1.2e-10 * 2 * kHalf * kPairs;
  EXPECT_LT((far.sums().A - near.sums().A).norm(), 2 * kHalf * rounding);
  EXPECT_LT((far.sums().b - near.sums().b).norm(), 2 * kHalf * rounding);
}

TEST(PlaneSums, SkipWhatIsNotFiniteAndNormalsOfNoLength)
{
  Random random(4);
  const Planes planes = roomPlanes(random, Eigen::Isometry3d::Identity(), 0.1);
  PlaneAccumulator accumulator;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d bad(nan, 0, 1), good(1, 2, 3), zero(0, 0, 0);
  accumulator.add(bad, good, good); // also as the first, about which the sums are taken
  for (std::size_t i = 0; i < kPairs; ++i) {
    accumulator.add(planes.source[i], planes.target[i], planes.normal[i]);
    accumulator.add(good, bad, good);
    accumulator.add(good, good, bad);
    accumulator.add(good, good, zero);
    accumulator.add(good, good, {std::numeric_limits<double>::infinity(), 0, 0});
  }
  const PlaneSums expected = planes.sums();
  EXPECT_EQ(accumulator.sums().count, kPairs);
  EXPECT_EQ(accumulator.sums().A, expected.A);
  EXPECT_EQ(accumulator.sums().b, expected.b);
}

TEST(PlaneSums, TakeTheDirectionOfANormalAlone)
{
  Random random(5);
  Planes planes = roomPlanes(random, Eigen::Isometry3d::Identity(), 0.1);
  const PlaneSums expected = planes.sums();
  for (auto& n : planes.normal)
    n *= 7;
  expectNear(planes.sums(), expected);
}

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

TEST(PlaneMinimiserFromName, NamesAllWhenThereIsNoSuchOne)
{
  EXPECT_EQ(pcl6d::planeMinimiserNames(),
            (std::vector<std::string>{"linear", "helix"}));
  try {
    pcl6d::planeMinimiserFromName("lls");
    ADD_FAILURE() << "no exception";
  } catch (const pcl6d::BadArgument& e) {
    EXPECT_STREQ(e.what(), "plane minimiser = lls, but must be linear|helix");
  }
}
