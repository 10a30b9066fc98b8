// SPDX-License-Identifier: BSD-3-Clause
// PCL's rejectors of correspondences, plugged into ICP6D.
#include "icp6d_cases.h"
#include "support/pcl_peers.h"

#include <pcl/registration/correspondence_rejection_distance.h>
#include <pcl/registration/correspondence_rejection_median_distance.h>
#include <pcl/registration/correspondence_rejection_one_to_one.h>
#include <pcl/registration/correspondence_rejection_surface_normal.h>
#include <pcl/registration/correspondence_rejection_trimmed.h>
#include <pcl/registration/correspondence_rejection_var_trimmed.h>

namespace reg = pcl::registration;
using namespace pcl6d::test;
using pcl6d::Metric;

namespace {
using OrientedPoint = pcl::PointNormal;
using OrientedDoubleIcp = pcl6d::ICP6D<OrientedPoint, OrientedPoint, double>;
} // namespace

using Rejector = NamedPart<reg::CorrespondenceRejector::Ptr>;

class Icp6DRejectors : public testing::TestWithParam<Rejector> {
protected:
  Icp6DRejectors()
  {
    icp_.setInputSource(outlierData<OrientedPoint>());
    icp_.setInputTarget(cornerModel<OrientedPoint>());
    icp_.setMaxCorrespondenceDistance(0.5);
    icp_.setMotionEpsilon(1e-7, 1e-7); // at rest only after the last outlier is gone
  }
  OrientedDoubleIcp icp_;
};

TEST_P(Icp6DRejectors, LeaveOutWhatWouldPull)
{
  for (const Metric metric : kMetrics) {
    SCOPED_TRACE(toString(metric));
    icp_.setMetric(metric);
    icp_.clearCorrespondenceRejectors();
    alignFrom(icp_);
    EXPECT_GT(errorOf(icp_).translation, 50 * kExactTol) << "all pairs";
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
  auto source = cornerData<OrientedPoint>();
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
            "Distance",
            [](auto& r) { r.setMaximumDistance(0.1f); }),
        named<reg::CorrespondenceRejectorMedianDistance,
              reg::CorrespondenceRejector::Ptr>("MedianDistance",
                                                [](auto& r) { r.setMedianFactor(4); }),
        named<reg::CorrespondenceRejectorSampleConsensus<OrientedPoint>,
              reg::CorrespondenceRejector::Ptr>("SampleConsensus",
                                                [](auto& r) {
                                                  r.setInlierThreshold(0.05);
                                                }),
        named<reg::CorrespondenceRejectorSurfaceNormal,
              reg::CorrespondenceRejector::Ptr>("SurfaceNormal",
                                                [](auto& r) { r.setThreshold(0.9); }),
        named<reg::CorrespondenceRejectorTrimmed, reg::CorrespondenceRejector::Ptr>(
            "Trimmed",
            [](auto& r) { r.setOverlapRatio(0.85f); })),
    kNameOfPart);

TEST(Icp6DRejectorOneToOne, LeavesTheClosestOfSeveral)
{
  // Each point twice, the second time off by 3 cm.
  auto source = cornerData<OrientedPoint>();
  const auto copy = *source;
  for (auto p : copy) {
    p.getVector3fMap().array() += 0.03f;
    source->push_back(p);
  }
  for (const Metric metric : kMetrics) {
    SCOPED_TRACE(toString(metric));
    OrientedDoubleIcp icp;
    icp.setInputSource(source);
    icp.setInputTarget(cornerModel<OrientedPoint>());
    icp.setMaxCorrespondenceDistance(0.06);
    icp.setMotionEpsilon(1e-7, 1e-7);
    icp.setMetric(metric);
    alignFrom(icp);
    const double plain = errorOf(icp).translation;
    icp.addCorrespondenceRejector(
        pcl::make_shared<reg::CorrespondenceRejectorOneToOne>());
    alignFrom(icp);
    EXPECT_LE(icp.result().pairs, 1998u);
    EXPECT_LT(errorOf(icp).translation, 0.5 * plain);
  }
}

TEST(Icp6DRejectorVarTrimmed, ChoosesTheShareItself)
{
  const auto rejector = pcl::make_shared<reg::CorrespondenceRejectorVarTrimmed>();
  OrientedDoubleIcp icp;
  icp.setInputSource(
      cornerCloud<OrientedPoint>(cornerPoints(7), kCornerTruth.inverse()));
  icp.setInputTarget(cornerModel<OrientedPoint>());
  icp.setMaxCorrespondenceDistance(0.5);
  icp.addCorrespondenceRejector(rejector);
  alignFrom(icp);
  const double share = rejector->getTrimFactor();
  EXPECT_GT(share, 0.04);
  EXPECT_LT(share, 1);
  EXPECT_NEAR(static_cast<double>(icp.result().pairs), share * 1998, 2);
}

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
  OrientedDoubleIcp icp;
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
