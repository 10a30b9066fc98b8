// SPDX-License-Identifier: BSD-3-Clause
// N of Generalized-ICP, and sums of pairs with a symmetric N.
#include "support/fit_oracles.h"
#include "support/pairs.h"

#include <pcl6d/registration/plane_minimiser.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <limits>

using pcl6d::PlaneAccumulator;
using pcl6d::PlaneSums;
using pcl6d::planeToPlane;
using pcl6d::Random;
using pcl6d::Twist;
using pcl6d::test::normalVector;
using pcl6d::test::randomVector;

namespace {
using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

Vector
direction(Random& random)
{
  return normalVector(random, 1).normalized();
}

/** The definition: covariances of 1 along a plane and epsilon across it. */
Matrix
byInverse(const Vector& n, const Vector& m, double epsilon)
{
  const auto covariance = [&](const Vector& normal) {
    return Matrix(Matrix::Identity() - (1 - epsilon) * normal * normal.transpose());
  };
  return 2 * epsilon * (covariance(n) + covariance(m)).inverse();
}

struct NormPairs {
  std::vector<Vector> source, target;
  std::vector<Matrix> N;
  std::vector<double> weight;

  explicit NormPairs(Random& random, int count = 200)
  {
    for (int i = 0; i < count; ++i) {
      source.push_back(Vector(5, -3, 8) + randomVector(random, 4));
      target.push_back(source.back() + normalVector(random, 0.1));
      N.push_back(planeToPlane(direction(random), direction(random)));
      weight.push_back(random.uniform(0.1, 2));
    }
  }
  PlaneSums
  sums(std::size_t begin, std::size_t end) const
  {
    PlaneAccumulator sums;
    for (std::size_t i = begin; i < end; ++i)
      sums.addNorm(source[i], target[i], N[i], weight[i]);
    return sums.sums();
  }
  PlaneSums
  sums() const
  {
    return sums(0, source.size());
  }
  /** sum w |m - d - v(d)|^2_N for a twist about a centre */
  double
  cost(const Twist& u, const Vector& centre) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < source.size(); ++i) {
      const Vector v =
          u.head<3>() + Vector(u.tail<3>()).cross(Vector(source[i] - centre));
      const Vector e = target[i] - source[i] - v;
      sum += weight[i] * e.dot(N[i] * e);
    }
    return sum;
  }
};

void
expectSumsNear(const PlaneSums& a, const PlaneSums& b, double tolerance = 1e-9)
{
  EXPECT_EQ(a.count, b.count);
  EXPECT_NEAR(a.weight, b.weight, tolerance);
  EXPECT_LT((a.mean_source - b.mean_source).norm(), tolerance);
  EXPECT_LT((a.A - b.A).norm(), tolerance * (1 + b.A.norm()));
  EXPECT_LT((a.b - b.b).norm(), tolerance);
  EXPECT_NEAR(a.residual_sq, b.residual_sq, tolerance);
  EXPECT_NEAR(a.distance_sq, b.distance_sq, tolerance);
  EXPECT_LT((a.scatter - b.scatter).norm(), tolerance * (1 + b.sourceSq()));
}
} // namespace

TEST(PlaneToPlane, IsTheInverseOfTheSumOfCovariances)
{
  Random random(1);
  for (const double epsilon : {1e-1, 1e-3, 1e-6}) {
    for (int trial = 0; trial < 200; ++trial) {
      const Vector n = direction(random), m = direction(random);
      const Vector across = n.cross(m).normalized(), zero = Vector::Zero();
      const Vector near = (n + 1e-5 * m).normalized();
      for (const auto& [a, b] : std::vector<std::pair<Vector, Vector>>{{n, m},
                                                                       {n, n},
                                                                       {n, -n},
                                                                       {n, near},
                                                                       {n, across},
                                                                       {n, zero},
                                                                       {zero, m},
                                                                       {zero, zero}})
        // The sum has values from 2 epsilon to 2: rounding grows by 1 / epsilon.
        EXPECT_LT((planeToPlane(a, b, epsilon) - byInverse(a, b, epsilon)).norm(),
                  2e-14 / epsilon);
    }
  }
}

