// SPDX-License-Identifier: BSD-3-Clause
// PCL's parts, plugged into ICP6D.
#include "icp6d_cases.h"

#include <pcl6d/registration/transformation_estimation_plane_helix.h>
#include <pcl6d/registration/transformation_estimation_svd.h>

#include <pcl/registration/correspondence_estimation_backprojection.h>
#include <pcl/registration/correspondence_estimation_normal_shooting.h>
#include <pcl/registration/correspondence_rejection_distance.h>
#include <pcl/registration/correspondence_rejection_median_distance.h>
#include <pcl/registration/correspondence_rejection_one_to_one.h>
#include <pcl/registration/correspondence_rejection_sample_consensus.h>
#include <pcl/registration/correspondence_rejection_surface_normal.h>
#include <pcl/registration/correspondence_rejection_trimmed.h>
#include <pcl/registration/correspondence_rejection_var_trimmed.h>
#include <pcl/registration/transformation_estimation_dual_quaternion.h>
#include <pcl/registration/transformation_estimation_lm.h>
#include <pcl/registration/transformation_estimation_point_to_plane.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>
#include <pcl/registration/transformation_estimation_svd.h>
#include <pcl/registration/transformation_estimation_svd_scale.h>

namespace reg = pcl::registration;
using namespace pcl6d::test;
using pcl6d::Metric;
using pcl6d::Status;

namespace {
using Point = pcl::PointNormal;
using Icp = pcl6d::ICP6D<Point, Point, double>;

template <typename T>
struct Named {
  std::string name;
  std::function<T()> make;
};

template <typename T>
void
PrintTo(const Named<T>& named, std::ostream* out)
{
  *out << named.name;
}

const auto kNameOf = [](const auto& tested) { return tested.param.name; };

template <typename T, typename Base>
Named<Base>
named(const std::string& name, std::function<void(T&)> change = nullptr)
{
  return {name, [change]() -> Base {
            const auto part = pcl::make_shared<T>();
            if (change)
              change(*part);
            return part;
          }};
}
} // namespace

using Rejector = Named<reg::CorrespondenceRejector::Ptr>;

class Icp6DRejectors : public testing::TestWithParam<Rejector> {
protected:
  Icp6DRejectors()
  {
    icp_.setInputSource(outlierData<Point>());
    icp_.setInputTarget(cornerModel<Point>());
    icp_.setMaxCorrespondenceDistance(0.5);
    icp_.setMotionEpsilon(1e-7, 1e-7); // at rest only after the last outlier is gone
  }
  Icp icp_;
};

TEST_P(Icp6DRejectors, LeaveOutWhatWouldPull)
{
  for (const Metric metric : kMetrics) {
    SCOPED_TRACE(toString(metric));
    icp_.setMetric(metric);
    icp_.clearCorrespondenceRejectors();
    alignFrom(icp_);
    EXPECT_GT(errorOf(icp_).translation, 1e-3) << "all pairs";
    EXPECT_GT(icp_.result().pairs, 1900u);
    icp_.addCorrespondenceRejector(GetParam().make());
    expectCorner(icp_);
    EXPECT_GT(icp_.result().pairs, 900u);
    EXPECT_LE(icp_.result().pairs, 1798u) << "none of the outliers";
  }
}

TEST_P(Icp6DRejectors, GiveTheSameBitsAgain)
{
  icp_.addCorrespondenceRejector(GetParam().make());
  alignFrom(icp_);
  const Eigen::Matrix4d first = icp_.getFinalTransformation();
  alignFrom(icp_);
  EXPECT_TRUE(sameBits(Eigen::Matrix4d(icp_.getFinalTransformation()), first));
}

TEST_P(Icp6DRejectors, SeeOnlyTheChosenPoints)
{
  auto source = outlierData<Point>();
  const auto chosen = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < source->size(); ++i)
    if (i % 4 < 2)
      chosen->push_back(static_cast<int>(i));
    else
      (*source)[i].getVector3fMap().array() += 0.1f; // would pull the others
  icp_.setInputSource(source);
  icp_.setIndices(chosen);
  icp_.addCorrespondenceRejector(GetParam().make());
  expectCorner(icp_);
  EXPECT_LE(icp_.result().pairs, chosen->size());
}

INSTANTIATE_TEST_SUITE_P(
    Pcl,
    Icp6DRejectors,
    testing::Values(
        named<reg::CorrespondenceRejectorDistance, reg::CorrespondenceRejector::Ptr>(
            "Distance", [](auto& r) { r.setMaximumDistance(0.1f); }),
        named<reg::CorrespondenceRejectorMedianDistance,
              reg::CorrespondenceRejector::Ptr>("MedianDistance",
                                                [](auto& r) { r.setMedianFactor(4); }),
        named<reg::CorrespondenceRejectorOneToOne, reg::CorrespondenceRejector::Ptr>(
            "OneToOne"),
        named<reg::CorrespondenceRejectorSampleConsensus<Point>,
              reg::CorrespondenceRejector::Ptr>(
            "SampleConsensus", [](auto& r) { r.setInlierThreshold(0.05); }),
        named<reg::CorrespondenceRejectorSurfaceNormal,
              reg::CorrespondenceRejector::Ptr>("SurfaceNormal",
                                                [](auto& r) { r.setThreshold(0.9); }),
        named<reg::CorrespondenceRejectorTrimmed, reg::CorrespondenceRejector::Ptr>(
            "Trimmed", [](auto& r) { r.setOverlapRatio(0.85f); }),
        named<reg::CorrespondenceRejectorVarTrimmed, reg::CorrespondenceRejector::Ptr>(
            "VarTrimmed")),
    kNameOf);

