// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_map/small_map.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/semantic_map/object_fusion.h>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>

using namespace pcl6d;

namespace {
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kPosition = 0.02; // [m] standard deviations of an observation
constexpr double kAngle = 0.02;    // [rad]

Matrix6
noiseCovariance()
{
  Vector6 variances;
  variances << kPosition * kPosition, 4 * kPosition * kPosition, kPosition * kPosition,
      kAngle * kAngle, kAngle * kAngle, 4 * kAngle * kAngle;
  return variances.asDiagonal();
}

MapObject
chair(double x = 1, double y = 2, double heading = 0.4)
{
  return test::object("chair", {x, y, 0}, {0.45, 0.45, 0.95}, heading);
}

/** \brief The pose as x y z roll pitch yaw. */
Vector6
eulerOf(const Eigen::Isometry3d& pose)
{
  const EulerAngles angles = eulerFromRotation(pose.linear());
  Vector6 v;
  v << pose.translation(), angles.roll, angles.pitch, angles.yaw;
  return v;
}

/** An observation with noise of noiseCovariance() in x y z roll pitch yaw. */
MapObject
observed(const MapObject& truth, std::size_t scan, Random& random)
{
  const Vector6 sigma = noiseCovariance().diagonal().cwiseSqrt();
  Vector6 v = eulerOf(truth.pose.T_world_object);
  for (int k = 0; k < 6; ++k)
    v(k) += sigma(k) * random.normal();
  MapObject result = truth;
  result.pose.T_world_object = poseFromEuler(v.head<3>(), {v(3), v(4), v(5)});
  result.covariance = noiseCovariance();
  result.scans = {scan};
  return result;
}

double
distance(const MapObject& a, const MapObject& b)
{
  return distanceBetween(a.pose.T_world_object, b.pose.T_world_object).translation;
}
} // namespace

TEST(ObjectFusion, CovarianceFallsWithTheNumberOfObservationsAndFitsTheError)
{
  constexpr int kTrials = 200;
  Random random(1);
  std::size_t outliers = 0;
  for (const std::size_t count : {1u, 4u, 16u}) {
    double chi2 = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      MapObject truth = chair();
      truth.pose.T_world_object = poseFromEuler({1, 2, 0.5}, {0.3, -0.4, 2.0});
      std::vector<MapObject> observations;
      for (std::size_t i = 0; i < count; ++i)
        observations.push_back(observed(truth, i, random));
      const auto fused = fuseObjects(observations);
      ASSERT_EQ(fused.size(), 1u);
      const MapObject& object = fused[0].object;
      ASSERT_TRUE(object.covariance);
      outliers += fused[0].outliers.size();
      // 1 / n; the least error of an observation adds 1 %
      const double counted = static_cast<double>(count - fused[0].outliers.size());
      for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(
            (*object.covariance)(k, k) * counted / noiseCovariance()(k, k), 1, 0.1);
      const Vector6 error =
          eulerOf(object.pose.T_world_object) - eulerOf(truth.pose.T_world_object);
      chi2 += error.dot(object.covariance->llt().solve(error));
    }
    // mean 6, its standard deviation sqrt(12 / 200) = 0.24; linearisation adds a little
    EXPECT_NEAR(chi2 / kTrials, 6, 1.2) << count;
  }
  EXPECT_LE(outliers, 12u) << "4.2 of 4200 are expected beyond 99.9 %";
}

TEST(ObjectFusion, WeighsByInformation)
{
  MapObject sharp = chair(1, 2), vague = chair(1.1, 2);
  sharp.covariance = noiseCovariance();
  vague.covariance = 9 * noiseCovariance();
  sharp.scans = {0};
  vague.scans = {1};
  const auto fused = fuseObjects({sharp, vague});
  ASSERT_EQ(fused.size(), 1u);
  EXPECT_NEAR(fused[0].object.pose.T_world_object.translation().x(), 1.01, 2e-4);
  EXPECT_EQ(fused[0].object.scans, (std::vector<std::size_t>{0, 1}));
}

TEST(ObjectFusion, ResultsDoNotDependOnTheOrder)
{
  Random random(3);
  std::vector<MapObject> observations;
  for (std::size_t i = 0; i < 6; ++i)
    observations.push_back(observed(chair(), i, random));
  const auto forward = fuseObjects(observations);
  std::reverse(observations.begin(), observations.end());
  const auto backward = fuseObjects(observations);
  ASSERT_EQ(forward.size(), 1u);
  ASSERT_EQ(backward.size(), 1u);
  EXPECT_LT(distance(forward[0].object, backward[0].object), 1e-12);
}

