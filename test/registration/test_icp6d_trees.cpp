// SPDX-License-Identifier: BSD-3-Clause
// The search method of the target.
#include "icp6d_cases.h"
#include "support/pcl_peers.h"

#include <pcl6d/search/pcl/approximate_kd_tree.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>

#include <pcl/registration/correspondence_rejection_distance.h>

using namespace pcl6d::test;
using pcl6d::Metric;
using pcl6d::Status;

namespace {
using OrientedPoint = pcl::PointNormal;
using OrientedCloud = pcl::PointCloud<OrientedPoint>;
using OrientedIcp = pcl6d::ICP6D<OrientedPoint, OrientedPoint>;

pcl::registration::CorrespondenceRejector::Ptr
rejectFar(float distance)
{
  const auto rejector =
      pcl::make_shared<pcl::registration::CorrespondenceRejectorDistance>();
  rejector->setMaximumDistance(distance);
  return rejector;
}
} // namespace

template <typename Tree>
class Icp6DTrees : public testing::Test {};
using Trees = testing::Types<pcl6d::KdTree<OrientedPoint>,
                             pcl6d::CachedKdTree<OrientedPoint>,
                             pcl6d::ApproximateKdTree<OrientedPoint>,
                             pcl::search::KdTree<OrientedPoint>>;
TYPED_TEST_SUITE(Icp6DTrees, Trees);

TYPED_TEST(Icp6DTrees, AreBuiltOncePerTargetForAllMetrics)
{
  const auto tree = pcl::make_shared<CountingTree<TypeParam>>();
  OrientedIcp icp;
  icp.setSearchMethodTarget(tree);
  setUpCorner(icp);
  for (const Metric metric : kMetrics) {
    icp.setMetric(metric);
    expectCorner(icp);
    icp.setInputSource(cornerData<OrientedPoint>());
    expectCorner(icp);
    icp.getFitnessScore();
  }
  EXPECT_EQ(tree->built, 1);
  icp.setInputTarget(cornerModel<OrientedPoint>(2));
  icp.setInputSource(cornerData<OrientedPoint>(2));
  expectCorner(icp);
  EXPECT_EQ(tree->built, 2);
}

TYPED_TEST(Icp6DTrees, MayBeBuiltBefore)
{
  const auto tree = pcl::make_shared<CountingTree<TypeParam>>();
  const auto target = cornerModel<OrientedPoint>();
  tree->setInputCloud(target);
  OrientedIcp icp;
  setUpCorner(icp);
  icp.setInputTarget(target);
  icp.setSearchMethodTarget(tree, true); // PCL: do not build again
  expectCorner(icp);
  EXPECT_EQ(tree->built, 1);
}

TYPED_TEST(Icp6DTrees, MayBeEmptyAndNotToBeBuiltByPcl)
{
  OrientedIcp icp;
  setUpCorner(icp);
  icp.setSearchMethodTarget(pcl::make_shared<TypeParam>(), true);
  expectCorner(icp);
}

TYPED_TEST(Icp6DTrees, MayHoldSomePointsOfTheTarget)
{
  // The tree knows only every other point; the wrong partners stand in between.
  const auto target = pcl::make_shared<OrientedCloud>();
  const auto indices = pcl::make_shared<pcl::Indices>();
  const auto model = cornerModel<OrientedPoint>();
  for (const auto& p : *model) {
    OrientedPoint wrong = p;
    wrong.getVector3fMap() += Eigen::Vector3f(0.1f, -0.05f, 0.03f);
    target->push_back(wrong);
    indices->push_back(static_cast<int>(target->size()));
    target->push_back(p);
  }
  std::reverse(indices->begin(), indices->end());
  const auto tree = pcl::make_shared<TypeParam>();
  tree->setInputCloud(target, indices);
  for (const Metric metric : kMetrics)
    for (const int plugs : {0, 1, 2, 3}) { // none, a rejector, also the estimations
      SCOPED_TRACE(std::string(toString(metric)) + " " + std::to_string(plugs));
      OrientedIcp icp;
      setUpCorner(icp);
      icp.setInputTarget(target);
      icp.setSearchMethodTarget(tree, true);
      icp.setMetric(metric);
      if (plugs > 0)
        icp.addCorrespondenceRejector(rejectFar(0.3f));
      if (plugs > 1)
        icp.setTransformationEstimation(
            pcl::make_shared<
                pcl::registration::TransformationEstimationSVD<OrientedPoint,
                                                               OrientedPoint>>());
      if (plugs > 2)
        icp.setCorrespondenceEstimation(
            pcl::make_shared<
                pcl::registration::CorrespondenceEstimation<OrientedPoint,
                                                            OrientedPoint>>());
      expectCorner(icp, plugs > 1 ? 1e-5 : kExactTol); // PCL's steps are of float
      EXPECT_EQ(icp.result().pairs, 1998u);
    }
}

