// SPDX-License-Identifier: BSD-3-Clause
// ICP: the cases of PCL's registration tests, for PCL's classes and ours.
#include "as_pcl_cases.h"
#include "support/pcl_peers.h"

#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/correspondence_rejection_median_distance.h>

#include <limits>

namespace reg = pcl::registration;
using namespace pcl6d::test;
using pcl6d::Random;

namespace {
using Point = pcl::PointXYZ;
using WithNormal = pcl::PointNormal;

/** What PCL's tests set for the bunny [m]. */
template <typename Icp>
void
setUpBunny(Icp& icp)
{
  icp.setMaximumIterations(50);
  icp.setTransformationEpsilon(1e-8);
  icp.setMaxCorrespondenceDistance(0.05);
}

/** \return the mean square of the distances of PCL's tree, for both sides alike [m^2] */
template <typename Icp>
double
fitnessOf(Icp& icp)
{
  using P = typename Icp::PointCloudSource::PointType;
  pcl::PointCloud<P> moved;
  pcl::transformPointCloud(*icp.getInputSource(), moved, icp.getFinalTransformation());
  pcl::search::KdTree<P> tree;
  tree.setInputCloud(icp.getInputTarget());
  double sum = 0;
  for (const auto& p : moved) {
    pcl::Indices index(1);
    std::vector<float> distance(1);
    tree.nearestKSearch(p, 1, index, distance);
    sum += static_cast<double>(distance[0]);
  }
  return sum / static_cast<double>(moved.size());
}

/** Gives a cloud the normals of 20 neighbours. */
pcl::PointCloud<WithNormal>::Ptr
withNormals(const pcl::PointCloud<Point>::Ptr& cloud)
{
  auto out = pcl::make_shared<pcl::PointCloud<WithNormal>>();
  pcl::copyPointCloud(*cloud, *out);
  pcl::NormalEstimation<WithNormal, WithNormal> estimation;
  estimation.setInputCloud(out);
  estimation.setKSearch(20);
  pcl::PointCloud<WithNormal> normals;
  estimation.compute(normals);
  for (std::size_t i = 0; i < out->size(); ++i)
    (*out)[i].getNormalVector3fMap() = normals[i].getNormalVector3fMap();
  return out;
}
} // namespace

template <typename Side>
class IcpAsPcl : public testing::Test {};
TYPED_TEST_SUITE(IcpAsPcl, BothSides, NameOfSide);

TYPED_TEST(IcpAsPcl, FindsATranslation)
{
  Random random(1);
  const auto target = toCloud<Point>(randomCube(random, 200, 10));
  auto source = pcl::make_shared<pcl::PointCloud<Point>>(*target);
  for (auto& p : *source)
    p.x += 0.2f;
  typename TypeParam::template Icp<Point> icp;
  icp.setInputSource(source);
  icp.setInputTarget(target);
  alignFrom(icp);
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
  truth.translation().x() = -0.2;
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_LT(errorOf(icp, truth).translation, 1e-5);
  EXPECT_LT(icp.getFitnessScore(), 1e-9);
}

TYPED_TEST(IcpAsPcl, BuildsTheTreeOfTheTargetOnce)
{
  using Tree = CountingTree<typename TypeParam::template Tree<Point>>;
  const auto tree = pcl::make_shared<Tree>();
  const auto target = cornerModel<Point>();
  tree->setInputCloud(target);
  typename TypeParam::template Icp<Point> icp;
  icp.setSearchMethodTarget(tree, true);
  icp.setInputTarget(target);
  icp.setMaxCorrespondenceDistance(0.5);
  for (int run = 0; run < 3; ++run) {
    icp.setInputSource(cornerData<Point>());
    alignFrom(icp);
    EXPECT_LT(errorOf(icp).translation, 1e-4);
  }
  EXPECT_EQ(tree->built, 1);
}

TYPED_TEST(IcpAsPcl, RegistersTheBunny)
{
  PCL6D_DATA_OR_SKIP(folder, "pcl");
  const auto source = loadFinite<Point>(folder / "bun0.pcd");
  const auto target = loadFinite<Point>(folder / "bun4.pcd");
  typename TypeParam::template Icp<Point> icp;
  setUpBunny(icp);
  icp.setInputSource(source);
  icp.setInputTarget(target);
  for (const bool reciprocal : {false, true}) {
    icp.setUseReciprocalCorrespondences(reciprocal);
    pcl::PointCloud<Point> aligned;
    icp.align(aligned);
    EXPECT_EQ(aligned.size(), source->size());
    EXPECT_LT(fitnessOf(icp), reciprocal ? 1e-3 : 5e-4);
    EXPECT_NEAR(icp.getFitnessScore(), fitnessOf(icp), 1e-7);
  }
}

TYPED_TEST(IcpAsPcl, RegistersTheBunnyWithRejectors)
{
  PCL6D_DATA_OR_SKIP(folder, "pcl");
  typename TypeParam::template Icp<Point> icp;
  setUpBunny(icp);
  icp.setInputSource(loadFinite<Point>(folder / "bun0.pcd"));
  icp.setInputTarget(loadFinite<Point>(folder / "bun4.pcd"));
  const auto median = pcl::make_shared<reg::CorrespondenceRejectorMedianDistance>();
  median->setMedianFactor(4.0);
  icp.addCorrespondenceRejector(median);
  const auto consensus =
      pcl::make_shared<reg::CorrespondenceRejectorSampleConsensus<Point>>();
  consensus->setMaximumIterations(0);
  consensus->setInlierThreshold(0.005);
  icp.addCorrespondenceRejector(consensus);
  alignFrom(icp);
  EXPECT_LT(fitnessOf(icp), 5e-4);
}

