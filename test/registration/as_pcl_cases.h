// SPDX-License-Identifier: BSD-3-Clause
// PCL's classes and ours side by side: the same test runs for both, and only the names differ.
#pragma once

#include "icp6d_cases.h"
#include "support/data_folder.h"
#include "support/pcl_peers.h"

#include <pcl6d/registration/pcl/correspondence_estimation.h>
#include <pcl6d/registration/pcl/correspondence_rejector_one_to_one.h>
#include <pcl6d/registration/pcl/correspondence_rejector_surface_normal.h>
#include <pcl6d/registration/pcl/correspondence_rejector_trimmed.h>
#include <pcl6d/registration/pcl/correspondence_rejector_var_trimmed.h>
#include <pcl6d/registration/pcl/joint_icp6d.h>

#include <pcl/io/pcd_io.h>
#include <pcl/registration/correspondence_rejection_one_to_one.h>
#include <pcl/registration/correspondence_rejection_surface_normal.h>
#include <pcl/registration/correspondence_rejection_trimmed.h>
#include <pcl/registration/correspondence_rejection_var_trimmed.h>
#include <pcl/registration/joint_icp.h>

namespace pcl6d::test {

struct OfPcl {
  template <typename P, typename Scalar = float>
  using Icp = pcl::IterativeClosestPoint<P, P, Scalar>;
  template <typename P>
  using WithNormals = pcl::IterativeClosestPointWithNormals<P, P>;
  template <typename P>
  using Gicp = pcl::GeneralizedIterativeClosestPoint<P, P>;
  template <typename P>
  using Joint = pcl::JointIterativeClosestPoint<P, P>;
  template <typename P>
  using Correspondences = pcl::registration::CorrespondenceEstimation<P, P>;
  template <typename P>
  using Tree = pcl::search::KdTree<P>;
  using OneToOne = pcl::registration::CorrespondenceRejectorOneToOne;
  using Trimmed = pcl::registration::CorrespondenceRejectorTrimmed;
  using VarTrimmed = pcl::registration::CorrespondenceRejectorVarTrimmed;
  using SurfaceNormal = pcl::registration::CorrespondenceRejectorSurfaceNormal;
  static constexpr bool kIsOurs = false;
};

struct OfOurs {
  template <typename P, typename Scalar = float>
  using Icp = pcl6d::ICP6D<P, P, Scalar>;
  template <typename P>
  using WithNormals = pcl6d::ICP6DWithNormals<P, P>;
  template <typename P>
  using Gicp = pcl6d::GICP6D<P, P>;
  template <typename P>
  using Joint = pcl6d::JointICP6D<P, P>;
  template <typename P>
  using Correspondences = pcl6d::CorrespondenceEstimation<P, P>;
  template <typename P>
  using Tree = pcl6d::KdTree<P>;
  using OneToOne = pcl6d::CorrespondenceRejectorOneToOne;
  using Trimmed = pcl6d::CorrespondenceRejectorTrimmed;
  using VarTrimmed = pcl6d::CorrespondenceRejectorVarTrimmed;
  using SurfaceNormal = pcl6d::CorrespondenceRejectorSurfaceNormal;
  static constexpr bool kIsOurs = true;
};

struct NameOfSide {
  template <typename Side>
  static std::string
  GetName(int)
  {
    return Side::kIsOurs ? "Ours" : "Pcl";
  }
};

using BothSides = testing::Types<OfPcl, OfOurs>;

/** \return a cloud of the data set pcl, its points that are not finite left out */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
loadFinite(const std::filesystem::path& file)
{
  pcl::PointCloud<PointT> all;
  EXPECT_EQ(pcl::io::loadPCDFile(file.string(), all), 0) << file;
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (const auto& p : all)
    if (p.getVector3fMap().allFinite())
      cloud->push_back(p);
  return cloud;
}

inline std::vector<int>
queriesOf(const pcl::Correspondences& pairs)
{
  std::vector<int> queries;
  for (const auto& pair : pairs)
    queries.push_back(pair.index_query);
  std::sort(queries.begin(), queries.end());
  return queries;
}

} // namespace pcl6d::test
