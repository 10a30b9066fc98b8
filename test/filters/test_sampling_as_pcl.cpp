// SPDX-License-Identifier: BSD-3-Clause
// ApproximateVoxelGrid and UniformSampling beside PCL's classes of these names: the same cases
// for both, and where PCL's answer is another one, why.
#include "support/clouds.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/filters/pcl/approximate_voxel_grid.h>
#include <pcl6d/filters/pcl/octree_reduction.h>
#include <pcl6d/filters/pcl/uniform_sampling.h>

#include <pcl/filters/approximate_voxel_grid.h>
#include <pcl/filters/uniform_sampling.h>

#include <map>
#include <set>
#include <tuple>

using pcl6d::Points;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::sorted;
using pcl6d::test::toCloud;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

Points
randomPoints(std::size_t count, double extent, std::uint64_t seed)
{
  Random random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(Eigen::Vector3d(random.uniform(-extent, extent),
                                     random.uniform(-extent, extent),
                                     random.uniform(-extent, extent))
                         .cast<float>());
  return points;
}

template <typename Filter, typename PointT>
pcl::PointCloud<PointT>
filtered(Filter& filter, const typename pcl::PointCloud<PointT>::Ptr& cloud)
{
  pcl::PointCloud<PointT> output;
  filter.setInputCloud(cloud);
  filter.filter(output);
  return output;
}

/** \return the cell of a point, as PCL counts */
std::tuple<float, float, float>
cellOf(const Eigen::Vector3f& p, float side)
{
  const Eigen::Array3f cell = (p.array() * (1 / side)).floor();
  return {cell[0], cell[1], cell[2]};
}

template <typename Filter>
class ApproximateGrid : public testing::Test {};
using Grids = testing::Types<pcl::ApproximateVoxelGrid<Point>,
                             pcl6d::ApproximateVoxelGrid<Point>>;
TYPED_TEST_SUITE(ApproximateGrid, Grids);

template <typename Filter>
class Sampling : public testing::Test {};
using Samplings =
    testing::Types<pcl::UniformSampling<Point>, pcl6d::UniformSampling<Point>>;
TYPED_TEST_SUITE(Sampling, Samplings);
} // namespace

TYPED_TEST(ApproximateGrid, HasPclsSettings)
{
  TypeParam grid;
  EXPECT_EQ(grid.getLeafSize(), Eigen::Vector3f::Ones());
  EXPECT_TRUE(grid.getDownsampleAllData());
  grid.setLeafSize(1, 2, 3);
  EXPECT_EQ(grid.getLeafSize(), Eigen::Vector3f(1, 2, 3));
  grid.setLeafSize(Eigen::Vector3f(0.5f, 0.25f, 1));
  EXPECT_EQ(grid.getLeafSize(), Eigen::Vector3f(0.5f, 0.25f, 1));
  grid.setDownsampleAllData(false);
  EXPECT_FALSE(grid.getDownsampleAllData());
}

TYPED_TEST(ApproximateGrid, AveragesPointsThatComeLeafByLeaf)
{
  Points points, means;
  for (int x = 0; x < 20; ++x) {
    means.push_back({static_cast<float>(x) + 0.5f, 0.5f, 0.25f});
    for (const float d : {-0.25f, 0.25f})
      points.push_back(means.back() + Eigen::Vector3f(d, d, 0));
  }
  TypeParam grid;
  const Cloud found = filtered<TypeParam, Point>(grid, toCloud<Point>(points));
  EXPECT_EQ(found.height, 1u);
  EXPECT_EQ(found.width, found.size());
  pcl6d::test::expectSamePoints(sorted(pcl6d::toPoints(found)), sorted(means));
}

