// SPDX-License-Identifier: BSD-3-Clause
// Generalized-ICP: PCL's class and ours, and covariances that are given.
#include "as_pcl_cases.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

using namespace pcl6d::test;
using pcl6d::Random;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using OurGicp = pcl6d::GICP6D<Point, Point>;
using Pcl = pcl::GeneralizedIterativeClosestPoint<Point, Point>;
using Matrices = OurGicp::MatricesVector;

Cloud::Ptr
noisyModel()
{
  return cornerCloud<Point>(cornerPoints(1, 3000, 0.005));
}

Cloud::Ptr
noisyData()
{
  return cornerCloud<Point>(cornerPoints(2, 3000, 0.005), kCornerTruth.inverse());
}

/** \return the covariances of the walls of a corner \param[in] across over along */
OurGicp::MatricesVectorPtr
wallCovariances(const Eigen::Isometry3d& T, double along, double across)
{
  const auto covariances = pcl::make_shared<Matrices>();
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d n = T.linear().col(2 - i % 3);
    covariances->push_back(along * Eigen::Matrix3d::Identity() +
                           (across - along) * n * n.transpose());
  }
  return covariances;
}

template <typename Icp>
void
setUpNoisyGicp(Icp& icp)
{
  icp.setInputSource(noisyData());
  icp.setInputTarget(noisyModel());
  icp.setMaxCorrespondenceDistance(0.5);
}
} // namespace

template <typename Side>
class GicpAsPcl : public testing::Test {
protected:
  typename Side::template Gicp<Point> icp_;
};
TYPED_TEST_SUITE(GicpAsPcl, BothSides, NameOfSide);

TYPED_TEST(GicpAsPcl, HasPclsDefaults)
{
  EXPECT_EQ(this->icp_.getMaximumIterations(), 200);
  EXPECT_EQ(this->icp_.getMaxCorrespondenceDistance(), 5);
  EXPECT_EQ(this->icp_.getTransformationEpsilon(), 5e-4);
  EXPECT_EQ(this->icp_.getRotationEpsilon(), 2e-3);
  EXPECT_EQ(this->icp_.getCorrespondenceRandomness(), 20);
  EXPECT_EQ(this->icp_.getMaximumOptimizerIterations(), 20);
  EXPECT_EQ(this->icp_.getTranslationGradientTolerance(), 1e-2);
  EXPECT_EQ(this->icp_.getRotationGradientTolerance(), 1e-2);
}

TYPED_TEST(GicpAsPcl, FindsTheCorner)
{
  setUpNoisyGicp(this->icp_);
  alignFrom(this->icp_);
  EXPECT_TRUE(this->icp_.hasConverged());
  EXPECT_LT(errorOf(this->icp_).translation,
            2e-3); // of 5 mm of noise on 1000 points a wall
  EXPECT_LT(errorOf(this->icp_).rotation, 1e-3);
}

TYPED_TEST(GicpAsPcl, UsesTheCovariancesThatAreGiven)
{
  // With the true walls both come closer than with estimated ones; with walls that are turned
  // by a right angle each point is free to leave its wall, and neither finds the corner.
  setUpNoisyGicp(this->icp_);
  this->icp_.setSourceCovariances(wallCovariances(kCornerTruth.inverse(), 1, 1e-3));
  this->icp_.setTargetCovariances(
      wallCovariances(Eigen::Isometry3d::Identity(), 1, 1e-3));
  alignFrom(this->icp_);
  const double right = errorOf(this->icp_).translation;
  EXPECT_LT(right, 2e-3);
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.linear() << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  this->icp_.setSourceCovariances(wallCovariances(turned, 1, 1e-3));
  this->icp_.setTargetCovariances(wallCovariances(turned, 1, 1e-3));
  alignFrom(this->icp_);
  EXPECT_GT(errorOf(this->icp_).translation, 5 * right);
}

TYPED_TEST(GicpAsPcl, ForgetsCovariancesWithTheirCloud)
{
  setUpNoisyGicp(this->icp_);
  this->icp_.setSourceCovariances(
      pcl::make_shared<Matrices>(3, Eigen::Matrix3d::Zero()));
  this->icp_.setTargetCovariances(
      pcl::make_shared<Matrices>(3, Eigen::Matrix3d::Zero()));
  setUpNoisyGicp(this->icp_);
  alignFrom(this->icp_);
  EXPECT_LT(errorOf(this->icp_).translation, 2e-3);
}

