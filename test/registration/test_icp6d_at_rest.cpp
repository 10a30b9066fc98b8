// SPDX-License-Identifier: BSD-3-Clause
// What PCL's ICP comes to rest with, ours does: rejectors and estimations of PCL's.
#include "icp6d_cases.h"
#include "support/pcl_peers.h"

#include <pcl/registration/correspondence_rejection_median_distance.h>
#include <pcl/registration/correspondence_rejection_one_to_one.h>
#include <pcl/registration/correspondence_rejection_trimmed.h>
#include <pcl/registration/correspondence_rejection_var_trimmed.h>

using namespace pcl6d::test;
using pcl6d::IcpStop;

namespace {
using Oriented = pcl::PointNormal;

struct Plug {
  std::string name;
  std::function<void(pcl6d::ICP6D<Oriented, Oriented>&)> into;
};

/** Two samples of a room's corner, with normals. */
CloudPtr<Oriented>
sampledCorner(std::uint64_t seed, const Eigen::Isometry3d& T)
{
  return cornerCloud<Oriented>(cornerPoints(seed, 1998, 0.004), T);
}

class Icp6DComesToRest : public testing::TestWithParam<Plug> {};
} // namespace

TEST_P(Icp6DComesToRest, WithWhatPclRestsWith)
{
  pcl6d::ICP6D<Oriented, Oriented> icp;
  const auto source = sampledCorner(2, kSmall.inverse());
  icp.setInputTarget(sampledCorner(1, Eigen::Isometry3d::Identity()));
  icp.setInputSource(source);
  icp.setMaxCorrespondenceDistance(0.5);
  icp.setMaximumIterations(200);
  GetParam().into(icp);
  pcl::PointCloud<Oriented> aligned;
  icp.align(aligned);
  EXPECT_EQ(icp.result().stop, IcpStop::kAtRest) << icp.result().iterations;
  EXPECT_TRUE(icp.hasConverged()) << toString(icp.result().status);
  EXPECT_LT(pcl6d::distanceBetween(icp.result().T_target_source, kSmall).translation,
            0.03);
}

template <typename Class>
Plug
rejectorPlug(const std::string& name)
{
  return {name, [](auto& icp) {
            const auto rejector = pcl::make_shared<Class>();
            icp.addCorrespondenceRejector(rejector);
          }};
}

INSTANTIATE_TEST_SUITE_P(
    Plugs,
    Icp6DComesToRest,
    testing::Values(
        rejectorPlug<pcl::registration::CorrespondenceRejectorMedianDistance>("Median"),
        rejectorPlug<pcl::registration::CorrespondenceRejectorTrimmed>("Trimmed"),
        rejectorPlug<pcl::registration::CorrespondenceRejectorVarTrimmed>("VarTrimmed"),
        rejectorPlug<pcl::registration::CorrespondenceRejectorOneToOne>("OneToOne"),
        Plug{
            "Symmetric",
            [](auto& icp) {
              icp.setTransformationEstimation(
                  pcl::make_shared<pcl::registration::
                                       TransformationEstimationSymmetricPointToPlaneLLS<
                                           Oriented,
                                           Oriented>>());
            }},
        Plug{"PointToPlane",
             [](auto& icp) {
               icp.setTransformationEstimation(
                   pcl::make_shared<
                       pcl::registration::TransformationEstimationPointToPlaneLLS<
                           Oriented,
                           Oriented>>());
             }}),
    [](const auto& which) { return which.param.name; });