TEST(ApproximateVoxelGrid, GivesOnePointALeafWherePclGivesSeveral)
{
  const Cloud::Ptr cloud = toCloud<Point>(randomPoints(20000, 4, 1));
  std::set<std::tuple<float, float, float>> leaves;
  for (const auto& p : *cloud)
    leaves.insert(cellOf(p.getVector3fMap(), 0.5f));
  pcl6d::ApproximateVoxelGrid<Point> ours;
  pcl::ApproximateVoxelGrid<Point> of_pcl;
  ours.setLeafSize(0.5f, 0.5f, 0.5f);
  of_pcl.setLeafSize(0.5f, 0.5f, 0.5f);
  const Cloud found = filtered<decltype(ours), Point>(ours, cloud);
  EXPECT_EQ(found.size(), leaves.size());
  EXPECT_TRUE(found.is_dense);
  EXPECT_GT((filtered<decltype(of_pcl), Point>(of_pcl, cloud).size()),
            2 * leaves.size())
      << "PCL throws leaves out where hashes collide";
  pcl6d::OctreeReduction<Point> reduction;
  reduction.setLeafSize(0.5f, 0.5f, 0.5f);
  pcl6d::test::expectSamePoints(
      pcl6d::toPoints(found),
      pcl6d::toPoints(filtered<decltype(reduction), Point>(reduction, cloud)));
}

TEST(ApproximateVoxelGrid, AveragesFieldsUnlessToldNotTo)
{
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  for (const float i : {10.f, 20.f, 60.f}) {
    pcl::PointXYZI p;
    p.x = p.y = p.z = 0.5f;
    p.intensity = i;
    cloud->push_back(p);
  }
  pcl6d::ApproximateVoxelGrid<pcl::PointXYZI> grid;
  pcl::PointCloud<pcl::PointXYZI> found;
  grid.setInputCloud(cloud);
  grid.filter(found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FLOAT_EQ(found[0].intensity, 30);
  grid.setDownsampleAllData(false);
  grid.filter(found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].intensity, 0) << "what was there before is not taken over";
  EXPECT_EQ(found[0].x, 0.5f);
}

TEST(ApproximateVoxelGrid, CountsOnlyChosenPointsThatAreFinite)
{
  const Cloud::Ptr cloud = toCloud<Point>(
      {{0.5f, 0.5f, 0.5f}, {kNan, 0, 0}, {5, 5, kInfinity}, {3.5f, 0, 0}});
  pcl6d::ApproximateVoxelGrid<Point> grid;
  EXPECT_EQ((filtered<decltype(grid), Point>(grid, cloud).size()), 2u);
  grid.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{1, 2, 3}));
  const Cloud found = filtered<decltype(grid), Point>(grid, cloud);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].x, 3.5f);
}

TEST(ApproximateVoxelGrid, RefusesLeavesAndIndicesThatAreNone)
{
  const Cloud::Ptr cloud = toCloud<Point>(randomPoints(10, 1, 2));
  pcl6d::ApproximateVoxelGrid<Point> grid;
  for (const float side : {0.f, -1.f, kNan, kInfinity}) {
    grid.setLeafSize(1, 1, side);
    EXPECT_NE(badArgumentOf([&] {
                filtered<decltype(grid), Point>(grid, cloud);
              }).find("leaf size"),
              std::string::npos);
  }
  grid.setLeafSize(1, 1, 1);
  grid.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{10}));
  EXPECT_NE(badArgumentOf([&] {
              filtered<decltype(grid), Point>(grid, cloud);
            }).find("index"),
            std::string::npos);
}

TEST(LeafCells, HoldAThousandKilometresOfMillimetres)
{
  // Cells of every kind of grid: those that bits are counted of at once, those with most
  // blocks left out first, and those with more cells than 32 bits number.
  for (const double extent : {0.1, 3.0, 800.0, 1e6}) {
    const Points points = randomPoints(3000, extent, 3);
    std::map<std::tuple<float, float, float>, Eigen::Vector3d> sums;
    std::map<std::tuple<float, float, float>, int> counts;
    for (const auto& p : points) {
      sums.try_emplace(cellOf(p, 0.001f), Eigen::Vector3d::Zero()).first->second +=
          p.cast<double>();
      ++counts[cellOf(p, 0.001f)];
    }
    Points expected;
    for (const auto& [cell, sum] : sums)
      expected.push_back((sum / counts[cell]).cast<float>());
    pcl6d::ApproximateVoxelGrid<Point> grid;
    grid.setLeafSize(0.001f, 0.001f, 0.001f);
    const Cloud found = filtered<decltype(grid), Point>(grid, toCloud<Point>(points));
    SCOPED_TRACE(extent);
    pcl6d::test::expectSamePoints(sorted(pcl6d::toPoints(found)), sorted(expected));
  }
}