TEST(ObjectFusion, LeavesOutliersOut)
{
  Random random(2);
  const MapObject truth = chair();
  std::vector<MapObject> observations;
  for (std::size_t i = 0; i < 5; ++i)
    observations.push_back(observed(truth, i, random));
  MapObject wrong = chair(1.15, 2.1, 0.4 + M_PI); // the other way round
  wrong.covariance = noiseCovariance() / 16;      // and very sure
  wrong.scans = {7};
  observations.insert(observations.begin(), wrong);
  const auto fused = fuseObjects(observations);
  ASSERT_EQ(fused.size(), 1u);
  EXPECT_EQ(fused[0].outliers, std::vector<std::size_t>{0});
  EXPECT_EQ(fused[0].observations.size(), 6u);
  EXPECT_EQ(fused[0].object.scans.size(), 6u);
  const auto error =
      distanceBetween(fused[0].object.pose.T_world_object, truth.pose.T_world_object);
  EXPECT_LT(error.translation, 4 * 2 * kPosition / std::sqrt(5.0));
  EXPECT_LT(error.rotation, 4 * 2 * kAngle / std::sqrt(5.0));
}

TEST(ObjectFusion, KeepsTwoChairsSideBySideApart)
{
  Random random(4);
  std::vector<MapObject> observations;
  for (std::size_t scan = 0; scan < 5; ++scan)
    for (const double x : {1.0, 1.5}) // 5 cm of air between them
      observations.push_back(observed(chair(x, 2, 0), scan, random));
  const auto fused = fuseObjects(observations);
  ASSERT_EQ(fused.size(), 2u);
  EXPECT_EQ(fused[0].observations, (std::vector<std::size_t>{0, 2, 4, 6, 8}));
  EXPECT_EQ(fused[1].observations, (std::vector<std::size_t>{1, 3, 5, 7, 9}));
}

TEST(ObjectFusion, NeverJoinsObservationsOfOneScanOrOfTwoClasses)
{
  MapObject a = chair(), b = chair(1.05, 2);
  a.scans = b.scans = {3};
  EXPECT_EQ(fuseObjects({a, b}).size(), 2u);
  b.scans = {4};
  EXPECT_EQ(fuseObjects({a, b}).size(), 1u);
  b.pose.object_class = "table";
  EXPECT_EQ(fuseObjects({a, b}).size(), 2u);
}

TEST(ObjectFusion, TurnsObjectsWithASymmetryToOneHeading)
{
  std::vector<MapObject> observations;
  for (std::size_t i = 0; i < 4; ++i) { // a square table, seen from four sides
    MapObject table = test::object("table", {0, 0, 0}, {0.9, 0.9, 0.7});
    table.symmetry = 4;
    table.pose.T_world_object = planarPose(
        0, 0, 0.2 + static_cast<double>(i) * M_PI / 2 + (i % 2 == 0 ? 0.01 : -0.01));
    table.scans = {i};
    observations.push_back(table);
  }
  auto fused = fuseObjects(observations);
  ASSERT_EQ(fused.size(), 1u);
  EXPECT_TRUE(fused[0].outliers.empty());
  const double heading =
      eulerFromRotation(fused[0].object.pose.T_world_object.linear()).yaw;
  EXPECT_NEAR(std::remainder(heading - 0.2, M_PI / 2), 0, 1e-9);

  for (std::size_t i = 0; i < 4; ++i) { // a round one: any heading
    observations[i].symmetry = 0;
    observations[i].pose.T_world_object =
        planarPose(i < 2 ? 0.02 : -0.02, 0, 1.3 * static_cast<double>(i));
  }
  fused = fuseObjects(observations);
  ASSERT_EQ(fused.size(), 1u);
  EXPECT_TRUE(fused[0].outliers.empty());
  EXPECT_NEAR(fused[0].object.pose.T_world_object.translation().norm(), 0, 1e-12);
  EXPECT_GT((*fused[0].object.covariance)(5, 5), 3) << "the heading is not known";
  EXPECT_LT((*fused[0].object.covariance)(3, 3), 0.01);
}

TEST(ObjectFusion, KeepsASingleObservationAsItIs)
{
  MapObject single = chair();
  single.scans = {2};
  const auto fused = fuseObjects({single});
  ASSERT_EQ(fused.size(), 1u);
  EXPECT_FALSE(fused[0].object.covariance);
  EXPECT_EQ(fused[0].object.pose.T_world_object.matrix(),
            single.pose.T_world_object.matrix());
  EXPECT_TRUE(fuseObjects({}).empty());
}

TEST(ObjectFusion, RefusesWhatIsNoObservation)
{
  MapObject wrong = chair();
  wrong.pose.object_class = "";
  EXPECT_THROW(fuseObjects({wrong}), BadArgument);
  wrong = chair();
  wrong.pose.T_world_object.linear() *= 2;
  EXPECT_THROW(fuseObjects({wrong}), BadArgument);
  wrong = chair();
  wrong.covariance = -noiseCovariance();
  EXPECT_THROW(fuseObjects({wrong}), BadArgument);
  wrong = chair();
  wrong.symmetry = -1;
  EXPECT_THROW(fuseObjects({wrong}), BadArgument);
  FusionOptions options;
  options.min_overlap = 0;
  EXPECT_THROW(fuseObjects({chair()}, options), BadArgument);
  options = {};
  options.gate = -1;
  EXPECT_THROW(fuseObjects({chair()}, options), BadArgument);
}
