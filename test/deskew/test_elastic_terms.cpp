// SPDX-License-Identifier: BSD-3-Clause
// Rules between the poses of a scanner that moves.
#include "support/moving_room.h"

#include <pcl6d/common/error.h>
#include <pcl6d/deskew/elastic_terms.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::ElasticTerm;
using pcl6d::MotionNoise;
using Poses = std::vector<Eigen::Isometry3d>;

constexpr double kRounding = 1e-9; // of numbers about 1

std::vector<ElasticTerm>
between(const std::vector<double>& stamps)
{
  return pcl6d::elasticTermsBetween({0, stamps[0]},
                                    {1, stamps[1]},
                                    {2, stamps[2]},
                                    {3, stamps[3]},
                                    MotionNoise::usual(),
                                    1e-3,
                                    1e-3);
}
} // namespace

TEST(ElasticTerms, AConstantVelocityBreaksNone)
{
  const pcl6d::test::MovingScanner scanner;
  const std::vector<double> stamps = {0.1, 0.2, 0.35, 0.4};
  const Poses poses = scanner.knots(stamps).poses;
  auto terms = between(stamps);
  const auto within = pcl6d::elasticTermsWithin(stamps, 0, MotionNoise::usual());
  EXPECT_EQ(within.size(), 2u);
  terms.insert(terms.end(), within.begin(), within.end());
  for (const ElasticTerm& term : terms)
    EXPECT_LT(term.residual(poses).norm(), kRounding);
}

TEST(ElasticTerms, AJumpBreaksThemByItsSize)
{
  const std::vector<double> stamps = {0, 1, 1.5, 2.5};
  Poses poses(4, Eigen::Isometry3d::Identity());
  poses[2].translation().x() = poses[3].translation().x() = 0.3; // between the scans
  const auto terms = between(stamps);
  EXPECT_LT(terms[0].residual(poses).norm(), kRounding) << "velocities are alike";
  EXPECT_NEAR(terms[1].residual(poses)[0], 0.3, kRounding);
  poses[3].translation().x() = 0.4;
  EXPECT_NEAR(terms[0].residual(poses)[0], 0.1, kRounding) << "[m/s]";
}

TEST(ElasticTerms, CoefficientsAreTheDerivatives)
{
  const pcl6d::test::MovingScanner scanner;
  const std::vector<double> stamps = {0, 0.1, 0.15, 0.3};
  constexpr double kStep = 1e-6;
  for (const ElasticTerm& term : between(stamps))
    for (std::size_t k = 0; k < 4; ++k) {
      const Poses poses = scanner.knots(stamps).poses;
      Poses moved = poses;
      moved[k].translation().y() += kStep;
      const double slope = (term.residual(moved)[1] - term.residual(poses)[1]) / kStep;
      EXPECT_NEAR(slope, term.coefficients()[k], 1e-6);
    }
}

TEST(ElasticTerms, CountLessWhereTheyAreBroken)
{
  const auto terms = between({0, 0.1, 0.1, 0.2});
  const ElasticTerm& velocity = terms[0];
  Eigen::Matrix<double, 6, 1> residual = Eigen::Matrix<double, 6, 1>::Zero();
  EXPECT_EQ(velocity.weights(residual)[0], velocity.translation_weight);
  residual[0] = 3 / std::sqrt(velocity.translation_weight); // three deviations
  EXPECT_NEAR(velocity.weights(residual)[0] / velocity.translation_weight, 0.5, 1e-9);
  EXPECT_EQ(velocity.weights(residual)[3], velocity.rotation_weight);
  residual[0] = 1e6;
  EXPECT_EQ(velocity.weights(residual)[0], velocity.translation_least);
  EXPECT_GT(velocity.translation_least, 0);
}

TEST(ElasticTerms, LongGapsSayLittle)
{
  const double near = between({0, 0.1, 0.1, 0.2})[1].translation_weight;
  const double far = between({0, 0.1, 5, 5.1})[1].translation_weight;
  EXPECT_GT(near, 1000 * far);
}

TEST(ElasticTerms, RefuseWhatIsNoMotion)
{
  EXPECT_THROW(between({0, 0, 1, 2}), pcl6d::BadArgument);
  EXPECT_THROW(between({0, 1, 2, 2}), pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::elasticTermsWithin({0, 1, 2}, 0, {0, 1}), pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::elasticTermsWithin({0, 1, 2}, 0, {1, -1}), pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::rigidTerm(0, 1, 0), pcl6d::BadArgument);
}
