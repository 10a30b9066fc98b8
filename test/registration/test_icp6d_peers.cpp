// SPDX-License-Identifier: BSD-3-Clause
// The registrations of PCL that ICP6D takes the place of, on the same clouds.
#include "icp6d_cases.h"
#include "support/pcl_peers.h"

using namespace pcl6d::test;
using pcl6d::Metric;
using pcl6d::MotionSize;

namespace {
using OrientedPoint = pcl::PointNormal;

/** Registers two samples of a corner of 4 m, with noise of 5 mm and not the same part of
 * it, by a class of PCL and by ours. \return how far they are apart */
template <typename Theirs, typename Ours>
MotionSize
difference(Theirs& theirs, Ours& ours)
{
  using PointT = typename Ours::PointCloudSource::PointType;
  pcl6d::Points source = cornerPoints(7, 3000, 0.005);
  for (auto& p : source)
    p +=
        Eigen::Vector3f(0.3f, 0.3f, 0.3f)
            .cwiseProduct(
                (p.array() > 0.1f).matrix().cast<float>()); // reaches beyond the target
  const auto run = [&](auto& icp) {
    icp.setInputSource(cornerCloud<PointT>(source, kCornerTruth.inverse()));
    icp.setInputTarget(cornerCloud<PointT>(cornerPoints(1, 3000, 0.005)));
    icp.setMaxCorrespondenceDistance(0.2);
    icp.setMaximumIterations(500);
    icp.setTransformationEpsilon(1e-14);
    alignFrom(icp);
    EXPECT_TRUE(icp.hasConverged());
  };
  run(theirs);
  run(ours);
  Eigen::Isometry3d found;
  found.matrix() = theirs.getFinalTransformation().template cast<double>();
  return errorOf(ours, found);
}
} // namespace

// The same pairs give the same minimum. PCL rounds the moved points to float, 2e-7 m, in
// each iteration, so that a few of 3000 pairs may differ: 1 % of them by the spacing of
// points (0.1 m) and in random directions moves the mean by 0.1 m sqrt(30) / 3000.
constexpr double kSamePairs = 2e-4; // [m], [rad]

TEST(Icp6DPeers, IterativeClosestPoint)
{
  pcl::IterativeClosestPoint<OrientedPoint, OrientedPoint, double> theirs;
  pcl6d::ICP6D<OrientedPoint, OrientedPoint, double> ours;
  const MotionSize error = difference(theirs, ours);
  EXPECT_LT(error.translation, kSamePairs);
  EXPECT_LT(error.rotation, kSamePairs);
}

TEST(Icp6DPeers, IterativeClosestPointWithReciprocalPairs)
{
  pcl::IterativeClosestPoint<OrientedPoint, OrientedPoint, double> theirs;
  pcl6d::ICP6D<OrientedPoint, OrientedPoint, double> ours;
  theirs.setUseReciprocalCorrespondences(true);
  ours.setUseReciprocalCorrespondences(true);
  MotionSize error = difference(theirs, ours);
  EXPECT_LT(error.translation, kSamePairs);
  EXPECT_LT(error.rotation, kSamePairs);
  ours.setCorrespondenceEstimation(
      pcl::make_shared<pcl::registration::CorrespondenceEstimation<OrientedPoint,
                                                                   OrientedPoint,
                                                                   double>>());
  error = difference(theirs, ours);
  EXPECT_LT(error.translation, kSamePairs);
  EXPECT_LT(error.rotation, kSamePairs);
}

TEST(Icp6DPeers, IterativeClosestPointWithNormals)
{
  pcl::IterativeClosestPointWithNormals<OrientedPoint, OrientedPoint, double> theirs;
  pcl6d::ICP6D<OrientedPoint, OrientedPoint, double> ours;
  ours.setMetric(Metric::kPlane);
  const MotionSize error = difference(theirs, ours);
  EXPECT_LT(error.translation, kSamePairs);
  EXPECT_LT(error.rotation, kSamePairs);
}

TEST(Icp6DPeers, GeneralizedIterativeClosestPoint)
{
  // PCL stops its inner optimizer at a gradient of 1e-2 and moves by less than 1 mm.
  using Xyz = pcl::PointXYZ;
  pcl::GeneralizedIterativeClosestPoint<Xyz, Xyz> theirs;
  pcl6d::GICP6D<Xyz, Xyz> ours;
  const MotionSize error = difference(theirs, ours);
  EXPECT_LT(error.translation, 1e-3);
  EXPECT_LT(error.rotation, 1e-3);
  EXPECT_LT(errorOf(ours).translation, 1e-3);
  EXPECT_LT(errorOf(ours).rotation, 1e-3);
}
