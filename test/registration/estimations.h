// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/pcl/transformation_estimation_dual_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_euler.h>
#include <pcl6d/registration/pcl/transformation_estimation_helix.h>
#include <pcl6d/registration/pcl/transformation_estimation_orthonormal.h>
#include <pcl6d/registration/pcl/transformation_estimation_plane_helix.h>
#include <pcl6d/registration/pcl/transformation_estimation_plane_linear.h>
#include <pcl6d/registration/pcl/transformation_estimation_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_quaternion_linear.h>
#include <pcl6d/registration/pcl/transformation_estimation_quaternion_unconstrained.h>
#include <pcl6d/registration/pcl/transformation_estimation_scale_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_small_angle.h>
#include <pcl6d/registration/pcl/transformation_estimation_svd.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace pcl6d::test {

using NormalPoint = pcl::PointNormal;
using NormalCloud = pcl::PointCloud<NormalPoint>;
using Estimation =
    pcl::registration::TransformationEstimation<NormalPoint, NormalPoint, double>;

/** \brief What an estimation minimises. */
enum class Goal {
  kPoints,        ///< distance of points
  kSimilarity,    ///< the same, of the source times a scale
  kUnconstrained, ///< the same, with the position spoilt by the scale
  kPlanes         ///< distance of points to planes
};

/** \brief One of our estimations, for tests of all of them. */
struct NamedEstimation {
  std::string name; ///< also printed when a test fails
  std::function<Estimation::Ptr()> make;
  Goal goal = Goal::kPoints;
};

inline void
PrintTo(const NamedEstimation& estimation, std::ostream* out)
{
  *out << estimation.name;
}

template <template <typename, typename, typename> class T>
NamedEstimation
namedEstimation(const char* name, Goal goal = Goal::kPoints)
{
  return {name,
          [] { return pcl::make_shared<T<NormalPoint, NormalPoint, double>>(); },
          goal};
}

inline std::vector<NamedEstimation>
allEstimations()
{
  return {
      namedEstimation<TransformationEstimationSVD>("SVD"),
      namedEstimation<TransformationEstimationQuaternion>("Quaternion"),
      namedEstimation<TransformationEstimationOrthonormal>("Orthonormal"),
      namedEstimation<TransformationEstimationDualQuaternion>("DualQuaternion"),
      namedEstimation<TransformationEstimationScaleQuaternion>("ScaleQuaternion",
                                                               Goal::kSimilarity),
      namedEstimation<TransformationEstimationHelix>("Helix"),
      namedEstimation<TransformationEstimationSmallAngle>("SmallAngle"),
      namedEstimation<TransformationEstimationEuler>("Euler"),
      namedEstimation<TransformationEstimationQuaternionLinear>("QuaternionLinear"),
      namedEstimation<TransformationEstimationQuaternionUnconstrained>(
          "Unconstrained", Goal::kUnconstrained),
      namedEstimation<TransformationEstimationPlaneLinear>("PlaneLinear",
                                                           Goal::kPlanes),
      namedEstimation<TransformationEstimationPlaneHelix>("PlaneHelix", Goal::kPlanes)};
}

} // namespace pcl6d::test
