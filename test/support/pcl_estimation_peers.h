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
 * Levenberg-Marquardt: 20 s an instance), compiled once like those of pcl_peers.h, in units
 * of their own. Include it instead of PCL's headers of these classes.
 */

// Each calls EXPLICIT(class) for the instances of one unit.
#define PCL6D_TEST_PEERS_LM_XYZ_(EXPLICIT)                                             \
  EXPLICIT(pcl::registration::                                                         \
               TransformationEstimationLM<pcl::PointXYZ, pcl::PointXYZ, float>)
#define PCL6D_TEST_PEERS_LM_NORMALS_(EXPLICIT, Scalar)                                 \
  EXPLICIT(pcl::registration::                                                         \
               TransformationEstimationLM<pcl::PointNormal, pcl::PointNormal, Scalar>) \
  EXPLICIT(pcl::registration::TransformationEstimationPointToPlane<pcl::PointNormal,   \
                                                                   pcl::PointNormal,   \
                                                                   Scalar>)
#define PCL6D_TEST_PEERS_CLOSED_OF_(EXPLICIT, P, Scalar)                               \
  EXPLICIT(pcl::registration::TransformationEstimationDualQuaternion<P, P, Scalar>)    \
  EXPLICIT(pcl::registration::TransformationEstimationSVDScale<P, P, Scalar>)
#define PCL6D_TEST_PEERS_PAIRS_OF_(EXPLICIT, P, Scalar)                                \
  EXPLICIT(pcl::registration::CorrespondenceEstimationNormalShooting<P, P, P, Scalar>) \
  EXPLICIT(pcl::registration::CorrespondenceEstimationBackProjection<P, P, P, Scalar>)
#define PCL6D_TEST_PEERS_CLOSED_FLOAT_(EXPLICIT)                                       \
  PCL6D_TEST_PEERS_CLOSED_OF_(EXPLICIT, pcl::PointXYZ, float)
#define PCL6D_TEST_PEERS_CLOSED_DOUBLE_(EXPLICIT)                                      \
  PCL6D_TEST_PEERS_CLOSED_OF_(EXPLICIT, pcl::PointNormal, double)                      \
  PCL6D_TEST_PEERS_PAIRS_OF_(EXPLICIT, pcl::PointNormal, double)

#define PCL6D_TEST_ESTIMATION_ELSEWHERE_(...) extern template class __VA_ARGS__;
#define PCL6D_TEST_ESTIMATION_HERE_(...) template class __VA_ARGS__;

PCL6D_TEST_PEERS_LM_XYZ_(PCL6D_TEST_ESTIMATION_ELSEWHERE_)
PCL6D_TEST_PEERS_LM_NORMALS_(PCL6D_TEST_ESTIMATION_ELSEWHERE_, float)
PCL6D_TEST_PEERS_LM_NORMALS_(PCL6D_TEST_ESTIMATION_ELSEWHERE_, double)
PCL6D_TEST_PEERS_CLOSED_FLOAT_(PCL6D_TEST_ESTIMATION_ELSEWHERE_)
PCL6D_TEST_PEERS_CLOSED_DOUBLE_(PCL6D_TEST_ESTIMATION_ELSEWHERE_)