TYPED_TEST(GicpAsPcl, DerivesByTheAngles)
{
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  Random random(4);
  const auto rotation = [](const Vector6d& x) {
    return Eigen::Matrix3d(Eigen::AngleAxisd(x[5], Eigen::Vector3d::UnitZ()) *
                           Eigen::AngleAxisd(x[4], Eigen::Vector3d::UnitY()) *
                           Eigen::AngleAxisd(x[3], Eigen::Vector3d::UnitX()));
  };
  for (int trial = 0; trial < 20; ++trial) {
    Vector6d x, g = Vector6d::Zero();
    Eigen::Matrix3d D; // the cost is the sum of the entries of D^T times those of R
    for (int i = 0; i < 6; ++i)
      x[i] = random.uniform(-1.5, 1.5);
    for (int i = 0; i < 9; ++i)
      D(i / 3, i % 3) = random.normal();
    this->icp_.computeRDerivative(x, D, g);
    for (int i = 3; i < 6; ++i) {
      constexpr double kStep = 1e-6;
      Vector6d more = x, less = x;
      more[i] += kStep;
      less[i] -= kStep;
      const double numeric =
          ((rotation(more) - rotation(less)) * D).trace() / (2 * kStep);
      EXPECT_NEAR(g[i], numeric, 1e-8);
    }
    EXPECT_TRUE(g.template head<3>().isZero(0)) << "as it was";
  }
}

TEST(OurGicpCovariances, ThatArePlanesGiveWhatNormalsGive)
{
  pcl6d::GICP6D<pcl::PointNormal, pcl::PointNormal> by_normals, by_covariances;
  for (auto* icp : {&by_normals, &by_covariances}) {
    icp->setInputSource(cornerCloud<pcl::PointNormal>(cornerPoints(2, 3000, 0.005),
                                                      kCornerTruth.inverse()));
    icp->setInputTarget(cornerCloud<pcl::PointNormal>(cornerPoints(1, 3000, 0.005)));
    icp->setMaxCorrespondenceDistance(0.5);
  }
  by_covariances.setSourceCovariances(wallCovariances(kCornerTruth.inverse(), 1, 1e-3));
  by_covariances.setTargetCovariances(
      wallCovariances(Eigen::Isometry3d::Identity(), 1, 1e-3));
  alignFrom(by_normals);
  alignFrom(by_covariances);
  EXPECT_LT(
      (by_normals.getFinalTransformation() - by_covariances.getFinalTransformation())
          .norm(),
      1e-6);
  EXPECT_EQ(by_normals.result().iterations, by_covariances.result().iterations);
}

TEST(OurGicpCovariances, ThatAreBallsGivePointsToPoints)
{
  OurGicp balls;
  setUpNoisyGicp(balls);
  balls.setMotionEpsilon(1e-6, 1e-6);
  for (const double variance : {1.0, 1e-4}) {
    balls.setSourceCovariances(
        pcl::make_shared<Matrices>(3000, variance * Eigen::Matrix3d::Identity()));
    balls.setTargetCovariances(
        pcl::make_shared<Matrices>(3000, 3 * variance * Eigen::Matrix3d::Identity()));
    alignFrom(balls);
    pcl6d::ICP6D<Point, Point> points;
    setUpNoisyGicp(points);
    points.setMaximumIterations(200);
    points.setMotionEpsilon(1e-6, 1e-6);
    alignFrom(points);
    EXPECT_LT(pcl6d::distanceBetween(points.result().T_target_source,
                                     balls.result().T_target_source)
                  .translation,
              1e-4);
  }
}

TEST(OurGicpCovariances, InMetresGiveWhatPclGives)
{
  // Neither planes nor balls, as a sensor model makes them: 2 cm along, 5 mm across.
  const auto of_source = wallCovariances(kCornerTruth.inverse(), 4e-4, 2.5e-5);
  const auto of_target = wallCovariances(Eigen::Isometry3d::Identity(), 4e-4, 2.5e-5);
  OurGicp ours;
  Pcl pcls;
  const auto run = [&](auto& icp) {
    setUpNoisyGicp(icp);
    icp.setSourceCovariances(of_source);
    icp.setTargetCovariances(of_target);
    icp.setTransformationEpsilon(1e-6);
    icp.setRotationEpsilon(1e-6);
    icp.setRotationGradientTolerance(1e-6);
    icp.setTranslationGradientTolerance(1e-6);
    alignFrom(icp);
    return errorOf(icp).translation;
  };
  const double error = run(ours), of_pcl = run(pcls);
  EXPECT_TRUE(ours.hasConverged());
  EXPECT_LT(error, 1.05 * of_pcl + 1e-4);
  EXPECT_LT(error, 2e-3);
}

TEST(OurGicpCovariances, OfOneSideStandBesideEstimatedOnes)
{
  for (const bool source : {true, false}) {
    OurGicp icp;
    setUpNoisyGicp(icp);
    if (source)
      icp.setSourceCovariances(wallCovariances(kCornerTruth.inverse(), 1, 0.01));
    else
      icp.setTargetCovariances(wallCovariances(Eigen::Isometry3d::Identity(), 1, 0.01));
    alignFrom(icp);
    EXPECT_TRUE(icp.hasConverged());
    EXPECT_LT(errorOf(icp).translation, 2e-3);
  }
}

