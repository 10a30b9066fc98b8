// SPDX-License-Identifier: BSD-3-Clause
// Normals, weights and reciprocal pairs.
#include "icp6d_cases.h"

using namespace pcl6d::test;
using pcl6d::Metric;
using pcl6d::RobustKernel;
using pcl6d::Status;
using pcl6d::transformed;

namespace {
using OrientedPoint = pcl::PointNormal;
using OrientedDoubleIcp = pcl6d::ICP6D<OrientedPoint, OrientedPoint, double>;

/** \return the corner against another sample of it */
void
setUpSamples(OrientedDoubleIcp& icp)
{
  icp.setInputSource(
      cornerCloud<OrientedPoint>(cornerPoints(7), kCornerTruth.inverse()));
  icp.setInputTarget(cornerModel<OrientedPoint>());
  icp.setMaxCorrespondenceDistance(0.5);
}

void
setNormals(pcl::PointCloud<OrientedPoint>& cloud, const Eigen::Vector3f& normal)
{
  for (auto& p : cloud)
    p.getNormalVector3fMap() = normal;
}

/** \return what the corner gives with its clouds changed */
template <typename Change>
Eigen::Matrix4d
found(Metric metric, Change change)
{
  const auto source =
      cornerCloud<OrientedPoint>(cornerPoints(7), kCornerTruth.inverse());
  const auto target = cornerModel<OrientedPoint>();
  change(*source, *target);
  OrientedDoubleIcp icp;
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaxCorrespondenceDistance(0.5);
  icp.setMetric(metric);
  alignFrom(icp);
  EXPECT_TRUE(icp.hasConverged());
  return icp.getFinalTransformation();
}
} // namespace

TEST(Icp6DMetrics, PlanesHoldBetterThanPointsAcrossSamples)
{
  OrientedDoubleIcp icp;
  setUpSamples(icp);
  double by_points = 0;
  for (const Metric metric : kMetrics) {
    icp.setMetric(metric);
    alignFrom(icp);
    EXPECT_TRUE(icp.hasConverged()) << toString(metric);
    if (metric == Metric::kPoint)
      by_points = errorOf(icp).translation;
    else // points near an edge find the other wall
      EXPECT_LT(errorOf(icp).translation, 0.25 * by_points) << toString(metric);
  }
}

TEST(Icp6DMetrics, GicpIsTheMetricOfGicp6D)
{
  OrientedDoubleIcp icp;
  pcl6d::GICP6D<OrientedPoint, OrientedPoint, double> gicp;
  setUpSamples(icp);
  setUpSamples(gicp);
  icp.setMetric(Metric::kGicp);
  icp.setMotionEpsilon(gicp.getTransformationEpsilon(), gicp.getRotationEpsilon());
  icp.setMaximumIterations(gicp.getMaximumIterations());
  alignFrom(icp);
  alignFrom(gicp);
  EXPECT_TRUE(sameBits(Eigen::Matrix4d(gicp.getFinalTransformation()),
                       Eigen::Matrix4d(icp.getFinalTransformation())));
  EXPECT_TRUE(gicp.hasConverged());
}

TEST(Icp6DMetrics, NormalsThatAreGivenAreUsed)
{
  // Wrong ones leave a motion open: all walls look along x.
  for (const Metric metric : {Metric::kPlane, Metric::kGicp}) {
    OrientedDoubleIcp icp;
    setUpSamples(icp);
    const auto target = cornerModel<OrientedPoint>();
    setNormals(*target, Eigen::Vector3f::UnitX());
    icp.setInputTarget(target);
    icp.setMetric(metric);
    alignFrom(icp);
    EXPECT_EQ(icp.result().status, Status::kRankDeficient) << toString(metric);
  }
}

TEST(Icp6DMetrics, NormalsThatAreAllZeroOrNanAreEstimated)
{
  for (const Metric metric : {Metric::kPlane, Metric::kGicp}) {
    const auto given = found(metric, [](auto&, auto&) {});
    const auto zero = found(metric, [](auto& source, auto& target) {
      setNormals(source, Eigen::Vector3f::Zero());
      setNormals(target, Eigen::Vector3f::Zero());
    });
    const auto nan = found(metric, [](auto& source, auto& target) {
      setNormals(source, Eigen::Vector3f::Constant(kNan));
      setNormals(target, Eigen::Vector3f::Constant(kNan));
    });
    EXPECT_TRUE(sameBits(zero, nan)) << toString(metric);
    EXPECT_FALSE(sameBits(zero, given)) << toString(metric);
    EXPECT_LT((zero - given).norm(), 4e-3) << toString(metric);
  }
}

