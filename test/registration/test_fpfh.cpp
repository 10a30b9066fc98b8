// SPDX-License-Identifier: BSD-3-Clause
// Fast point feature histograms, with PCL's as oracle.
#include "coarse/fpfh.h"

#include <pcl6d/common/random.h>

#include <pcl/features/fpfh.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace {
using pcl6d::Normals;
using pcl6d::Points;
using pcl6d::PointTree;
using pcl6d::Random;
using pcl6d::registration::computeFpfh;
using pcl6d::registration::FeatureScan;
using pcl6d::registration::Fpfh;
using pcl6d::registration::kFpfhSize;

FeatureScan
scanOf(const Points& points, const Normals& normals)
{
  return {points, normals, PointTree(points)};
}

/** Points on a wavy floor and on a ball, with their normals. */
FeatureScan
hillsAndBall(std::size_t count = 2000)
{
  Random random(5);
  Points points;
  Normals normals;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(random.uniform(-3, 3));
    const auto y = static_cast<float>(random.uniform(-3, 3));
    if (i % 2 == 0) {
      points.emplace_back(x, y, 0.2f * std::sin(2 * x));
      normals.push_back(Eigen::Vector3f(-0.4f * std::cos(2 * x), 0, 1).normalized());
    }
    else {
      normals.push_back(Eigen::Vector3f(x, y, static_cast<float>(random.uniform(-3, 3)))
                            .normalized());
      points.push_back(Eigen::Vector3f(0.2f, 0.4f, 1.1f) + normals.back());
    }
  }
  return scanOf(points, normals);
}

float
sumOf(const Fpfh& feature, std::size_t third)
{
  const auto begin = feature.begin() + static_cast<std::ptrdiff_t>(third * 11);
  return std::accumulate(begin, begin + 11, 0.f);
}

float
difference(const Fpfh& a, const float* b)
{
  float sum = 0;
  for (std::size_t i = 0; i < kFpfhSize; ++i)
    sum += std::abs(a[i] - b[i]);
  return sum;
}
} // namespace

TEST(Fpfh, AreThoseOfPcl)
{
  const FeatureScan scan = hillsAndBall();
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  const auto normals = std::make_shared<pcl::PointCloud<pcl::Normal>>();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    cloud->emplace_back(scan.points[i].x(), scan.points[i].y(), scan.points[i].z());
    normals->emplace_back(
        scan.normals[i].x(), scan.normals[i].y(), scan.normals[i].z());
  }
  pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal> peer;
  peer.setInputCloud(cloud);
  peer.setInputNormals(normals);
  peer.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  peer.setRadiusSearch(0.5);
  pcl::PointCloud<pcl::FPFHSignature33> expected;
  peer.compute(expected);
  const auto features = computeFpfh(scan, 0.5, 1);
  ASSERT_EQ(features.size(), expected.size());
  float total = 0; // an angle at the limit of a bin may round to either side
  for (std::size_t i = 0; i < features.size(); ++i) {
    const float one = difference(features[i], expected[i].histogram);
    EXPECT_LT(one, 3) << i; // of 600, if nothing agreed
    total += one;
  }
  EXPECT_LT(total / static_cast<float>(features.size()), 0.02f);
}

TEST(Fpfh, EachAngleSumsUpToAHundredForAnyNumberOfThreads)
{
  const FeatureScan scan = hillsAndBall();
  const auto features = computeFpfh(scan, 0.5, 1);
  for (const auto& feature : features)
    for (std::size_t third = 0; third < 3; ++third)
      EXPECT_NEAR(sumOf(feature, third), 100, 1e-3);
  EXPECT_EQ(computeFpfh(scan, 0.5, 3), features);
}

TEST(Fpfh, StayWhereTheScanIsMoved)
{
  const FeatureScan scan = hillsAndBall();
  const Eigen::Isometry3f T =
      Eigen::Translation3f(1, 2, 3) *
      Eigen::AngleAxisf(0.7f, Eigen::Vector3f(1, 2, -1).normalized());
  Points points;
  Normals normals;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    points.push_back(T * scan.points[i]);
    normals.push_back(T.linear() * scan.normals[i]);
  }
  const auto before = computeFpfh(scan, 0.5, 1);
  const auto after = computeFpfh(scanOf(points, normals), 0.5, 1);
  float total = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    total += difference(before[i], after[i].data());
  EXPECT_LT(total / static_cast<float>(before.size()), 0.1f);
}

TEST(Fpfh, WhatHasNoSurroundingsIsZero)
{
  const Fpfh zero{};
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ(), none = Eigen::Vector3f::Zero();
  const auto features = [](const Points& points, const Normals& normals) {
    return computeFpfh(scanOf(points, normals), 0.5, 1);
  };
  EXPECT_TRUE(features({}, {}).empty());
  EXPECT_EQ(features({{1, 2, 3}}, {up}), std::vector<Fpfh>{zero});
  EXPECT_EQ(features({{1, 2, 3}, {1, 2, 3}}, {up, up}), std::vector<Fpfh>(2, zero));
  EXPECT_EQ(features({{0, 0, 0}, {0.1f, 0, 0}}, {up, none}),
            std::vector<Fpfh>(2, zero));
  // both normals along the line between the points: no frame
  EXPECT_EQ(features({{0, 0, 0}, {0, 0, 0.1f}}, {up, up}), std::vector<Fpfh>(2, zero));
}
