// SPDX-License-Identifier: BSD-3-Clause
// What the programs of the rows work on. Each of them, NAME.inc, is the body of a test that
// is compiled twice, with CLASS as PCL's class and as ours: the code of somebody who changes
// one name. OURS is defined where the class is ours, for settings that only ours has.
#pragma once

#include "support/pcl_estimation_peers.h"
#include "support/pcl_peers.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>

#include <pcl/PointIndices.h>
#include <pcl/common/transforms.h>
#include <pcl/correspondence.h>
#include <pcl/features/fpfh.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rows {

using Xyz = pcl::PointXYZ;
using XyzNormal = pcl::PointNormal;

constexpr double kNoise = 0.002; // [m]

/** The motion that the programs look for: T_target_source. */
inline Eigen::Isometry3d
motion()
{
  return pcl6d::poseFromEuler({0.05, -0.03, 0.04}, {0.02, -0.015, 0.03});
}

template <typename PointT>
void
setNormal(PointT& point, const Eigen::Vector3f& normal)
{
  if constexpr (pcl::traits::has_normal<PointT>::value)
    point.getNormalVector3fMap() = normal;
}

/** A corner of a room of 3 by 2 by 2 m, with a box in it, every 5 cm; seeds differ in their
 * noise and in where the points lie between. */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
room(int seed)
{
  pcl6d::Random random(seed);
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  const auto add =
      [&](int axis, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        constexpr float kStep = 0.05f;
        for (float a = from[u]; a < to[u]; a += kStep)
          for (float b = from[v]; b < to[v]; b += kStep) {
            Eigen::Vector3f p = from;
            p[u] = a + kStep * static_cast<float>(random.uniform());
            p[v] = b + kStep * static_cast<float>(random.uniform());
            p[axis] += static_cast<float>(kNoise * random.normal());
            PointT point;
            point.getVector3fMap() = p;
            setNormal(point, Eigen::Vector3f::Unit(axis));
            cloud->push_back(point);
          }
      };
  add(0, {0, 0, 0}, {0, 2, 2});
  add(1, {0, 0, 0}, {3, 0, 2});
  add(2, {0, 0, 0}, {3, 2, 0});
  add(0, {1.5f, 0.5f, 0}, {1.5f, 1.1f, 0.7f});
  add(1, {1.5f, 1.1f, 0}, {2.3f, 1.1f, 0.7f});
  add(2, {1.5f, 0.5f, 0.7f}, {2.3f, 1.1f, 0.7f});
  return cloud;
}

template <typename PointT = Xyz>
typename pcl::PointCloud<PointT>::Ptr
target()
{
  return room<PointT>(1);
}

/** Another scan of the same, from elsewhere. */
template <typename PointT = Xyz>
typename pcl::PointCloud<PointT>::Ptr
source()
{
  auto cloud = room<PointT>(2);
  const Eigen::Affine3f back(motion().inverse().matrix().cast<float>());
  for (auto& point : *cloud) {
    point.getVector3fMap() = back * point.getVector3fMap();
    if constexpr (pcl::traits::has_normal<PointT>::value)
      point.getNormalVector3fMap() = back.linear() * point.getNormalVector3fMap();
  }
  return cloud;
}

/** The target's points, moved: pairs that are exact. */
template <typename PointT = Xyz>
typename pcl::PointCloud<PointT>::Ptr
sameMoved()
{
  auto cloud = target<PointT>();
  const Eigen::Affine3f back(motion().inverse().matrix().cast<float>());
  for (auto& point : *cloud) {
    point.getVector3fMap() = back * point.getVector3fMap();
    if constexpr (pcl::traits::has_normal<PointT>::value)
      point.getNormalVector3fMap() = back.linear() * point.getNormalVector3fMap();
  }
  return cloud;
}

/** Expects a pose within a distance [m] of motion(), measured in the middle of the room. */
template <typename Matrix>
void
expectMotion(const Matrix& found, double tolerance)
{
  const Eigen::Vector3d middle(1.5, 1, 1);
  const Eigen::Affine3d pose(found.template cast<double>());
  const Eigen::Isometry3d truth = motion();
  EXPECT_LT((pose * middle - truth * middle).norm(), tolerance);
  EXPECT_LT((pose.linear() - truth.linear()).norm(), tolerance);
}

/** Pair i with i, and every tenth of them with a point far away. */
inline pcl::Correspondences
pairsWithOutliers(std::size_t count)
{
  pcl::Correspondences pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const bool wrong = i % 10 == 3;
    const std::size_t partner = wrong ? (i + count / 2) % count : i;
    pairs.emplace_back(
        static_cast<int>(i), static_cast<int>(partner), wrong ? 1.0f : 1e-4f);
  }
  return pairs;
}

inline bool
isWrong(const pcl::Correspondence& pair)
{
  return pair.index_query != pair.index_match;
}

/** What PCL's coarse alignments ask for. */
inline pcl::PointCloud<pcl::FPFHSignature33>::Ptr
features(const pcl::PointCloud<XyzNormal>::Ptr& cloud)
{
  pcl::FPFHEstimation<XyzNormal, XyzNormal, pcl::FPFHSignature33> estimation;
  estimation.setInputCloud(cloud);
  estimation.setInputNormals(cloud);
  estimation.setRadiusSearch(0.4);
  auto found = pcl::make_shared<pcl::PointCloud<pcl::FPFHSignature33>>();
  estimation.compute(*found);
  return found;
}

/** A depth image of a plane at 2 m, with a lone point 0.5 m nearer. */
inline pcl::PointCloud<Xyz>::Ptr
depthImage()
{
  auto cloud = pcl::make_shared<pcl::PointCloud<Xyz>>(40, 30);
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 40; ++column) {
      Xyz& point = cloud->at(column, row);
      point.z = row == 15 && column == 20 ? 1.5f : 2.0f;
      point.x = 0.01f * static_cast<float>(column - 20) * point.z;
      point.y = 0.01f * static_cast<float>(row - 15) * point.z;
    }
  return cloud;
}

} // namespace rows