TEST(OurGicpCovariances, BelongToTheIndexAndNotToThePlaceInTheList)
{
  const auto chosen = pcl::make_shared<pcl::Indices>();
  for (int i = 1; i < 3000; i += 2)
    chosen->push_back(i);
  OurGicp icp;
  setUpNoisyGicp(icp);
  icp.setIndices(chosen);
  auto covariances = wallCovariances(kCornerTruth.inverse(), 1, 1e-3);
  (*covariances)[0].setZero(); // of a point that is not chosen
  icp.setSourceCovariances(covariances);
  icp.setTargetCovariances(wallCovariances(Eigen::Isometry3d::Identity(), 1, 1e-3));
  alignFrom(icp);
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_LT(errorOf(icp).translation, 1e-3);
}

TEST(OurGicpCovariances, GiveTheSameBitsForAnyNumberOfThreads)
{
  Eigen::Matrix4f first = Eigen::Matrix4f::Zero();
  for (const unsigned int threads : {1u, 2u, 3u}) {
    OurGicp icp;
    icp.setNumberOfThreads(threads);
    setUpNoisyGicp(icp);
    icp.setSourceCovariances(wallCovariances(kCornerTruth.inverse(), 1, 0.02));
    icp.setTargetCovariances(wallCovariances(Eigen::Isometry3d::Identity(), 2, 0.02));
    alignFrom(icp);
    const Eigen::Matrix4f found = icp.getFinalTransformation();
    if (threads == 1)
      first = found;
    EXPECT_TRUE(sameBits(found, first));
  }
}

TEST(OurGicpCovariances, SayWhatIsWrong)
{
  const auto words = [](auto change) {
    OurGicp icp;
    setUpNoisyGicp(icp);
    const auto covariances = wallCovariances(kCornerTruth.inverse(), 1, 0.01);
    change(icp, *covariances);
    icp.setSourceCovariances(covariances);
    return badArgumentOf([&] { alignFrom(icp); });
  };
  EXPECT_EQ(words([](OurGicp&, Matrices&) {}), "");
  EXPECT_NE(words([](OurGicp&, Matrices& c) { c.pop_back(); }).find("2999"),
            std::string::npos);
  EXPECT_NE(words([](OurGicp&, Matrices& c) { c[7](0, 1) += 1; }).find("covariance 7"),
            std::string::npos);
  EXPECT_NE(words([](OurGicp&, Matrices& c) { c[8].setZero(); }).find("covariance 8"),
            std::string::npos);
  EXPECT_NE(words([](OurGicp&, Matrices& c) { c[9] = -c[9]; }).find("covariance 9"),
            std::string::npos);
  EXPECT_NE(
      words([](OurGicp&, Matrices& c) { c[2](0, 0) = kNan; }).find("covariance 2"),
      std::string::npos);
  EXPECT_NE(words([](OurGicp& icp, Matrices&) {
              icp.setRobustKernel(pcl6d::RobustKernel::kHuber);
            }).find("robust"),
            std::string::npos);
  EXPECT_NE(words([](OurGicp& icp, Matrices&) {
              icp.setMetric(pcl6d::Metric::kPoint);
            }).find("metric"),
            std::string::npos);
}

TEST(OurGicpCovariances, MakeTheMahalanobisDistance)
{
  OurGicp icp;
  EXPECT_FALSE(badArgumentOf([&] { icp.mahalanobis(0); }).empty()) << "not yet";
  setUpNoisyGicp(icp);
  const auto source = wallCovariances(kCornerTruth.inverse(), 1, 1e-3);
  const auto target = wallCovariances(Eigen::Isometry3d::Identity(), 1, 1e-3);
  for (const bool given : {false, true}) {
    if (given) {
      icp.setSourceCovariances(source);
      icp.setTargetCovariances(target);
    }
    alignFrom(icp);
    const Eigen::Matrix3d R = icp.result().T_target_source.linear();
    std::size_t like = 0, across = 0;
    for (std::size_t i = 0; i < 3000; ++i) {
      const Eigen::Matrix3d M = icp.mahalanobis(i);
      const Eigen::Matrix3d sum = R * (*source)[i] * R.transpose() + (*target)[i];
      like += (M * sum - Eigen::Matrix3d::Identity()).norm() < 0.5 ? 1 : 0;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(M);
      across +=
          std::abs(eigen.eigenvectors()(2 - static_cast<int>(i % 3), 2)) > 0.95 ? 1 : 0;
    }
    EXPECT_GT(across, 2700u) << "the wall; points near an edge may have another";
    if (given) {
      EXPECT_GT(like, 2700u);
    }
    EXPECT_FALSE(badArgumentOf([&] { icp.mahalanobis(3000); }).empty());
  }
  icp.setMaxCorrespondenceDistance(1e-7);
  alignFrom(icp);
  EXPECT_TRUE(icp.mahalanobis(5).isIdentity()) << "without a partner, as in PCL";
}

TEST(OurGicp, HasNoInnerOptimizerToCall)
{
  OurGicp icp;
  Eigen::Matrix4f T = Eigen::Matrix4f::Identity();
  EXPECT_NE(badArgumentOf([&] {
              icp.estimateRigidTransformationBFGS({}, {}, {}, {}, T);
            }).find("align()"),
            std::string::npos);
}