TEST(PlaneToPlane, DoesNotSeeSignsNorOrder)
{
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector n = direction(random), m = direction(random);
    const Matrix N = planeToPlane(n, m);
    EXPECT_LT((planeToPlane(-n, m) - N).norm(), 1e-13);
    EXPECT_LT((planeToPlane(n, -m) - N).norm(), 1e-13);
    EXPECT_LT((planeToPlane(m, n) - N).norm(), 1e-13);
    EXPECT_LT((N - N.transpose()).norm(), 1e-15);
    EXPECT_GT(pcl6d::test::smallestEigenvalue(N), 0);
    const Matrix R = pcl6d::test::randomRotation(random, 2);
    EXPECT_LT((planeToPlane(R * n, R * m) - R * N * R.transpose()).norm(), 1e-13);
  }
}

TEST(PlaneToPlane, GivesEqualPlanesTheirDistance)
{
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector n = direction(random), along = n.unitOrthogonal();
    const Matrix N = planeToPlane(n, trial % 2 ? n : -n);
    EXPECT_NEAR(n.dot(N * n), 1, 1e-12);
    EXPECT_NEAR(along.dot(N * along), 1e-3, 1e-12);
  }
}

TEST(PlaneSumsWithNorms, EqualThoseOfNormalsForADyad)
{
  Random random(4);
  const NormPairs pairs(random);
  PlaneAccumulator norms, normals;
  for (std::size_t i = 0; i < pairs.source.size(); ++i) {
    const Vector n = direction(random);
    norms.addNorm(pairs.source[i], pairs.target[i], n * n.transpose(), pairs.weight[i]);
    normals.add(pairs.source[i], pairs.target[i], 3 * n, pairs.weight[i]);
  }
  expectSumsNear(norms.sums(), normals.sums());
}

TEST(PlaneSumsWithNorms, OfTwoNormalsAreThoseOfTheirNorm)
{
  Random random(7);
  const NormPairs pairs(random);
  for (std::size_t count = 1; count < 20;
       ++count) { // whole eights, and what is left over
    PlaneAccumulator norms, planes;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector n = direction(random), m = direction(random);
      norms.addNorm(
          pairs.source[i], pairs.target[i], planeToPlane(n, m, 1e-2), pairs.weight[i]);
      planes.addPlanes(pairs.source[i], pairs.target[i], n, m, 1e-2, pairs.weight[i]);
    }
    expectSumsNear(planes.sums(), norms.sums());
  }
  PlaneAccumulator none;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  none.addPlanes(
      Vector::Zero(), Vector::Zero(), Vector(0, nan, 0), Vector::UnitZ(), 1e-2);
  none.addPlanes(
      Vector(nan, 0, 0), Vector::Zero(), Vector::UnitX(), Vector::UnitZ(), 1e-2);
  EXPECT_EQ(none.sums().count, 0U);
}

TEST(PlaneSumsWithNorms, AreTheDerivativesOfTheCost)
{
  // cost(u) = residual_sq - 2 b u + u A u: exact for a quadratic, by differences too.
  Random random(5);
  const NormPairs pairs(random);
  const PlaneSums sums = pairs.sums();
  const auto cost = [&](const Twist& u) { return pairs.cost(u, sums.mean_source); };
  EXPECT_NEAR(cost(Twist::Zero()), sums.residual_sq, 1e-10);
  for (int i = 0; i < 6; ++i) {
    const Twist e = Twist::Unit(i);
    EXPECT_NEAR((cost(e) - cost(-e)) / 2, -2 * sums.b(i), 1e-8);
    for (int j = 0; j < 6; ++j) {
      const Twist f = Twist::Unit(j);
      const double second = cost(e + f) - cost(e) - cost(f) + cost(Twist::Zero());
      EXPECT_NEAR(second, 2 * sums.A(i, j), 1e-8) << i << ", " << j;
    }
  }
}

