// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/common/error.h>
#include <pcl6d/verification/pcl/registration_verifier.h>

#include <pcl/point_types.h>

#include <string>

using pcl6d::ComputeFailed;
using pcl6d::LinkTrust;
using pcl6d::PairVerdict;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::RegistrationVerifier;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;

namespace {
using Point = pcl::PointXYZ;
constexpr double kStep = 0.02; // [rad] between rays

template <typename PointT = Point>
typename pcl::PointCloud<PointT>::Ptr
cloudOf(const Points& points, const Eigen::Vector3f& shift = Eigen::Vector3f::Zero())
{
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  for (const auto& p : points) {
    PointT point;
    point.getVector3fMap() = p + shift;
    cloud->push_back(point);
  }
  return cloud;
}

/** Two scans of a room, and the pose of the second seen from the first. */
struct Pair {
  Pair()
  {
    Random random(5);
    const pcl6d::test::PillarRoom room;
    target = room.scan(first, random, kStep);
    source = room.scan(first * truth, random, kStep);
  }

  Eigen::Isometry3d first = pcl6d::planarPose(-1, 0.3, 0.1);
  Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.8, -0.4, 0.05}, {0.02, -0.01, 0.2}); // T_target_source
  Points target, source;
};

const Pair&
pair()
{
  static const Pair scans;
  return scans;
}

RegistrationVerifier<Point>
verifierOf(const Points& source, const Points& target)
{
  RegistrationVerifier<Point> verifier;
  verifier.setInputSource(cloudOf(source));
  verifier.setInputTarget(cloudOf(target));
  return verifier;
}

Eigen::Matrix4f
matrixOf(const Eigen::Isometry3d& pose)
{
  return pose.matrix().cast<float>();
}

std::string
failureOf(RegistrationVerifier<Point>& verifier)
{
  try {
    verifier.verify(Eigen::Matrix4f(Eigen::Matrix4f::Identity()));
  } catch (const ComputeFailed& e) {
    return e.what();
  }
  return "";
}
} // namespace

TEST(RegistrationVerifier, BelievesTheTruePose)
{
  auto verifier = verifierOf(pair().source, pair().target);
  const PairVerdict verdict = verifier.verify(matrixOf(pair().truth));
  EXPECT_EQ(verdict.test_result.trust, LinkTrust::kGood)
      << verdict.test_result.rejection;
  EXPECT_FALSE(verdict.test_result.rejection);
  EXPECT_LT(verdict.test_result.probability_wrong, 0.01);
  EXPECT_GT(verdict.evidence.sight.patches, 30u);
  EXPECT_FALSE(verifier.parameters().voxel.given);
}

TEST(RegistrationVerifier, DoesNotBelieveAPoseThatIsOff)
{
  auto verifier = verifierOf(pair().source, pair().target);
  for (const auto& off : {pcl6d::planarPose(0.5, 0, 0),
                          pcl6d::planarPose(0, -0.3, 0),
                          pcl6d::planarPose(0, 0, 0.1),
                          pcl6d::planarPose(0, 0, M_PI)}) {
    const PairVerdict verdict = verifier.verify(matrixOf(pair().truth * off));
    EXPECT_EQ(verdict.test_result.trust, LinkTrust::kWrong)
        << off.matrix() << '\n'
        << verdict.test_result.rejection;
    EXPECT_TRUE(verdict.test_result.rejection);
  }
}

TEST(RegistrationVerifier, DoesNotBelieveAPoseWithoutOverlap)
{
  auto verifier = verifierOf(pair().source, pair().target);
  const PairVerdict verdict = verifier.verify(matrixOf(pcl6d::planarPose(500, 0, 0)));
  EXPECT_EQ(verdict.test_result.trust, LinkTrust::kWeak);
  EXPECT_EQ(verdict.evidence.sight.patches, 0u);
  EXPECT_TRUE(verdict.test_result.rejection);
}

TEST(RegistrationVerifier, TakesTheSameCloudForNoEvidence)
{
  auto verifier = verifierOf(pair().source, pair().source);
  const PairVerdict verdict =
      verifier.verify(Eigen::Matrix4f(Eigen::Matrix4f::Identity()));
  EXPECT_EQ(verdict.test_result.trust, LinkTrust::kUnverified);
  EXPECT_EQ(verdict.test_result.rejection.reason, pcl6d::RejectReason::kSamePoints);
}

