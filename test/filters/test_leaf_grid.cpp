// SPDX-License-Identifier: BSD-3-Clause
// OctreeReduction where pcl::VoxelGrid stood: the same setters, the same voxels, in the same
// order, on the same clouds; PCL's class is the oracle.
#include "support/clouds.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/filters/pcl/octree_reduction.h>

#include <pcl/conversions.h>
#include <pcl/filters/voxel_grid.h>

#include <functional>

using pcl6d::OctreeReduction;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::toCloud;

namespace {
using Point = pcl::PointXYZI;
using Cloud = pcl::PointCloud<Point>;

/** Points on multiples of 0.1 too, where rounding decides, and one that is NaN. */
Cloud::Ptr
samples()
{
  Random random(1);
  const Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < 6000; ++i) {
    Point p;
    p.getVector3fMap() = Eigen::Vector3d(random.uniform(-3, 5),
                                         random.uniform(-2, 2),
                                         random.uniform(-1, 1))
                             .cast<float>();
    if (i % 3 == 0)
      p.getVector3fMap() = (p.getVector3fMap() * 10).array().round() / 10;
    p.intensity = static_cast<float>(random.uniform(0, 100));
    cloud->push_back(p);
  }
  (*cloud)[17].y = kNan;
  cloud->is_dense = false;
  return cloud;
}

template <typename Filter>
Cloud
filtered(Filter& filter, const Cloud::ConstPtr& cloud)
{
  Cloud output;
  filter.setInputCloud(cloud);
  filter.filter(output);
  return output;
}

void
expectSame(const Cloud& found, const Cloud& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_EQ(found.width, expected.width);
  EXPECT_EQ(found.height, expected.height);
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_LT((found[i].getVector3fMap() - expected[i].getVector3fMap()).norm(), 2e-6)
        << i;
    ASSERT_NEAR(found[i].intensity, expected[i].intensity, 1e-4) << i;
  }
}

struct Case {
  std::string name;
  std::function<void(OctreeReduction<Point>&)> ours;
  std::function<void(pcl::VoxelGrid<Point>&)> of_pcl;
};

/** The same call of both classes. */
#define PCL6D_TEST_BOTH(name, call)                                                    \
  Case                                                                                 \
  {                                                                                    \
    name, [](auto& f) { call; }, [](auto& f) { call; }                                 \
  }

class LeafGridOf : public testing::TestWithParam<Case> {};
} // namespace

TEST_P(LeafGridOf, GivesWhatPclGives)
{
  OctreeReduction<Point> ours;
  pcl::VoxelGrid<Point> of_pcl;
  ours.setLeafSize(0.1f, 0.1f, 0.1f);
  of_pcl.setLeafSize(0.1f, 0.1f, 0.1f);
  GetParam().ours(ours);
  GetParam().of_pcl(of_pcl);
  const Cloud::Ptr cloud = samples();
  const Cloud expected = filtered(of_pcl, cloud);
  EXPECT_GT(expected.size(), 10u);
  EXPECT_LT(expected.size(), cloud->size());
  expectSame(filtered(ours, cloud), expected);
}

INSTANTIATE_TEST_SUITE_P(
    Settings,
    LeafGridOf,
    testing::Values(
        PCL6D_TEST_BOTH("cubes", static_cast<void>(f)),
        PCL6D_TEST_BOTH("boxes", f.setLeafSize(0.3f, 0.2f, 0.07f)),
        PCL6D_TEST_BOTH("vector", f.setLeafSize(Eigen::Vector4f(0.5f, 0.5f, 0.5f, 0))),
        PCL6D_TEST_BOTH("coordinates", f.setDownsampleAllData(false)),
        PCL6D_TEST_BOTH("crowded", f.setLeafSize(0.5f, 0.5f, 0.5f);
                        f.setMinimumPointsNumberPerVoxel(15)),
        PCL6D_TEST_BOTH("within", f.setFilterFieldName("z");
                        f.setFilterLimits(-0.4, 0.3)),
        PCL6D_TEST_BOTH("bright", f.setFilterFieldName("intensity");
                        f.setFilterLimits(40, 60);
                        f.setFilterLimitsNegative(true)),
        PCL6D_TEST_BOTH("layout", f.setSaveLeafLayout(true))),
    [](const auto& which) { return which.param.name; });

TEST(LeafGrid, KnowsWhichPointIsThatOfACell)
{
  OctreeReduction<Point> ours;
  pcl::VoxelGrid<Point> of_pcl;
  const auto setUp = [](auto& f) {
    f.setLeafSize(0.4f, 0.3f, 0.2f);
    f.setSaveLeafLayout(true);
    f.setMinimumPointsNumberPerVoxel(3);
  };
  setUp(ours);
  setUp(of_pcl);
  const Cloud::Ptr cloud = samples();
  filtered(ours, cloud);
  filtered(of_pcl, cloud);
  EXPECT_EQ(ours.getMinBoxCoordinates(), of_pcl.getMinBoxCoordinates());
  EXPECT_EQ(ours.getMaxBoxCoordinates(), of_pcl.getMaxBoxCoordinates());
  EXPECT_EQ(ours.getNrDivisions(), of_pcl.getNrDivisions());
  EXPECT_EQ(ours.getDivisionMultiplier(), of_pcl.getDivisionMultiplier());
  EXPECT_EQ(ours.getLeafLayout(), of_pcl.getLeafLayout());
  EXPECT_EQ(ours.getLeafSize(), of_pcl.getLeafSize());
  Eigen::MatrixXi around(3, 3);
  around << -1, 0, 1, 0, 0, 0, 0, 1, 50;
  for (std::size_t i = 20; i < 200; ++i) {
    const Point& p = (*cloud)[i];
    EXPECT_EQ(ours.getCentroidIndex(p), of_pcl.getCentroidIndex(p));
    EXPECT_EQ(ours.getNeighborCentroidIndices(p, around),
              of_pcl.getNeighborCentroidIndices(p, around));
    EXPECT_EQ(ours.getGridCoordinates(p.x, p.y, p.z),
              of_pcl.getGridCoordinates(p.x, p.y, p.z));
  }
  EXPECT_EQ(ours.getCentroidIndexAt({100000, 0, 0}), -1);
}