TEST(PlaneSumsWithNorms, EqualTheirDefinitions)
{
  Random random(6);
  const NormPairs pairs(random);
  double weight = 0, distance_sq = 0, source_sq = 0;
  Vector mean = Vector::Zero();
  for (std::size_t i = 0; i < pairs.source.size(); ++i) {
    weight += pairs.weight[i];
    mean += pairs.weight[i] * pairs.source[i];
    distance_sq += pairs.weight[i] * (pairs.target[i] - pairs.source[i]).squaredNorm();
  }
  mean /= weight;
  for (std::size_t i = 0; i < pairs.source.size(); ++i)
    source_sq += pairs.weight[i] * (pairs.source[i] - mean).squaredNorm();
  const PlaneSums sums = pairs.sums();
  EXPECT_EQ(sums.count, pairs.source.size());
  EXPECT_NEAR(sums.weight, weight, 1e-10);
  EXPECT_LT((sums.mean_source - mean).norm(), 1e-11);
  EXPECT_NEAR(sums.distance_sq, distance_sq, 1e-10);
  EXPECT_NEAR(sums.sourceSq(), source_sq, 1e-8);
}

TEST(PlaneSumsWithNorms, MergeToTheSumsOfTheWholeForEverySplit)
{
  Random random(7);
  const NormPairs pairs(random, 60);
  for (std::size_t cut = 0; cut <= 60; ++cut) {
    const PlaneSums a = pairs.sums(0, cut), b = pairs.sums(cut, 60);
    expectSumsNear(PlaneSums::merge(a, b), pairs.sums());
    expectSumsNear(PlaneSums::merge(b, a), pairs.sums());
  }
}

TEST(PlaneSumsWithNorms, SkipWhatIsNotFinite)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vector bad(0, nan, 0), good(1, 2, 3);
  Matrix bad_norm = Matrix::Identity();
  bad_norm(1, 2) = nan;
  Random random(8);
  const NormPairs pairs(random, 30);
  PlaneAccumulator sums;
  sums.addNorm(bad, good, Matrix::Identity());
  for (std::size_t i = 0; i < 30; ++i) {
    sums.addNorm(pairs.source[i], pairs.target[i], pairs.N[i], pairs.weight[i]);
    sums.addNorm(good, bad, Matrix::Identity());
    sums.addNorm(good, good, bad_norm);
  }
  EXPECT_EQ(sums.sums().A, pairs.sums().A);
  EXPECT_EQ(sums.sums().b, pairs.sums().b);
  EXPECT_EQ(sums.sums().count, 30u);
}

TEST(PlaneSumsWithNorms, LoseNoDigitsFarFromTheOrigin)
{
  Random random(9);
  const NormPairs near(random);
  NormPairs far = near;
  for (std::size_t i = 0; i < far.source.size(); ++i) {
    far.source[i] += Vector::Constant(1048576); // 2^20 m
    far.target[i] += Vector::Constant(1048576);
  }
  // Coordinates are rounded to 1.2e-10 m there; times a lever of 8 m and 200 pairs.
  EXPECT_LT((far.sums().A - near.sums().A).norm(), 1e-5);
  EXPECT_LT((far.sums().b - near.sums().b).norm(), 1e-6);
}

TEST(PlaneSums, CountThePointDistanceToo)
{
  PlaneAccumulator sums;
  sums.add({0, 0, 0}, {3, 4, 0}, {0, 1, 0}, 2);
  sums.add({1, 0, 0}, {1, 0, 2}, {1, 0, 0}, 0.5);
  EXPECT_DOUBLE_EQ(sums.sums().distance_sq, 2 * 25 + 0.5 * 4);
  EXPECT_DOUBLE_EQ(sums.sums().residual_sq, 2 * 16);
}