TEST(LeafCells, ComeWithXFastest)
{
  for (const double extent : {0.1, 3.0, 800.0, 1e6}) {
    const Points points = randomPoints(3000, extent, 4);
    const pcl6d::LeafCells cells(pcl6d::viewOf(points), {0.001f, 0.001f, 0.001f});
    const pcl6d::LeafOrder order(pcl6d::viewOf(points), cells);
    const pcl6d::LeafGroups groups(order);
    ASSERT_EQ(groups.size(), order.size());
    std::size_t members = 0;
    Eigen::Vector3i last = Eigen::Vector3i::Constant(std::numeric_limits<int>::min());
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const Eigen::Vector3i cell =
          cells.cellOf(points[static_cast<std::size_t>(*groups.indices(g).begin())]);
      EXPECT_LT(std::make_tuple(last.z(), last.y(), last.x()),
                std::make_tuple(cell.z(), cell.y(), cell.x()));
      last = cell;
      for (const auto i : groups.indices(g)) {
        EXPECT_EQ(order.ranks()[static_cast<std::size_t>(i)], g);
        EXPECT_EQ(cells.cellOf(points[static_cast<std::size_t>(i)]), cell);
      }
      members += groups.indices(g).size();
    }
    EXPECT_EQ(members, points.size());
  }
}

TYPED_TEST(Sampling, KeepsThePointNearestToTheCentre)
{
  const Points points{{0.2f, 0.5f, 0.5f},
                      {0.6f, 0.5f, 0.5f},
                      {0.9f, 0.9f, 0.9f},
                      {2.1f, 0.5f, 0.5f},
                      {-0.5f, -0.4f, -0.5f}};
  TypeParam sampling(true);
  sampling.setRadiusSearch(1);
  const Cloud found = filtered<TypeParam, Point>(sampling, toCloud<Point>(points));
  EXPECT_EQ(found.height, 1u);
  EXPECT_TRUE(found.is_dense);
  pcl6d::test::expectSamePoints(sorted(pcl6d::toPoints(found)),
                                sorted({points[1], points[3], points[4]}));
  const auto removed = *sampling.getRemovedIndices();
  EXPECT_EQ(std::set<int>(removed.begin(), removed.end()), (std::set<int>{0, 2}));
}

TYPED_TEST(Sampling, KeepsOnePointACubeAndTellsOfAllOthers)
{
  const Cloud::Ptr cloud = toCloud<Point>(randomPoints(10000, 1, 5));
  std::set<std::tuple<float, float, float>> cubes, sampled;
  for (const auto& p : *cloud)
    cubes.insert(cellOf(p.getVector3fMap(), 0.2f));
  TypeParam sampling(true);
  sampling.setRadiusSearch(0.2);
  const Cloud found = filtered<TypeParam, Point>(sampling, cloud);
  for (const auto& p : found)
    sampled.insert(cellOf(p.getVector3fMap(), 0.2f));
  EXPECT_EQ(found.size(), cubes.size());
  EXPECT_EQ(sampled, cubes);
  EXPECT_EQ(found.size() + sampling.getRemovedIndices()->size(), cloud->size());
}

TYPED_TEST(Sampling, PassesOverPointsThatAreNotFinite)
{
  const Cloud::Ptr cloud = toCloud<Point>({{kNan, 0, 0}, {0.5f, 0.5f, 0.5f}});
  TypeParam sampling(true);
  sampling.setRadiusSearch(1);
  EXPECT_EQ((filtered<TypeParam, Point>(sampling, cloud).size()), 1u);
  EXPECT_EQ(*sampling.getRemovedIndices(), (pcl::Indices{0}));
}

