// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"
#include "support/points.h"

#include <pcl6d/filters/pcl/octree_reduction.h>
#include <pcl6d/filters/pcl/range_gate.h>
#include <pcl6d/filters/pcl/scan_line_median.h>
#include <pcl6d/filters/pcl/scan_line_reduction.h>

#include <cstring>

using pcl6d::Points;
using pcl6d::ScanLineMedian;
using pcl6d::ScanLineReduction;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::toCloud;

namespace {
using Point = pcl::PointXYZI;
using Cloud = pcl::PointCloud<Point>;

/** Two lines of seven: a mixed pixel in the first, no echo in the second. */
Cloud::Ptr
twoLines()
{
  auto cloud = toCloud<Point>(Points(14, {5, 0, 0}));
  (*cloud)[3].x = 10;
  (*cloud)[9].x = kNan;
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i].intensity = static_cast<float>(i);
  cloud->is_dense = false;
  cloud->header.frame_id = "scanner";
  return cloud;
}

Cloud::Ptr
organized()
{
  auto cloud = twoLines();
  cloud->width = 7;
  cloud->height = 2;
  return cloud;
}
} // namespace

template <typename Filter>
class LineFilter : public testing::Test {};
using Filters = testing::Types<ScanLineMedian<Point>, ScanLineReduction<Point>>;
TYPED_TEST_SUITE(LineFilter, Filters);

TYPED_TEST(LineFilter, FindsTheLinesOrSaysHowToGiveThem)
{
  TypeParam filter;
  Cloud by_rows, by_length;
  filter.setInputCloud(organized());
  filter.filter(by_rows);
  filter.setInputCloud(twoLines());
  EXPECT_EQ(badArgumentOf([&] { filter.filter(by_length); }),
            "line_length = 0, but must be given by setLineLength(): the cloud is not "
            "organized (height 1)");
  filter.setLineLength(7);
  filter.filter(by_length);
  ASSERT_EQ(by_length.size(), by_rows.size());
  for (std::size_t i = 0; i < by_rows.size(); ++i)
    if (!std::isnan(by_rows[i].x)) {
      EXPECT_EQ(by_length[i].getVector4fMap(), by_rows[i].getVector4fMap());
    }
  filter.setLineLength(6);
  filter.setInputCloud(organized());
  EXPECT_EQ(badArgumentOf([&] { filter.filter(by_rows); }),
            "line_length = 6, but must be the width of the organized cloud, 7");
}

TYPED_TEST(LineFilter, RefusesBadLinesAndIndices)
{
  TypeParam filter;
  for (const int bad : {0, -360})
    EXPECT_EQ(badArgumentOf([&] { filter.setLineLength(bad); }),
              "line_length = " + std::to_string(bad) + ", but must be > 0");
  Cloud output;
  auto broken = organized();
  broken->height = 3;
  filter.setInputCloud(broken);
  EXPECT_NE(badArgumentOf([&] { filter.filter(output); }).find("7 x 3"),
            std::string::npos);
  filter.setInputCloud(organized());
  for (const int bad : {-1, 14}) {
    filter.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{3, bad}));
    EXPECT_EQ(badArgumentOf([&] { filter.filter(output); }),
              "index = " + std::to_string(bad) +
                  ", but must be >= 0 and below the number of points, 14");
  }
}

TYPED_TEST(LineFilter, TakesNoCloudAndEmptyCloudsAsPclDoes)
{
  TypeParam filter;
  Cloud output = *twoLines();
  filter.filter(output); // PCL complains and does nothing
  EXPECT_EQ(output.size(), 14u);
  filter.setInputCloud(pcl::make_shared<Cloud>());
  filter.filter(output);
  EXPECT_TRUE(output.empty());
}

TEST(ScanLineMedian, TouchesOnlyTheMixedPixel)
{
  const auto cloud = organized();
  ScanLineMedian<Point> median;
  median.setInputCloud(cloud);
  Cloud output;
  median.filter(output);
  Cloud expected = *cloud;
  expected[3].x = 5;
  ASSERT_EQ(output.size(), expected.size());
  EXPECT_EQ(std::memcmp(&output[0], &expected[0], sizeof(Point) * output.size()), 0);
  EXPECT_EQ(output.width, 7u);
  EXPECT_EQ(output.height, 2u);
  EXPECT_EQ(output.is_dense, false);
  EXPECT_EQ(output.header.frame_id, "scanner");
  median.filter(*cloud); // in place
  EXPECT_EQ((*cloud)[3].x, 5);
  EXPECT_EQ(cloud->width, 7u);
}

TEST(ScanLineMedian, MovesOnlyChosenPointsButLooksAtAll)
{
  ScanLineMedian<Point> median;
  median.setInputCloud(organized());
  Cloud output;
  median.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, 1, 9}));
  median.filter(output);
  EXPECT_EQ(output[3].x, 10);
  EXPECT_EQ(output.size(), 14u);
  median.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{3}));
  median.filter(output);
  EXPECT_EQ(output[3].x, 5);
}

TEST(ScanLineMedian, RefusesBadOptionsAndLeavesTheOutput)
{
  ScanLineMedian<Point> median;
  median.setInputCloud(organized());
  median.options().window = 4;
  Cloud output = *twoLines();
  EXPECT_THROW(median.filter(output), pcl6d::BadArgument);
  EXPECT_EQ(output.size(), 14u);
}

TEST(ScanLineReduction, AveragesPlacesAndFields)
{
  ScanLineReduction<Point> reduction;
  reduction.setInputCloud(organized());
  Cloud output;
  reduction.filter(output);
  ASSERT_EQ(output.size(), 4u); // 0-2, the mixed pixel, 4-6, and the second line
  const std::vector<float> x{5, 10, 5, 5},
      intensity{1, 3, 5, (7 + 8 + 10 + 11 + 12 + 13) / 6.0f};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(output[i].x, x[i]);
    EXPECT_FLOAT_EQ(output[i].intensity, intensity[i]);
  }
  EXPECT_TRUE(output.is_dense);
  EXPECT_EQ(output.width, 4u);
  EXPECT_EQ(output.height, 1u);
  EXPECT_EQ(output.header.frame_id, "scanner");
}

TEST(ScanLineReduction, TakesChosenPointsOnceInTheOrderOfTheLine)
{
  ScanLineReduction<Point> reduction;
  reduction.setInputCloud(organized());
  reduction.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{13, 4, 0, 4, 9}));
  Cloud output;
  reduction.filter(output);
  ASSERT_EQ(output.size(), 2u); // 0 and 4, which were apart but for the mixed pixel; 13
  EXPECT_EQ(output[0].intensity, 2);
  EXPECT_EQ(output[1].intensity, 13);
}

TEST(ScanLineReduction, TakesEachNthLine)
{
  ScanLineReduction<Point> reduction;
  reduction.setInputCloud(organized());
  reduction.setLineStep(2);
  EXPECT_THROW(reduction.setLineStep(0), pcl6d::BadArgument);
  Cloud output;
  reduction.filter(output);
  EXPECT_EQ(output.size(), 3u) << "the step stays 2";
}

TEST(Filters, RefuseIndicesThatAreNotOfTheCloud)
{
  pcl6d::OctreeReduction<Point> octree;
  pcl6d::RangeGate<Point> gate;
  for (pcl::Filter<Point>* filter : {static_cast<pcl::Filter<Point>*>(&octree),
                                     static_cast<pcl::Filter<Point>*>(&gate)}) {
    filter->setInputCloud(twoLines());
    filter->setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, 14}));
    Cloud output;
    EXPECT_THROW(filter->filter(output), pcl6d::BadArgument);
  }
}