TEST(LeafGrid, DoesNotOverflowWherePclGivesTheInputBack)
{
  Random random(2);
  const Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < 500; ++i) { // two kilometres of pairs that share a leaf
    Point p;
    p.x = 4.f * i;
    p.y = static_cast<float>(random.uniform(0, 3000));
    p.z = static_cast<float>(random.uniform(0, 300));
    p.intensity = 1;
    p.getVector3fMap() = (p.getVector3fMap() * 16).array().floor() / 16 + 0.01f;
    cloud->push_back(p);
    p.x += 0.02f;
    cloud->push_back(p);
  }
  OctreeReduction<Point> ours;
  pcl::VoxelGrid<Point> of_pcl;
  ours.setLeafSize(0.0625f, 0.0625f, 0.0625f);
  of_pcl.setLeafSize(0.0625f, 0.0625f, 0.0625f);
  EXPECT_EQ(filtered(of_pcl, cloud).size(), 1000u) << "PCL gives up";
  EXPECT_EQ(filtered(ours, cloud).size(), 500u);
}

TEST(LeafGrid, FiltersCloudsWithFieldsThatAreKnownLater)
{
  const Cloud::Ptr cloud = samples();
  const auto blob = pcl::make_shared<pcl::PCLPointCloud2>();
  pcl::toPCLPointCloud2(*cloud, *blob);
  OctreeReduction<pcl::PCLPointCloud2> ours;
  pcl::VoxelGrid<pcl::PCLPointCloud2> of_pcl;
  for (const bool within : {false, true}) {
    const auto run = [&](auto& f) {
      f.setLeafSize(0.3f, 0.3f, 0.2f);
      if (within) {
        f.setFilterFieldName("z");
        f.setFilterLimits(0, 0.5);
      }
      f.setInputCloud(blob);
      pcl::PCLPointCloud2 output;
      f.filter(output);
      Cloud points;
      pcl::fromPCLPointCloud2(output, points);
      return points;
    };
    expectSame(run(ours), run(of_pcl));
  }
}

TEST(LeafGrid, AveragesColoursByChannelAndNumbersByType)
{
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  for (const int grey : {10, 20}) {
    pcl::PointXYZRGB p;
    p.x = p.y = p.z = 0.05f;
    p.r = static_cast<std::uint8_t>(grey);
    p.g = 200;
    p.b = static_cast<std::uint8_t>(2 * grey);
    cloud.push_back(p);
  }
  const auto blob = pcl::make_shared<pcl::PCLPointCloud2>();
  pcl::toPCLPointCloud2(cloud, *blob);
  OctreeReduction<pcl::PCLPointCloud2> ours;
  ours.setLeafSize(1, 1, 1);
  ours.setInputCloud(blob);
  pcl::PCLPointCloud2 output;
  ours.filter(output);
  pcl::PointCloud<pcl::PointXYZRGB> found;
  pcl::fromPCLPointCloud2(output, found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].r, 15);
  EXPECT_EQ(found[0].g, 200);
  EXPECT_EQ(found[0].b, 30);
}

TEST(LeafGrid, RefusesLeavesAndFieldsThatAreNone)
{
  const Cloud::Ptr cloud = samples();
  const auto words = [&](auto change) {
    OctreeReduction<Point> ours;
    ours.setLeafSize(0.1f, 0.1f, 0.1f);
    change(ours);
    return badArgumentOf([&] { filtered(ours, cloud); });
  };
  for (const float side : {0.f, -1.f, kNan})
    EXPECT_NE(words([&](auto& f) { f.setLeafSize(1, side, 1); }).find("leaf size"),
              std::string::npos)
        << side;
  EXPECT_NE(words([](auto& f) { f.setLeafSize(1e-9f, 1, 1); }).find("larger leaves"),
            std::string::npos);
  EXPECT_NE(words([](auto& f) { f.setFilterFieldName("curvature"); }).find("curvature"),
            std::string::npos);
  OctreeReduction<pcl::PCLPointCloud2> of_blob;
  const auto cut = pcl::make_shared<pcl::PCLPointCloud2>();
  pcl::toPCLPointCloud2(*cloud, *cut);
  cut->data.resize(cut->data.size() / 2);
  of_blob.setLeafSize(1, 1, 1);
  of_blob.setInputCloud(cut);
  pcl::PCLPointCloud2 output;
  EXPECT_NE(badArgumentOf([&] { of_blob.filter(output); }).find("bytes"),
            std::string::npos);
}

TEST(LeafGrid, GivesNothingOfCloudsOfNan)
{
  const auto cloud = toCloud<pcl::PointXYZ>(Points(30, {kNan, kNan, kNan}));
  OctreeReduction<pcl::PointXYZ> ours;
  ours.setLeafSize(0.1f, 0.1f, 0.1f);
  ours.setInputCloud(cloud);
  pcl::PointCloud<pcl::PointXYZ> output;
  ours.filter(output);
  EXPECT_TRUE(output.empty());
}