TYPED_TEST(IcpAsPcl, RegistersTheBunnyByNormals)
{
  PCL6D_DATA_OR_SKIP(folder, "pcl");
  // Normals of PCL's point to the origin, from which this scan was not seen.
  const auto target = withNormals(loadFinite<Point>(folder / "bun0.pcd"));
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.005, -0.003, 0.004}, {0.03, 0.05, -0.04});
  auto source = pcl::make_shared<pcl::PointCloud<WithNormal>>();
  pcl::transformPointCloudWithNormals(*target, *source, truth.inverse().matrix());
  for (const bool symmetric : {false, true})
    for (const bool enforce : {true, false}) {
      typename TypeParam::template WithNormals<WithNormal> icp;
      icp.setUseSymmetricObjective(symmetric);
      icp.setEnforceSameDirectionNormals(enforce);
      EXPECT_EQ(icp.getUseSymmetricObjective(), symmetric);
      EXPECT_EQ(icp.getEnforceSameDirectionNormals(), enforce);
      icp.setInputSource(source);
      icp.setInputTarget(target);
      setUpBunny(icp);
      icp.setTransformationEpsilon(1e-12);
      alignFrom(icp);
      EXPECT_LT(errorOf(icp, truth).translation, 1e-5) << symmetric << enforce;
      EXPECT_LT(errorOf(icp, truth).rotation, 1e-4) << symmetric << enforce;
    }
}

TYPED_TEST(IcpAsPcl, RegistersTheBunnyByGicp)
{
  PCL6D_DATA_OR_SKIP(folder, "pcl");
  typename TypeParam::template Gicp<Point> icp;
  icp.setInputSource(loadFinite<Point>(folder / "bun0.pcd"));
  icp.setInputTarget(loadFinite<Point>(folder / "bun4.pcd"));
  setUpBunny(icp);
  alignFrom(icp);
  EXPECT_LT(fitnessOf(icp), 1e-4) << "closer than points to points";
}

TYPED_TEST(IcpAsPcl, RegistersTheMilkScene)
{
  PCL6D_DATA_OR_SKIP(folder, "pcl");
  const auto all = loadFinite<Point>(folder / "milk_color.pcd");
  auto target = pcl::make_shared<pcl::PointCloud<Point>>();
  pcl::VoxelGrid<Point> grid;
  grid.setLeafSize(0.01f, 0.01f, 0.01f);
  grid.setInputCloud(all);
  grid.filter(*target);
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.01, -0.008, 0.012}, {0.01, 0.02, -0.01});
  auto source = pcl::make_shared<pcl::PointCloud<Point>>();
  pcl::transformPointCloud(*target, *source, truth.inverse().matrix());
  typename TypeParam::template Icp<Point> icp;
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaximumIterations(200);
  icp.setTransformationEpsilon(1e-14);
  icp.setMaxCorrespondenceDistance(0.1);
  alignFrom(icp);
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_LT(errorOf(icp, truth).translation, 1e-5);
}

TEST(IcpOfBoth, OursIsAtLeastAsCloseOnTheBunny)
{
  PCL6D_DATA_OR_SKIP(folder, "pcl");
  const auto run = [&](auto&& icp) {
    setUpBunny(icp);
    icp.setInputSource(loadFinite<Point>(folder / "bun0.pcd"));
    icp.setInputTarget(loadFinite<Point>(folder / "bun4.pcd"));
    alignFrom(icp);
    return fitnessOf(icp);
  };
  // Both stop at their 50th iteration: a thousandth is the rounding of their steps.
  EXPECT_LT(run(OfOurs::Icp<Point>()), 1.001 * run(OfPcl::Icp<Point>()));
  // The distance of points is not what GICP makes least.
  EXPECT_LT(run(OfOurs::Gicp<Point>()), 1.1 * run(OfPcl::Gicp<Point>()));
}

TEST(IcpOfBoth, OurRejectorsDoInPclsIcpWhatPclsDo)
{
  PCL6D_DATA_OR_SKIP(folder, "pcl");
  const auto source = loadFinite<Point>(folder / "bun0.pcd");
  const auto target = loadFinite<Point>(folder / "bun4.pcd");
  const auto pairs = pcl::make_shared<pcl::Correspondences>();
  OfOurs::Correspondences<Point> ours;
  OfPcl::Correspondences<Point> pcls;
  pcl::Correspondences of_pcl;
  const auto find = [&](auto& estimation, pcl::Correspondences& found) {
    estimation.setInputSource(source);
    estimation.setInputTarget(target);
    estimation.determineCorrespondences(found);
  };
  find(ours, *pairs);
  find(pcls, of_pcl);
  ASSERT_EQ(pairs->size(), of_pcl.size());
  for (std::size_t i = 0; i < pairs->size(); ++i)
    EXPECT_EQ((*pairs)[i].distance, of_pcl[i].distance) << i;
  const auto left = [&](auto&& rejector) {
    pcl::Correspondences kept;
    rejector.setInputCorrespondences(pairs);
    rejector.getCorrespondences(kept);
    double sum = 0;
    for (const auto& pair : kept)
      sum += static_cast<double>(pair.distance);
    return std::make_pair(kept.size(), sum);
  };
  const auto one = left(OfOurs::OneToOne()), one_of_pcl = left(OfPcl::OneToOne());
  EXPECT_EQ(one.first, one_of_pcl.first);
  EXPECT_NEAR(one.second, one_of_pcl.second, 1e-12);
  EXPECT_LT(one.first, pairs->size());
  const auto half = left(OfOurs::Trimmed()), half_of_pcl = left(OfPcl::Trimmed());
  EXPECT_EQ(half.first, half_of_pcl.first);
  EXPECT_NEAR(half.second, half_of_pcl.second, 1e-12);
}
