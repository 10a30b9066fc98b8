// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_types.h>
#include <pcl/registration/correspondence_estimation_backprojection.h>
#include <pcl/registration/correspondence_estimation_normal_shooting.h>
#include <pcl/registration/transformation_estimation_dual_quaternion.h>
#include <pcl/registration/transformation_estimation_lm.h>
#include <pcl/registration/transformation_estimation_point_to_plane.h>
#include <pcl/registration/transformation_estimation_svd_scale.h>

/** \file
 * PCL's estimations of pairs and motions that cost most to compile (least squares by
 * Levenberg-Marquardt: 20 s an instance), compiled once like those of pcl_peers.h. Include it
 * instead of PCL's headers of these classes.
 */

// Each calls EXPLICIT(class) for some of the instances that are compiled once.
#define PCL6D_TEST_ESTIMATION_PEERS_OF_POINT_(EXPLICIT, P, Scalar)                     \
  EXPLICIT(pcl::registration::TransformationEstimationLM<P, P, Scalar>)                \
  EXPLICIT(pcl::registration::TransformationEstimationDualQuaternion<P, P, Scalar>)    \
  EXPLICIT(pcl::registration::TransformationEstimationSVDScale<P, P, Scalar>)
#define PCL6D_TEST_ESTIMATION_PEERS_OF_PLANES_(EXPLICIT, P, Scalar)                    \
  EXPLICIT(pcl::registration::TransformationEstimationPointToPlane<P, P, Scalar>)
#define PCL6D_TEST_ESTIMATION_PEERS_OF_PAIRS_(EXPLICIT, P, Scalar)                     \
  EXPLICIT(pcl::registration::CorrespondenceEstimationNormalShooting<P, P, P, Scalar>) \
  EXPLICIT(pcl::registration::CorrespondenceEstimationBackProjection<P, P, P, Scalar>)

#define PCL6D_TEST_ESTIMATION_ELSEWHERE_(...) extern template class __VA_ARGS__;
#define PCL6D_TEST_ESTIMATION_HERE_(...) template class __VA_ARGS__;

PCL6D_TEST_ESTIMATION_PEERS_OF_POINT_(PCL6D_TEST_ESTIMATION_ELSEWHERE_,
                                      pcl::PointXYZ,
                                      float)
PCL6D_TEST_ESTIMATION_PEERS_OF_POINT_(PCL6D_TEST_ESTIMATION_ELSEWHERE_,
                                      pcl::PointNormal,
                                      float)
PCL6D_TEST_ESTIMATION_PEERS_OF_PLANES_(PCL6D_TEST_ESTIMATION_ELSEWHERE_,
                                       pcl::PointNormal,
                                       float)
PCL6D_TEST_ESTIMATION_PEERS_OF_POINT_(PCL6D_TEST_ESTIMATION_ELSEWHERE_,
                                      pcl::PointNormal,
                                      double)
PCL6D_TEST_ESTIMATION_PEERS_OF_PLANES_(PCL6D_TEST_ESTIMATION_ELSEWHERE_,
                                       pcl::PointNormal,
                                       double)
PCL6D_TEST_ESTIMATION_PEERS_OF_PAIRS_(PCL6D_TEST_ESTIMATION_ELSEWHERE_,
                                      pcl::PointNormal,
                                      double)