TEST(Icp6DRejectorsInTurn, EachSeesWhatTheLastOneLeft)
{
  struct Counting : reg::CorrespondenceRejectorTrimmed {
    std::size_t seen = 0;
    void
    getRemainingCorrespondences(const pcl::Correspondences& in,
                                pcl::Correspondences& out) override
    {
      seen = in.size();
      CorrespondenceRejectorTrimmed::getRemainingCorrespondences(in, out);
    }
  };
  const auto first = pcl::make_shared<Counting>();
  const auto second = pcl::make_shared<Counting>();
  Icp icp;
  setUpCorner(icp);
  for (const auto& rejector : {first, second}) {
    rejector->setOverlapRatio(0.5f);
    icp.addCorrespondenceRejector(rejector);
  }
  expectCorner(icp);
  EXPECT_EQ(first->seen, 1998u);
  EXPECT_EQ(second->seen, 999u);
  EXPECT_NEAR(static_cast<double>(icp.result().pairs), 499.5, 0.6);
}

using Estimation = Named<Icp::Base::CorrespondenceEstimationPtr>;

class Icp6DCorrespondences : public testing::TestWithParam<Estimation> {};

TEST_P(Icp6DCorrespondences, ComeFromPcl)
{
  Icp icp;
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
    auto source = cornerData<Point>();
    for (const std::size_t i : {0u, 7u, 1997u}) {
      (*source)[i].y = i == 7 ? kInfinity : kNan;
      source->is_dense = false;
    }
    Icp icp;
    setUpCorner(icp);
    icp.setInputSource(source);
    if (flann)
      icp.setSearchMethodTarget(pcl::make_shared<pcl::search::KdTree<Point>>());
    icp.setCorrespondenceEstimation(GetParam().make());
    expectCorner(icp);
    EXPECT_EQ(icp.result().pairs, 1995u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Pcl,
    Icp6DCorrespondences,
    testing::Values(
        named<reg::CorrespondenceEstimation<Point, Point, double>,
              Icp::Base::CorrespondenceEstimationPtr>("Nearest"),
        named<reg::CorrespondenceEstimationNormalShooting<Point, Point, Point, double>,
              Icp::Base::CorrespondenceEstimationPtr>("NormalShooting"),
        named<reg::CorrespondenceEstimationBackProjection<Point, Point, Point, double>,
              Icp::Base::CorrespondenceEstimationPtr>("BackProjection")),
    kNameOf);

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

using Minimiser = Named<Icp::Base::TransformationEstimationPtr>;

class Icp6DEstimations : public testing::TestWithParam<Minimiser> {};

TEST_P(Icp6DEstimations, OfPclTakeTheStep)
{
  Icp icp;
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
        named<reg::TransformationEstimationSVD<Point, Point, double>,
              Icp::Base::TransformationEstimationPtr>("Svd"),
        named<reg::TransformationEstimationSVDScale<Point, Point, double>,
              Icp::Base::TransformationEstimationPtr>("SvdScale"),
        named<reg::TransformationEstimationDualQuaternion<Point, Point, double>,
              Icp::Base::TransformationEstimationPtr>("DualQuaternion"),
        named<reg::TransformationEstimationLM<Point, Point, double>,
              Icp::Base::TransformationEstimationPtr>("Lm"),
        named<reg::TransformationEstimationPointToPlane<Point, Point, double>,
              Icp::Base::TransformationEstimationPtr>("PointToPlane"),
        named<reg::TransformationEstimationPointToPlaneLLS<Point, Point, double>,
              Icp::Base::TransformationEstimationPtr>("PointToPlaneLls")),
    kNameOf);

TEST(Icp6DOwnEstimations, SetTheMetric)
{
  // Two samples of a corner, so that points and planes come to different poses.
  const auto found = [](auto change) {
    Icp icp;
    icp.setInputSource(
        cornerCloud<Point>(cornerPoints(7), kCornerTruth.inverse()));
    icp.setInputTarget(cornerModel<Point>());
    icp.setMaxCorrespondenceDistance(0.5);
    change(icp);
    alignFrom(icp);
    return Eigen::Matrix4d(icp.getFinalTransformation());
  };
  const auto helix = pcl::make_shared<
      pcl6d::TransformationEstimationPlaneHelix<Point, Point, double>>();
  const auto by_metric = found([](Icp& icp) { icp.setMetric(Metric::kPlane); });
  const auto by_points = found([](Icp&) {});
  EXPECT_FALSE(sameBits(by_metric, by_points));
  EXPECT_TRUE(sameBits(
      found([&](Icp& icp) { icp.setTransformationEstimation(helix); }), by_metric));
  const auto by_gicp = found([](Icp& icp) { icp.setMetric(Metric::kGicp); });
  EXPECT_TRUE(sameBits(found([&](Icp& icp) {
                         icp.setMetric(Metric::kGicp);
                         icp.setTransformationEstimation(helix);
                       }),
                       by_gicp))
      << "not GICP's";
  const auto svd =
      pcl::make_shared<pcl6d::TransformationEstimationSVD<Point, Point, double>>();
  EXPECT_LT(
      (found([&](Icp& icp) { icp.setTransformationEstimation(svd); }) - by_points)
          .norm(),
      1e-9);
}
