// SPDX-License-Identifier: BSD-3-Clause
// PCL's estimations of correspondences and transformations, plugged into ICP6D.
#include "icp6d_cases.h"
#include "support/pcl_estimation_peers.h"
#include "support/pcl_peers.h"

#include <pcl6d/registration/pcl/transformation_estimation_plane_helix.h>
#include <pcl6d/registration/pcl/transformation_estimation_svd.h>

#include <pcl/registration/transformation_estimation_3point.h>

namespace reg = pcl::registration;
using namespace pcl6d::test;
using pcl6d::Metric;
using pcl6d::Status;

namespace {
using OrientedPoint = pcl::PointNormal;
using OrientedDoubleIcp = pcl6d::ICP6D<OrientedPoint, OrientedPoint, double>;
} // namespace

using Estimation = NamedPart<OrientedDoubleIcp::Base::CorrespondenceEstimationPtr>;

class Icp6DCorrespondences : public testing::TestWithParam<Estimation> {};

TEST_P(Icp6DCorrespondences, ComeFromPcl)
{
  OrientedDoubleIcp icp;
  setUpCorner(icp);
  icp.setCorrespondenceEstimation(GetParam().make());
  for (const Metric metric : kMetrics) {
    SCOPED_TRACE(toString(metric));
    icp.setMetric(metric);
    expectCorner(icp);
    EXPECT_EQ(icp.result().overlap, 1);
    expectCorner(icp); // again
  }
}

