// SPDX-License-Identifier: BSD-3-Clause
// MedianFilter beside pcl::MedianFilter: the same depths, also at borders and gaps, but for
// what PCL's class does not define.
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/filters/pcl/median_filter.h>

#include <pcl/filters/median_filter.h>

#include <cstring>

using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;

namespace {
using Point = pcl::PointXYZI;
using Cloud = pcl::PointCloud<Point>;

/** An inclined plane seen by a camera, with noise and gaps. */
Cloud::Ptr
depthImage(std::uint32_t width, std::uint32_t height, double noise, double gaps)
{
  Random random(1);
  const Cloud::Ptr cloud(new Cloud(width, height));
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      Point& p = (*cloud)(x, y);
      p.x = 0.25f * static_cast<float>(x);
      p.y = 0.25f * static_cast<float>(y);
      p.z = 1 + p.x + 0.5f * p.y + static_cast<float>(noise * random.normal());
      p.intensity = static_cast<float>(x + y);
      if (random.uniform(0, 1) < gaps)
        p.x = p.y = p.z = kNan;
    }
  cloud->is_dense = gaps == 0;
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

bool
haveSameBits(const Cloud& a, const Cloud& b)
{
  return a.size() == b.size() &&
         std::memcmp(a.points.data(), b.points.data(), a.size() * sizeof(Point)) == 0;
}

template <typename Filter>
class MedianOf : public testing::Test {};
using Filters = testing::Types<pcl::MedianFilter<Point>, pcl6d::MedianFilter<Point>>;
TYPED_TEST_SUITE(MedianOf, Filters);
} // namespace

TYPED_TEST(MedianOf, HasPclsSettings)
{
  TypeParam filter;
  EXPECT_EQ(filter.getWindowSize(), 5);
  EXPECT_EQ(filter.getMaxAllowedMovement(), std::numeric_limits<float>::max());
  filter.setWindowSize(7);
  filter.setMaxAllowedMovement(0.5f);
  EXPECT_EQ(filter.getWindowSize(), 7);
  EXPECT_EQ(filter.getMaxAllowedMovement(), 0.5f);
}

TYPED_TEST(MedianOf, RemovesSpikesAndMovesNothingElse)
{
  const Cloud::Ptr cloud(new Cloud(7, 5));
  for (auto& p : *cloud)
    p.z = 2;
  (*cloud)(3, 2).z = 9;
  (*cloud)(0, 0).z = -4;
  TypeParam filter;
  filter.setWindowSize(3);
  const Cloud found = filtered(filter, cloud);
  EXPECT_EQ(found.width, 7u);
  EXPECT_EQ(found.height, 5u);
  for (const auto& p : found)
    EXPECT_EQ(p.z, 2);
}

TYPED_TEST(MedianOf, MovesNoPointTooFar)
{
  const Cloud::Ptr cloud(new Cloud(5, 5));
  (*cloud)(2, 2).z = 3;
  (*cloud)(0, 4).z = -3;
  TypeParam filter;
  filter.setMaxAllowedMovement(0.5f);
  const Cloud found = filtered(filter, cloud);
  EXPECT_EQ(found(2, 2).z, 2.5f);
  EXPECT_EQ(found(0, 4).z, -2.5f);
  EXPECT_EQ(found(1, 1).z, 0);
}

TEST(MedianFilter, GivesWhatPclGives)
{
  for (const int window : {1, 2, 3, 5, 8, 13, 17})
    for (const double gaps : {0.0, 0.02, 0.7, 1.0}) {
      const Cloud::Ptr cloud = depthImage(45, 31, 0.2, gaps);
      pcl6d::MedianFilter<Point> ours;
      pcl::MedianFilter<Point> of_pcl;
      ours.setWindowSize(window);
      of_pcl.setWindowSize(window);
      SCOPED_TRACE(testing::Message() << "window " << window << ", gaps " << gaps);
      const Cloud found = filtered(ours, cloud), expected = filtered(of_pcl, cloud);
      EXPECT_TRUE(haveSameBits(found, expected));
      EXPECT_EQ(found.is_dense, expected.is_dense);
    }
}

