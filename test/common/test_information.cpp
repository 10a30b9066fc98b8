// SPDX-License-Identifier: BSD-3-Clause
#include "support/fit_oracles.h"

#include <pcl6d/common/information.h>

#include <gtest/gtest.h>

#include <cmath>

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using pcl6d::informationFault;
using pcl6d::semidefinite;

namespace {
/** Eigenvalues 1 + x, 1 - x and four of 1. */
Matrix6
coupled(double x)
{
  Matrix6 information = Matrix6::Identity();
  information(0, 1) = information(1, 0) = x;
  return information;
}

double
leastEigenvalue(const Matrix6& information)
{
  return pcl6d::test::smallestEigenvalue(information);
}
} // namespace

TEST(Information, MayBeSemidefiniteOfAnySize)
{
  for (const double size : {1e-150, 1.0, 1e200})
    for (const double x : {0.0, 0.9, 1.0})
      EXPECT_EQ(informationFault(size * coupled(x)), "") << size << ' ' << x;
  EXPECT_EQ(informationFault(Matrix6::Zero()), "");
}

TEST(Information, HasTheFaultThatItIsToldOf)
{
  EXPECT_EQ(informationFault(coupled(5)), "not positive semidefinite");
  EXPECT_EQ(informationFault(coupled(1 + 1e-5)), "not positive semidefinite");
  EXPECT_EQ(informationFault(-Matrix6::Identity()), "not positive semidefinite");
  EXPECT_EQ(informationFault(coupled(std::nan(""))), "not finite");
  Matrix6 information = coupled(0.5);
  information(0, 1) += 1e-8;
  EXPECT_EQ(informationFault(information), "not symmetric");
}

TEST(Information, LosesWhatTheTolerancesLetPass)
{
  const Matrix6 negative = coupled(1 + 1e-7);
  EXPECT_EQ(informationFault(negative), "");
  EXPECT_LT(leastEigenvalue(negative), -5e-8);
  EXPECT_GT(leastEigenvalue(semidefinite(negative)), -1e-15);
  EXPECT_LT((semidefinite(negative) - negative).norm(), 2e-7);
  Matrix6 asymmetric = coupled(0.5);
  asymmetric(0, 1) += 1e-10;
  EXPECT_EQ(informationFault(asymmetric), "");
  EXPECT_EQ(semidefinite(asymmetric), semidefinite(asymmetric).transpose());
  for (const double x : {0.3, 0.5})
    EXPECT_EQ(semidefinite(coupled(x)), coupled(x)) << "nothing to repair";
}