TEST_P(Icp6DCorrespondences, LeaveOutNan)
{
  // With a tree of ours and with FLANN, which must not be asked for NaN.
  for (const bool flann : {false, true}) {
    auto source = cornerData<OrientedPoint>();
    for (const std::size_t i : {0u, 7u, 1997u}) {
      (*source)[i].y = i == 7 ? kInfinity : kNan;
      source->is_dense = false;
    }
    OrientedDoubleIcp icp;
    setUpCorner(icp);
    icp.setInputSource(source);
    if (flann)
      icp.setSearchMethodTarget(pcl::make_shared<pcl::search::KdTree<OrientedPoint>>());
    icp.setCorrespondenceEstimation(GetParam().make());
    expectCorner(icp);
    EXPECT_EQ(icp.result().pairs, 1995u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Pcl,
    Icp6DCorrespondences,
    testing::Values(
        named<reg::CorrespondenceEstimation<OrientedPoint, OrientedPoint, double>,
              OrientedDoubleIcp::Base::CorrespondenceEstimationPtr>("Nearest"),
        named<reg::CorrespondenceEstimationNormalShooting<OrientedPoint,
                                                          OrientedPoint,
                                                          OrientedPoint,
                                                          double>,
              OrientedDoubleIcp::Base::CorrespondenceEstimationPtr>("NormalShooting"),
        named<reg::CorrespondenceEstimationBackProjection<OrientedPoint,
                                                          OrientedPoint,
                                                          OrientedPoint,
                                                          double>,
              OrientedDoubleIcp::Base::CorrespondenceEstimationPtr>("BackProjection")),
    kNameOfPart);

TEST(Icp6DCorrespondencesWithoutNormals, FindNoPairsWhereTheyNeedThem)
{
  using Xyz = pcl::PointXYZ;
  pcl6d::ICP6D<Xyz, Xyz> icp;
  setUpCorner(icp);
  icp.setCorrespondenceEstimation(
      pcl::make_shared<
          reg::CorrespondenceEstimationNormalShooting<Xyz, Xyz, pcl::Normal>>());
  alignFrom(icp); // PCL prints that the normals are missing
  EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
}

using Minimiser = NamedPart<OrientedDoubleIcp::Base::TransformationEstimationPtr>;

class Icp6DEstimations : public testing::TestWithParam<Minimiser> {};

TEST_P(Icp6DEstimations, OfPclTakeTheStep)
{
  OrientedDoubleIcp icp;
  setUpCorner(icp);
  icp.setTransformationEstimation(GetParam().make());
  // Least squares by Levenberg-Marquardt stop at the root of the machine precision.
  expectCorner(icp, 1e-5);
  const Eigen::Matrix4d first = icp.getFinalTransformation();
  alignFrom(icp);
  EXPECT_TRUE(sameBits(Eigen::Matrix4d(icp.getFinalTransformation()), first));
}

INSTANTIATE_TEST_SUITE_P(
    Pcl,
    Icp6DEstimations,
    testing::Values(
        named<reg::TransformationEstimationSVD<OrientedPoint, OrientedPoint, double>,
              OrientedDoubleIcp::Base::TransformationEstimationPtr>("Svd"),
        named<
            reg::TransformationEstimationSVDScale<OrientedPoint, OrientedPoint, double>,
            OrientedDoubleIcp::Base::TransformationEstimationPtr>("SvdScale"),
        named<reg::TransformationEstimationDualQuaternion<OrientedPoint,
                                                          OrientedPoint,
                                                          double>,
              OrientedDoubleIcp::Base::TransformationEstimationPtr>("DualQuaternion"),
        named<reg::TransformationEstimationLM<OrientedPoint, OrientedPoint, double>,
              OrientedDoubleIcp::Base::TransformationEstimationPtr>("Lm"),
        named<reg::TransformationEstimationPointToPlane<OrientedPoint,
                                                        OrientedPoint,
                                                        double>,
              OrientedDoubleIcp::Base::TransformationEstimationPtr>("PointToPlane"),
        named<reg::TransformationEstimationPointToPlaneLLS<OrientedPoint,
                                                           OrientedPoint,
                                                           double>,
              OrientedDoubleIcp::Base::TransformationEstimationPtr>("PointToPlaneLls")),
    kNameOfPart);

TEST(Icp6DEstimation, ThatLeavesTheMotionAsItWasIsNotConverged)
{
  // It wants exactly three points, prints so, and returns.
  OrientedDoubleIcp icp;
  setUpCorner(icp);
  icp.setTransformationEstimation(
      pcl::make_shared<
          reg::TransformationEstimation3Point<OrientedPoint, OrientedPoint, double>>());
  alignFrom(icp);
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kDiverged);
}

TEST(Icp6DOwnEstimations, SetTheMetric)
{
  // Two samples of a corner, so that points and planes come to different poses.
  const auto found = [](auto change) {
    OrientedDoubleIcp icp;
    icp.setInputSource(
        cornerCloud<OrientedPoint>(cornerPoints(7), kCornerTruth.inverse()));
    icp.setInputTarget(cornerModel<OrientedPoint>());
    icp.setMaxCorrespondenceDistance(0.5);
    change(icp);
    alignFrom(icp);
    return Eigen::Matrix4d(icp.getFinalTransformation());
  };
  const auto helix =
      pcl::make_shared<pcl6d::TransformationEstimationPlaneHelix<OrientedPoint,
                                                                 OrientedPoint,
                                                                 double>>();
  const auto by_metric =
      found([](OrientedDoubleIcp& icp) { icp.setMetric(Metric::kPlane); });
  const auto by_points = found([](OrientedDoubleIcp&) {});
  EXPECT_FALSE(sameBits(by_metric, by_points));
  EXPECT_TRUE(sameBits(
      found([&](OrientedDoubleIcp& icp) { icp.setTransformationEstimation(helix); }),
      by_metric));
  const auto by_gicp =
      found([](OrientedDoubleIcp& icp) { icp.setMetric(Metric::kGicp); });
  EXPECT_TRUE(sameBits(found([&](OrientedDoubleIcp& icp) {
                         icp.setMetric(Metric::kGicp);
                         icp.setTransformationEstimation(helix);
                       }),
                       by_gicp))
      << "not GICP's";
  const auto svd = pcl::make_shared<
      pcl6d::TransformationEstimationSVD<OrientedPoint, OrientedPoint, double>>();
  EXPECT_LT(
      (found([&](OrientedDoubleIcp& icp) { icp.setTransformationEstimation(svd); }) -
       by_points)
          .norm(),
      1e-9);
}