TEST(Icp6DMetrics, PointsWithoutNormalsAreSkippedAmongOthersThatHaveThem)
{
  for (const float none : {0.0f, kNan})
    for (const Metric metric : {Metric::kPlane, Metric::kGicp}) {
      const auto given = found(metric, [](auto&, auto&) {});
      const auto some = found(metric, [none](auto& source, auto& target) {
        for (std::size_t i = 0; i < target.size(); i += 10) {
          target[i].getNormalVector3fMap().setConstant(none);
          source[i].getNormalVector3fMap().setConstant(none);
        }
      });
      EXPECT_LT((some - given).norm(), 1e-3) << toString(metric) << none;
    }
}

TEST(Icp6DMetrics, NormalsOfTheSourceCountForGicpOnly)
{
  for (const Metric metric : kMetrics) {
    const auto given = found(metric, [](auto&, auto&) {});
    const auto turned = found(metric, [](auto& source, auto&) {
      setNormals(source, Eigen::Vector3f(1, 1, 1).normalized());
    });
    EXPECT_EQ(sameBits(given, turned), metric != Metric::kGicp) << toString(metric);
  }
}

TEST(Icp6DMetrics, TypesWithoutNormalsGetThem)
{
  using Xyz = pcl::PointXYZ;
  pcl6d::ICP6D<Xyz, Xyz, double> icp;
  OrientedDoubleIcp with_zeros;
  icp.setInputSource(cornerCloud<Xyz>(cornerPoints(7), kCornerTruth.inverse()));
  icp.setInputTarget(cornerModel<Xyz>());
  with_zeros.setInputSource(
      toCloud<OrientedPoint>(transformed(cornerPoints(7), kCornerTruth.inverse())));
  with_zeros.setInputTarget(toCloud<OrientedPoint>(cornerPoints()));
  for (const Metric metric : kMetrics) {
    icp.setMetric(metric);
    with_zeros.setMetric(metric);
    for (const std::size_t neighbours : {8u, 20u}) {
      icp.setNormalNeighbours(neighbours);
      with_zeros.setNormalNeighbours(neighbours);
      alignFrom(icp);
      alignFrom(with_zeros);
      EXPECT_TRUE(sameBits(Eigen::Matrix4d(icp.getFinalTransformation()),
                           Eigen::Matrix4d(with_zeros.getFinalTransformation())))
          << toString(metric);
    }
  }
}

TEST(Icp6DMetrics, WeightsHoldAgainstOutliers)
{
  for (const Metric metric : kMetrics) {
    SCOPED_TRACE(toString(metric));
    OrientedDoubleIcp icp;
    icp.setInputSource(outlierData<OrientedPoint>());
    icp.setInputTarget(cornerModel<OrientedPoint>());
    icp.setMaxCorrespondenceDistance(0.5);
    icp.setMotionEpsilon(1e-7, 1e-7);
    icp.setMetric(metric);
    alignFrom(icp);
    const double plain = errorOf(icp).translation;
    EXPECT_GT(plain, 50 * kExactTol);
    icp.setKeptShare(0.85);
    expectCorner(icp);
    // All pairs as far apart as the last one that is kept are kept, too.
    EXPECT_NEAR(static_cast<double>(icp.result().pairs), 0.85 * 1998, 15);
    icp.setKeptShare(1);
    for (const auto kernel :
         {RobustKernel::kHuber, RobustKernel::kCauchy, RobustKernel::kGemanMcClure}) {
      icp.setRobustKernel(kernel);
      alignFrom(icp);
      EXPECT_LT(errorOf(icp).translation, 0.5 * plain) << toString(kernel);
    }
  }
}

TEST(Icp6DMetrics, ReciprocalPairsAreEachOthersClosest)
{
  for (const Metric metric : kMetrics) {
    OrientedDoubleIcp icp;
    setUpSamples(icp);
    icp.setMetric(metric);
    icp.setUseReciprocalCorrespondences(true);
    alignFrom(icp);
    if (metric != Metric::kPlane) { // which swings between two sets of pairs
      EXPECT_TRUE(icp.hasConverged()) << toString(metric);
    }
    // By the definition, at the final pose.
    const pcl6d::Points target = cornerPoints();
    const pcl6d::Points moved =
        transformed(transformed(cornerPoints(7), kCornerTruth.inverse()),
                    icp.result().T_target_source);
    const auto nearest = [](const Eigen::Vector3f& p, const pcl6d::Points& among) {
      std::size_t best = 0;
      for (std::size_t i = 1; i < among.size(); ++i)
        if ((among[i] - p).squaredNorm() < (among[best] - p).squaredNorm())
          best = i;
      return best;
    };
    std::size_t mutual = 0;
    for (std::size_t i = 0; i < moved.size(); ++i)
      mutual += nearest(target[nearest(moved[i], target)], moved) == i;
    EXPECT_EQ(icp.result().pairs, mutual) << toString(metric);
    EXPECT_LT(mutual, 1700u);
  }
}