TYPED_TEST(Icp6DTrees, MayHoldNan)
{
  auto target = cornerModel<OrientedPoint>();
  (*target)[5].x = kNan;
  target->is_dense = false;
  OrientedIcp icp;
  icp.setSearchMethodTarget(pcl::make_shared<TypeParam>());
  setUpCorner(icp);
  icp.setInputTarget(target);
  icp.setMaxCorrespondenceDistance(0.04); // not the neighbour of the missing one
  expectCorner(icp, 1e-4);
  EXPECT_GE(icp.result().pairs, 1990u);
}

TYPED_TEST(Icp6DTrees, KnowThatAPlaneIsOpenButForItsPoints)
{
  pcl6d::Random random(3);
  pcl6d::Points plane;
  for (int i = 0; i < 900; ++i)
    plane.emplace_back(static_cast<float>(random.uniform(-2, 2)),
                       static_cast<float>(random.uniform(-2, 2)),
                       1.0f);
  for (const Metric metric : kMetrics) {
    OrientedIcp icp;
    icp.setSearchMethodTarget(pcl::make_shared<TypeParam>());
    icp.setInputSource(toCloud<OrientedPoint>(plane));
    icp.setInputTarget(toCloud<OrientedPoint>(plane));
    icp.setMaxCorrespondenceDistance(0.5);
    icp.setMetric(metric);
    alignFrom(icp);
    const bool by_points = metric == Metric::kPoint; // which lie on each other
    EXPECT_EQ(icp.hasConverged(), by_points) << toString(metric);
    EXPECT_EQ(icp.result().status, by_points ? Status::kOk : Status::kRankDeficient);
  }
}

TEST(Icp6DTree, OfTheCachedKindStartsAtItsLeaves)
{
  std::vector<pcl6d::IcpIteration> seen[2];
  Eigen::Isometry3d found[2];
  for (const bool cached : {false, true}) {
    OrientedIcp icp;
    setUpCorner(icp);
    if (cached)
      icp.setSearchMethodTarget(pcl::make_shared<pcl6d::CachedKdTree<OrientedPoint>>());
    icp.setObserver([&](const pcl6d::IcpIteration& i) {
      seen[cached].push_back(i);
      return true;
    });
    for (int run = 0; run < 2; ++run) { // the second one with leaves of its own
      seen[cached].clear();
      alignFrom(icp);
    }
    found[cached] = icp.result().T_target_source;
  }
  EXPECT_TRUE(sameBits(found[0], found[1]));
  ASSERT_EQ(seen[0].size(), seen[1].size());
  EXPECT_EQ(seen[0].back().from_leaf, 0u);
  EXPECT_EQ(seen[1].front().from_leaf, 0u);
  EXPECT_EQ(seen[1].back().searched, cornerData<OrientedPoint>()->size());
  EXPECT_GT(seen[1].back().from_leaf, cornerData<OrientedPoint>()->size() * 9 / 10);
}

TEST(PclIcp, FindsTheSameFromTheLeavesOfTheCachedTree)
{
  const auto cached = pcl::make_shared<pcl6d::CachedKdTree<OrientedPoint>>();
  const auto align = [](const pcl::search::KdTree<OrientedPoint>::Ptr& tree) {
    pcl::IterativeClosestPoint<OrientedPoint, OrientedPoint> icp;
    icp.setSearchMethodTarget(tree);
    setUpCorner(icp);
    OrientedCloud aligned;
    icp.align(aligned);
    EXPECT_TRUE(icp.hasConverged());
    return icp.getFinalTransformation();
  };
  const Eigen::Matrix4f expected =
      align(pcl::make_shared<pcl6d::KdTree<OrientedPoint>>());
  EXPECT_TRUE(sameBits(align(cached), expected));
  EXPECT_GE(cached->numRemembered(), cornerData<OrientedPoint>()->size());
}

TEST(Icp6DTree, OfAnotherCloudIsRefused)
{
  const auto tree = pcl::make_shared<pcl6d::KdTree<OrientedPoint>>();
  tree->setInputCloud(cornerModel<OrientedPoint>(5));
  OrientedIcp icp;
  setUpCorner(icp);
  icp.setInputTarget(toCloud<OrientedPoint>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  icp.setSearchMethodTarget(tree, true);
  EXPECT_THROW(alignFrom(icp),
               pcl6d::BadArgument); // its indices lie outside the target
}
