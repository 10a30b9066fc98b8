// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/bits.h"
#include "support/clouds.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/registration/pcl/icp6d.h>

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>

namespace pcl6d::test {

template <typename PointT>
using CloudPtr = typename pcl::PointCloud<PointT>::Ptr;

const Eigen::Isometry3d kCornerTruth = ///< from cornerData() to cornerModel()
    poseFromEuler({0.02, -0.015, 0.01}, {0.005, -0.004, 0.006});
constexpr double kExactTol =
    2e-6; ///< [m], [rad] copies, rounded to float once or twice

/** \return a cloud of a roomCorner(), with the normals of its walls if the type has them
 */
template <typename PointT>
CloudPtr<PointT>
cornerCloud(const Points& points,
            const Eigen::Isometry3d& T = Eigen::Isometry3d::Identity())
{
  auto cloud = toCloud<PointT>(transformed(points, T));
  if constexpr (pcl::traits::has_normal<PointT>::value)
    for (std::size_t i = 0; i < cloud->size(); ++i)
      (*cloud)[i].getNormalVector3fMap() =
          T.linear().col(2 - static_cast<int>(i % 3)).template cast<float>();
  return cloud;
}

inline Points
cornerPoints(std::uint64_t seed = 1, std::size_t count = 1998, double sigma = 0.002)
{
  Random random(seed);
  return roomCorner(random, count, 4, sigma);
}

/** \return three walls that meet in the origin */
template <typename PointT>
CloudPtr<PointT>
cornerModel(std::uint64_t seed = 1)
{
  return cornerCloud<PointT>(cornerPoints(seed));
}

/** \return a moved copy of cornerModel() */
template <typename PointT>
CloudPtr<PointT>
cornerData(std::uint64_t seed = 1)
{
  return cornerCloud<PointT>(cornerPoints(seed), kCornerTruth.inverse());
}

/** \return cornerData() with every tenth point off by 0.2 m from all walls, and with its
 * normal turned */
template <typename PointT>
CloudPtr<PointT>
outlierData()
{
  const auto cloud = cornerData<PointT>();
  for (std::size_t i = 0; i < cloud->size(); i += 10) {
    (*cloud)[i].getVector3fMap().array() += 0.2f;
    if constexpr (pcl::traits::has_normal<PointT>::value)
      (*cloud)[i].getNormalVector3fMap() = Eigen::Vector3f(1, 1, 1).normalized();
  }
  return cloud;
}

template <typename Icp>
void
setUpCorner(Icp& icp)
{
  icp.setInputSource(cornerData<typename Icp::PointCloudSource::PointType>());
  icp.setInputTarget(cornerModel<typename Icp::PointCloudTarget::PointType>());
  icp.setMaxCorrespondenceDistance(0.5);
}

template <typename Icp>
void
alignFrom(Icp& icp, const Eigen::Isometry3d& guess = Eigen::Isometry3d::Identity())
{
  typename Icp::PointCloudSource aligned;
  icp.align(aligned, guess.matrix().cast<typename Icp::Matrix4::Scalar>());
}

/** \return how far what align() found is from a motion */
template <typename Icp>
MotionSize
errorOf(Icp& icp, const Eigen::Isometry3d& truth = kCornerTruth)
{
  Eigen::Isometry3d found;
  found.matrix() = icp.getFinalTransformation().template cast<double>();
  return distanceBetween(truth, found);
}

/** Runs align() and expects the truth of the corner. */
template <typename Icp>
void
expectCorner(Icp& icp, double tolerance = kExactTol)
{
  alignFrom(icp);
  EXPECT_TRUE(icp.hasConverged()) << toString(icp.result().status);
  EXPECT_LT(errorOf(icp).translation, tolerance);
  EXPECT_LT(errorOf(icp).rotation, tolerance);
}

/** \brief A tree that counts how often it is built. */
template <typename Tree>
struct CountingTree : Tree {
  int built = 0;
  [[gnu::noinline]] void // GCC 12 warns of a guess of its own when it inlines
  setInputCloud(const typename Tree::PointCloudConstPtr& cloud,
                const pcl::IndicesConstPtr& indices = nullptr) override
  {
    ++built;
    Tree::setInputCloud(cloud, indices);
  }
};

/** \brief One of PCL's parts, for tests of all of them. */
template <typename T>
struct NamedPart {
  std::string name;
  std::function<T()> make;
};

template <typename T>
void
PrintTo(const NamedPart<T>& part, std::ostream* out)
{
  *out << part.name;
}

const auto kNameOfPart = [](const auto& tested) { return tested.param.name; };

template <typename T, typename Base>
NamedPart<Base>
named(const std::string& name, std::function<void(T&)> change = nullptr)
{
  return {name, [change]() -> Base {
            const auto part = pcl::make_shared<T>();
            if (change)
              change(*part);
            return part;
          }};
}

constexpr Metric kMetrics[] = {Metric::kPoint, Metric::kPlane, Metric::kGicp};

inline const Eigen::Isometry3d kSmall =
    poseFromEuler({0.01, -0.02, 0.015}, {0.01, -0.008, 0.012});

} // namespace pcl6d::test
