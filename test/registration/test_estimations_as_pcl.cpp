// SPDX-License-Identifier: BSD-3-Clause
// Estimations of the motion: each of PCL's and what stands in its place, on exact pairs and
// on pairs with noise.
#include "as_pcl_cases.h"
#include "support/pcl_estimation_peers.h"
#include "support/pcl_peers.h"

#include <pcl6d/registration/pcl/transformation_estimation_dual_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_helix.h>
#include <pcl6d/registration/pcl/transformation_estimation_plane_linear.h>
#include <pcl6d/registration/pcl/transformation_estimation_scale_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_svd.h>

#include <numeric>

namespace reg = pcl::registration;
using namespace pcl6d::test;

namespace {
using OrientedPoint = pcl::PointNormal;
using Base = reg::TransformationEstimation<OrientedPoint, OrientedPoint, double>;

struct Couple {
  std::string name;
  Base::Ptr pcl, ours;
};

void
PrintTo(const Couple& couple, std::ostream* out)
{
  *out << couple.name;
}

template <template <typename, typename, typename> class Pcl,
          template <typename, typename, typename>
          class Ours>
Couple
couple(const std::string& name)
{
  return {name,
          pcl::make_shared<Pcl<OrientedPoint, OrientedPoint, double>>(),
          pcl::make_shared<Ours<OrientedPoint, OrientedPoint, double>>()};
}

double
errorOfMatrix(const Eigen::Matrix4d& found, double scale)
{
  Eigen::Isometry3d motion;
  motion.matrix() = found;
  motion.linear() /= scale;
  return pcl6d::distanceBetween(kCornerTruth, motion).translation;
}
} // namespace

class EstimationsAsPcl : public testing::TestWithParam<Couple> {
protected:
  pcl::PointCloud<OrientedPoint>
  source(double sigma) const
  {
    pcl6d::Random random(3);
    auto cloud = *cornerData<OrientedPoint>();
    for (auto& p : cloud)
      for (int axis = 0; axis < 3; ++axis)
        p.getVector3fMap()[axis] += static_cast<float>(sigma * random.normal());
    return cloud;
  }

  double
  error(const Base& estimation, double sigma, int overload) const
  {
    const auto cloud = source(sigma);
    const auto& target = *target_;
    pcl::Indices all(cloud.size());
    std::iota(all.begin(), all.end(), 0);
    pcl::Correspondences pairs;
    for (const int i : all)
      pairs.emplace_back(i, i, 0.f);
    Eigen::Matrix4d found = Eigen::Matrix4d::Identity();
    if (overload == 0)
      estimation.estimateRigidTransformation(cloud, target, found);
    else if (overload == 1)
      estimation.estimateRigidTransformation(cloud, all, target, found);
    else if (overload == 2)
      estimation.estimateRigidTransformation(cloud, all, target, all, found);
    else
      estimation.estimateRigidTransformation(cloud, target, pairs, found);
    return errorOfMatrix(found, 1);
  }

  pcl::PointCloud<OrientedPoint>::Ptr target_ = cornerModel<OrientedPoint>();
};

TEST_P(EstimationsAsPcl, FindTheMotionOfExactPairsByEachOverload)
{
  for (int overload = 0; overload < 4; ++overload) {
    // LM and LLS of PCL's linearise or stop early.
    EXPECT_LT(error(*GetParam().pcl, 0, overload), 2e-3) << overload;
    EXPECT_LT(error(*GetParam().ours, 0, overload), 1e-5) << overload;
  }
}

TEST_P(EstimationsAsPcl, OursIsAsCloseAsPclsWithNoise)
{
  const double of_pcl = error(*GetParam().pcl, 0.01, 0);
  // 1 cm of noise on 2000 pairs.
  EXPECT_LT(error(*GetParam().ours, 0.01, 0), 1.05 * of_pcl + 1e-4);
  EXPECT_LT(error(*GetParam().ours, 0.01, 0), 2e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Couples,
    EstimationsAsPcl,
    testing::Values(
        couple<reg::TransformationEstimationSVD, pcl6d::TransformationEstimationSVD>(
            "Svd"),
        couple<reg::TransformationEstimationDualQuaternion,
               pcl6d::TransformationEstimationDualQuaternion>("DualQuaternion"),
        couple<reg::TransformationEstimationPointToPlaneLLS,
               pcl6d::TransformationEstimationPlaneLinear>("PointToPlaneLls"),
        couple<reg::TransformationEstimationLM, pcl6d::TransformationEstimationHelix>(
            "Lm")),
    [](const auto& tested) { return tested.param.name; });

TEST(EstimationsOfScaleAsPcl, FindTheScale)
{
  auto source = *cornerData<OrientedPoint>();
  for (auto& p : source)
    p.getVector3fMap() *= 0.8f;
  const reg::TransformationEstimationSVDScale<OrientedPoint, OrientedPoint, double>
      pcls;
  const pcl6d::
      TransformationEstimationScaleQuaternion<OrientedPoint, OrientedPoint, double>
          ours;
  for (const Base* estimation :
       {static_cast<const Base*>(&pcls), static_cast<const Base*>(&ours)}) {
    Eigen::Matrix4d found;
    estimation->estimateRigidTransformation(
        source, *cornerModel<OrientedPoint>(), found);
    EXPECT_NEAR(std::cbrt(found.topLeftCorner<3, 3>().determinant()), 1.25, 1e-5);
    EXPECT_LT(errorOfMatrix(found, 1.25), 1e-5);
  }
}