TEST(UniformSampling, IsExactInCubesOfMillimetresWherePclKeepsTheFirst)
{
  Points points; // offsets from the centres of cubes: each second point is nearer
  for (int i = 0; i < 50; ++i) {
    const float centre = (static_cast<float>(i) + 0.5f) * 1e-4f;
    points.push_back({centre + 4e-5f, centre, centre});
    points.push_back({centre + 1e-5f, centre, centre});
  }
  const Cloud::Ptr cloud = toCloud<Point>(points);
  pcl6d::UniformSampling<Point> ours;
  pcl::UniformSampling<Point> of_pcl;
  ours.setRadiusSearch(1e-4);
  of_pcl.setRadiusSearch(1e-4);
  EXPECT_EQ(ours.getRadiusSearch(), 1e-4);
  pcl::Indices kept;
  ours.setInputCloud(cloud);
  ours.filter(kept);
  ASSERT_EQ(kept.size(), 50u);
  for (std::size_t i = 0; i < kept.size(); ++i)
    EXPECT_EQ(kept[i], static_cast<int>(2 * i + 1));
  std::size_t firsts = 0;
  for (const auto& p : filtered<decltype(of_pcl), Point>(of_pcl, cloud))
    for (std::size_t i = 0; i < points.size(); i += 2)
      firsts += p.getVector3fMap() == points[i];
  EXPECT_GT(firsts, 40u) << "PCL's squares are of float and lie above 1";
}

TEST(UniformSampling, WorksAsAFilterOfIndices)
{
  const Cloud::Ptr cloud = toCloud<Point>(
      {{0.1f, 0, 0}, {0.5f, 0.5f, 0.5f}, {kNan, 0, 0}, {1.5f, 0.5f, 0.5f}});
  pcl6d::UniformSampling<Point> sampling(true);
  sampling.setRadiusSearch(1);
  sampling.setInputCloud(cloud);
  pcl::Indices kept;
  sampling.filter(kept);
  EXPECT_EQ(kept, (pcl::Indices{1, 3}));
  sampling.setNegative(true);
  sampling.filter(kept);
  EXPECT_EQ(kept, (pcl::Indices{0}));
  sampling.setNegative(false);
  sampling.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{3, 0}));
  sampling.filter(kept);
  EXPECT_EQ(kept, (pcl::Indices{3, 0}));
  sampling.setKeepOrganized(true);
  Cloud same_size;
  sampling.filter(same_size);
  EXPECT_EQ(same_size.size(), cloud->size());
}

TEST(UniformSampling, KeepsTheFirstOfPointsThatAreEquallyNear)
{
  const Cloud::Ptr cloud =
      toCloud<Point>({{0.25f, 0.5f, 0.5f}, {0.75f, 0.5f, 0.5f}, {0.5f, 0.25f, 0.5f}});
  pcl6d::UniformSampling<Point> sampling;
  sampling.setRadiusSearch(1);
  sampling.setInputCloud(cloud);
  pcl::Indices kept;
  sampling.filter(kept);
  EXPECT_EQ(kept, (pcl::Indices{0}));
}

TEST(UniformSampling, DoesNotOverflowWherePclMergesCubes)
{
  Points points; // 1e6 m along each axis, one point in each of 1000 cubes
  for (int i = 0; i < 1000; ++i)
    points.push_back(Eigen::Vector3f(1, 1, 1) *
                     (1000.f * static_cast<float>(i) + 0.25f));
  pcl6d::UniformSampling<Point> sampling;
  sampling.setRadiusSearch(1);
  EXPECT_EQ(
      (filtered<decltype(sampling), Point>(sampling, toCloud<Point>(points)).size()),
      1000u);
}

TEST(UniformSampling, RefusesWhatItCannotUse)
{
  const Cloud::Ptr cloud = toCloud<Point>(randomPoints(10, 1, 6));
  pcl6d::UniformSampling<Point> sampling;
  const auto words = [&] {
    return badArgumentOf([&] { filtered<decltype(sampling), Point>(sampling, cloud); });
  };
  EXPECT_NE(words().find("leaf size"), std::string::npos) << "it was not set";
  sampling.setRadiusSearch(-1);
  EXPECT_NE(words().find("leaf size"), std::string::npos);
  sampling.setRadiusSearch(1e-10);
  EXPECT_NE(words().find("larger leaves"), std::string::npos);
  sampling.setRadiusSearch(1);
  sampling.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{-1}));
  EXPECT_NE(words().find("index"), std::string::npos);
}

TEST(UniformSampling, GivesNothingOfNothing)
{
  pcl6d::UniformSampling<Point> sampling;
  sampling.setRadiusSearch(1);
  EXPECT_TRUE(
      (filtered<decltype(sampling), Point>(sampling, toCloud<Point>({})).empty()));
  EXPECT_TRUE((filtered<decltype(sampling), Point>(
                   sampling, toCloud<Point>(Points(9, {kNan, 0, 0})))
                   .empty()));
}