TEST(Icp6DMetrics, TheSymmetricObjectiveIsThatOfIcpWithNormals)
{
  pcl6d::ICP6DWithNormals<OrientedPoint, OrientedPoint, double> plain, symmetric;
  setUpSamples(plain);
  setUpSamples(symmetric);
  symmetric.setUseSymmetricObjective(true);
  EXPECT_TRUE(symmetric.getUseSymmetricObjective());
  EXPECT_TRUE(symmetric.getEnforceSameDirectionNormals());
  alignFrom(plain);
  alignFrom(symmetric);
  EXPECT_TRUE(plain.hasConverged());
  EXPECT_TRUE(symmetric.hasConverged());
  EXPECT_LE(symmetric.result().iterations, plain.result().iterations);
  EXPECT_LT(errorOf(symmetric).translation, 2 * errorOf(plain).translation + 1e-4);
  OrientedDoubleIcp by_metric;
  setUpSamples(by_metric);
  by_metric.setMetric(Metric::kPlane);
  alignFrom(by_metric);
  EXPECT_TRUE(sameBits(Eigen::Matrix4d(plain.getFinalTransformation()),
                       Eigen::Matrix4d(by_metric.getFinalTransformation())));
}

TEST(Icp6DMetrics, NormalsOfRingsGrowAcrossThem)
{
  constexpr double kDegree = 3.14159265358979 / 180, kNoise = 0.01; // [m]
  const Eigen::Array3d low(-6, -5, -1), high(5, 7, 3);              // [m] walls
  const auto rings = [&](const Eigen::Isometry3d& T_world_scan, int seed) {
    pcl6d::Random random(seed);
    pcl6d::Points points;
    for (int ring = 0; ring < 16; ++ring)
      for (int step = 0; step < 900; ++step) {
        const double elevation = (2 * ring - 15) * kDegree,
                     azimuth = 0.4 * step * kDegree;
        const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth),
                                  std::sin(elevation));
        const Eigen::Array3d in_world = (T_world_scan.linear() * ray).array();
        const Eigen::Array3d wall = (in_world > 0).select(high, low);
        const double range =
            ((wall - T_world_scan.translation().array()) / in_world).minCoeff();
        points.push_back(((range + kNoise * random.normal()) * ray).cast<float>());
      }
    return points;
  };
  const Eigen::Isometry3d truth = pcl6d::poseFromEuler({0.3, -0.2, 0.1}, {0, 0, 0.05});
  const auto error = [&](Metric metric, pcl6d::LineGrowth growth) {
    pcl6d::ICP6D<pcl::PointXYZ, pcl::PointXYZ, double> icp;
    icp.setMetric(metric);
    icp.setNormalNeighbours(10);
    icp.setLineGrowth(growth);
    icp.setMaxCorrespondenceDistance(1);
    icp.setInputTarget(toCloud<pcl::PointXYZ>(rings(Eigen::Isometry3d::Identity(), 1)));
    icp.setInputSource(toCloud<pcl::PointXYZ>(rings(truth, 2)));
    pcl::PointCloud<pcl::PointXYZ> aligned;
    icp.align(aligned);
    return pcl6d::distanceBetween(icp.result().T_target_source, truth).translation;
  };
  using pcl6d::LineGrowth;
  EXPECT_EQ((pcl6d::ICP6D<pcl::PointXYZ, pcl::PointXYZ>().getLineGrowth()),
            LineGrowth::kAuto);
  for (const Metric metric : {Metric::kPlane, Metric::kGicp}) {
    SCOPED_TRACE(toString(metric));
    const double nearest = error(metric, LineGrowth::kNever);
    const double grown = error(metric, LineGrowth::kAuto);
    EXPECT_LT(grown, 0.01);
    EXPECT_LT(grown, nearest / 2) << "errors [m] " << nearest << ' ' << grown;
  }
}