TEST(MedianFilter, TakesWindowsLargerThanTheImage)
{
  const Cloud::Ptr cloud = depthImage(6, 4, 0.2, 0.1);
  pcl6d::MedianFilter<Point> ours;
  pcl::MedianFilter<Point> of_pcl;
  ours.setWindowSize(99);
  of_pcl.setWindowSize(99);
  const Cloud expected = filtered(of_pcl, cloud);
  EXPECT_TRUE(haveSameBits(filtered(ours, cloud), expected));
  ours.setWindowSize(2000000000);
  EXPECT_TRUE(haveSameBits(filtered(ours, cloud), expected));
}

TEST(MedianFilter, LeavesPointsWhereTheyAreIfNoneMayMove)
{
  const Cloud::Ptr cloud = depthImage(20, 20, 0.2, 0);
  pcl6d::MedianFilter<Point> ours;
  pcl::MedianFilter<Point> of_pcl;
  ours.setMaxAllowedMovement(0);
  of_pcl.setMaxAllowedMovement(0);
  EXPECT_TRUE(haveSameBits(filtered(ours, cloud), *cloud));
  std::size_t num_nan = 0;
  for (const auto& p : filtered(of_pcl, cloud))
    num_nan += std::isnan(p.z);
  EXPECT_GT(num_nan, 0u) << "PCL divides 0 by 0 where a point is the median";
}

TEST(MedianFilter, KeepsInclinedPlanesUpToBordersAndGapsIfSymmetric)
{
  const Cloud::Ptr cloud = depthImage(40, 30, 0, 0.1);
  pcl6d::MedianFilter<Point> filter;
  EXPECT_FALSE(filter.getSymmetric());
  EXPECT_FALSE(haveSameBits(filtered(filter, cloud), *cloud))
      << "PCL's window bends it";
  filter.setSymmetric(true);
  EXPECT_TRUE(filter.getSymmetric());
  EXPECT_TRUE(haveSameBits(filtered(filter, cloud), *cloud));
  (*cloud)(20, 0).getVector3fMap() = Eigen::Vector3f(5, 0, 36); // 30 above the plane
  EXPECT_NEAR(filtered(filter, cloud)(20, 0).z, 6, 1) << "a spike at the border goes";
}

TEST(MedianFilter, MovesOnlyChosenPoints)
{
  const Cloud::Ptr cloud = depthImage(20, 20, 0.2, 0.05);
  pcl6d::MedianFilter<Point> filter;
  const Cloud all = filtered(filter, cloud);
  filter.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{7, 50}));
  const Cloud some = filtered(filter, cloud);
  Cloud expected = *cloud;
  for (const std::size_t i : {7, 50})
    expected[i].z = all[i].z;
  EXPECT_TRUE(haveSameBits(some, expected));
}

TEST(MedianFilter, GivesTheSameBitsForAnyNumberOfThreads)
{
  const Cloud::Ptr cloud = depthImage(61, 47, 0.2, 0.1);
  pcl6d::MedianFilter<Point> filter;
  filter.setNumberOfThreads(1);
  const Cloud expected = filtered(filter, cloud);
  for (const unsigned int threads : {2u, 3u, 8u}) {
    filter.setNumberOfThreads(threads);
    EXPECT_TRUE(haveSameBits(filtered(filter, cloud), expected)) << threads;
  }
}

TEST(MedianFilter, RefusesWhatItCannotUse)
{
  pcl6d::MedianFilter<Point> filter;
  const Cloud::Ptr image = depthImage(5, 5, 0, 0);
  const auto words = [&](const Cloud::Ptr& cloud) {
    return badArgumentOf([&] { filtered(filter, cloud); });
  };
  EXPECT_NE(words(depthImage(25, 1, 0, 0)).find("organized"), std::string::npos);
  EXPECT_TRUE(filtered(filter, Cloud::Ptr(new Cloud)).empty());
  for (const int window : {0, -3}) {
    filter.setWindowSize(window);
    EXPECT_NE(words(image).find("window size"), std::string::npos);
  }
  filter.setWindowSize(3);
  for (const float movement : {-1.f, kNan}) {
    filter.setMaxAllowedMovement(movement);
    EXPECT_NE(words(image).find("movement"), std::string::npos);
  }
  filter.setMaxAllowedMovement(1);
  filter.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{25}));
  EXPECT_NE(words(image).find("index"), std::string::npos);
}
