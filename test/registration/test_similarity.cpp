// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_cases.h"
#include "support/fit_oracles.h"
#include "support/pairs.h"

#include <pcl6d/registration/minimisers.h>

#include <gtest/gtest.h>

using pcl6d::Random;
using pcl6d::Status;
using pcl6d::test::kAngleTol;
using pcl6d::test::kExtent;
using pcl6d::test::kPositionTol;
using pcl6d::test::kRigidHalf;
using pcl6d::test::kRigidPairs;
using pcl6d::test::movedPairs;
using pcl6d::test::Pairs;
using pcl6d::test::randomPoints;
using pcl6d::test::randomPose;
using pcl6d::test::umeyamaOracle;

namespace {
// As in test_minimisers.cpp.
} // namespace

TEST(Similarity, IsThatOfUmeyama)
{
  Random random(12);
  for (const double scale : {0.3048, 1.0, 5.0}) {
    Pairs pairs = movedPairs(randomPoints(random, kRigidPairs, kRigidHalf),
                             randomPose(random, kExtent, 2),
                             random);
    for (auto& m : pairs.target)
      m = scale * m + pcl6d::test::normalVector(random, 0.05);
    Eigen::Matrix3Xd d(3, kRigidPairs), m(3, kRigidPairs);
    for (std::size_t i = 0; i < kRigidPairs; ++i) {
      d.col(i) = pairs.source[i];
      m.col(i) = pairs.target[i];
    }
    const Eigen::Matrix4d expected = pcl6d::test::umeyama(d, m, true);
    const auto sums = pairs.sums();
    const auto found = pcl6d::similarityByQuaternion(sums);
    EXPECT_EQ(found.rigid.status, Status::kOk);
    const double umeyama = std::cbrt(expected.topLeftCorner<3, 3>().determinant());
    EXPECT_NEAR(found.scale, umeyama, 1e-12);
    const auto error = pcl6d::distanceBetween( // dropped: as if it had not been asked
        umeyamaOracle(pairs),
        found.rigid.transform);
    EXPECT_LT(error.translation, kPositionTol);
    EXPECT_LT(error.rotation, kAngleTol);
    const Eigen::Vector3d t = sums.mean_target - found.scale *
                                                     found.rigid.transform.linear() * //
                                                     sums.mean_source;
    EXPECT_LT((t - expected.topRightCorner<3, 1>()).norm(), kPositionTol * scale);
    EXPECT_LT((found.transform.matrix() - expected).norm(), kPositionTol * scale);
  }
}

TEST(Similarity, IsRigidWhereThePairsFixNoScale)
{
  Random random(14);
  Pairs one, same, line;
  one.source = one.target = {{1, 2, 3}};
  same.source.assign(5, Eigen::Vector3d(1, 2, 3));
  same.target = randomPoints(random, 5, kRigidHalf);
  for (int i = 0; i < 5; ++i) {
    line.source.emplace_back(i, 2 * i, 0);
    line.target.emplace_back(2 * i, 4 * i, 0);
  }
  for (const Pairs& pairs :
       {one, same, line, Pairs{same.target, same.source}, Pairs()}) {
    const auto found = pcl6d::similarityByQuaternion(pairs.sums());
    EXPECT_NE(found.rigid.status, Status::kOk);
    EXPECT_EQ(found.scale, 1);
    EXPECT_EQ(found.transform.matrix(), found.rigid.transform.matrix());
  }
}

TEST(RotationByOrthonormal, HoldsForThinSetsThatSquaringWouldLose)
{
  // Singular values 1, 1e-8, 0: in M^T M the second is lost in the rounding of the
  // first. Rounding of S turns about the line by 1e-16 / 1e-8.
  Random random(13);
  for (int trial = 0; trial < 30; ++trial) {
    const Eigen::Matrix3d frame = pcl6d::test::randomRotation(random, 2);
    const Eigen::Matrix3d truth = pcl6d::test::randomRotation(random, 1.5);
    const Eigen::Matrix3d S = frame * Eigen::Vector3d(1, 1e-8, 0).asDiagonal() *
                              frame.transpose() * truth.transpose();
    EXPECT_LT((pcl6d::rotationByOrthonormal(S) - truth).norm(), 1e-6);
    EXPECT_LT((pcl6d::rotationBySVD(S) - truth).norm(), 1e-6);
  }
}