TEST(RegistrationVerifier, TakesThePlaceOfTheScannerFromTheCloud)
{
  const Eigen::Vector3f shift(3, -2, 1);
  auto unmoved = verifierOf(pair().source, pair().target);
  const double expected = static_cast<double>(
      unmoved.verify(matrixOf(pair().truth)).evidence.sight.confirmed);
  const auto source = cloudOf(pair().source, shift);
  RegistrationVerifier<Point> verifier;
  verifier.setInputTarget(cloudOf(pair().target));
  verifier.setInputSource(source);
  const Eigen::Isometry3d T =
      pair().truth * Eigen::Translation3d(-shift.cast<double>());
  const auto differenceNow = [&] {
    const auto sight = verifier.verify(matrixOf(T)).evidence.sight;
    return std::abs(static_cast<double>(sight.confirmed) - expected) / expected;
  };
  constexpr double kRounding = 0.005; // points at the edge of a voxel or a cell
  EXPECT_GT(differenceNow(), 10 * kRounding) << "rays begin at the wrong place";
  verifier.setSourceOrigin(shift);
  EXPECT_LT(differenceNow(), kRounding);
  source->sensor_origin_.head<3>() = shift;
  verifier.setSourceOrigin({});
  EXPECT_LT(differenceNow(), kRounding);
  verifier.setTargetOrigin(shift);
  EXPECT_GT(differenceNow(), 10 * kRounding);
}

TEST(RegistrationVerifier, WorksWithCloudsOfTwoKinds)
{
  RegistrationVerifier<pcl::PointXYZI, pcl::PointNormal> verifier;
  verifier.setInputSource(cloudOf<pcl::PointXYZI>(pair().source));
  verifier.setInputTarget(cloudOf<pcl::PointNormal>(pair().target));
  EXPECT_EQ(verifier.verify(pair().truth.matrix()).test_result.trust, LinkTrust::kGood);
}

TEST(RegistrationVerifier, LeavesOutPointsThatAreNotFinite)
{
  Points source = pair().source;
  for (std::size_t i = 0; i < source.size(); i += 7)
    source[i].setConstant(static_cast<float>(kNan));
  auto verifier = verifierOf(source, pair().target);
  EXPECT_EQ(verifier.verify(matrixOf(pair().truth)).test_result.trust,
            LinkTrust::kGood);
}

TEST(RegistrationVerifier, TakesParametersThatAreGiven)
{
  auto verifier = verifierOf(pair().source, pair().target);
  pcl6d::ScanParameterOptions options;
  options.voxel = 0.25;
  verifier.setParameters(options);
  EXPECT_EQ(verifier.parameters().voxel.value, 0.25);
  EXPECT_EQ(verifier.verify(matrixOf(pair().truth)).evidence.voxel, 0.25);
  options.voxel = 0;
  EXPECT_NE(badArgumentOf([&] { verifier.setParameters(options); }).find("voxel = 0"),
            std::string::npos);
  EXPECT_EQ(verifier.parameters().voxel.value, 0.25) << "stays as it was";
}

TEST(RegistrationVerifier, RefusesWhatIsNoScanOrNoPose)
{
  RegistrationVerifier<Point> verifier;
  const Eigen::Matrix4f identity = Eigen::Matrix4f::Identity();
  EXPECT_NE(badArgumentOf([&] { verifier.setInputSource(nullptr); }), "");
  EXPECT_NE(badArgumentOf([&] { verifier.setInputTarget(nullptr); }), "");
  EXPECT_NE(badArgumentOf([&] { verifier.verify(identity); }).find("input target"),
            std::string::npos);
  verifier.setInputTarget(cloudOf(pair().target));
  EXPECT_NE(badArgumentOf([&] { verifier.verify(identity); }).find("input source"),
            std::string::npos);
  verifier.setInputSource(cloudOf({{1, 2, 3}, {2, 3, 4}}));
  EXPECT_NE(failureOf(verifier).find("input source: 2 points"), std::string::npos);
  verifier.setInputSource(cloudOf({}));
  EXPECT_NE(failureOf(verifier).find("input source: 0 points"), std::string::npos);
  verifier.setInputSource(cloudOf(pair().source));
  for (const Eigen::Matrix4f& bad : {Eigen::Matrix4f(2 * identity),
                                     Eigen::Matrix4f(Eigen::Matrix4f::Zero()),
                                     Eigen::Matrix4f(identity * std::nanf(""))})
    EXPECT_NE(badArgumentOf([&] { verifier.verify(bad); }).find("rigid"),
              std::string::npos);
  verifier.setSourceOrigin(Eigen::Vector3f(std::nanf(""), 0, 0));
  EXPECT_NE(badArgumentOf([&] { verifier.verify(identity); }).find("origin"),
            std::string::npos);
}
