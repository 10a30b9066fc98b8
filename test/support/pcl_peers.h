// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_types.h>
#include <pcl/registration/correspondence_estimation.h>
#include <pcl/registration/correspondence_rejection_sample_consensus.h>
#include <pcl/registration/default_convergence_criteria.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>
#include <pcl/registration/transformation_estimation_svd.h>
#include <pcl/registration/transformation_estimation_symmetric_point_to_plane_lls.h>

/** \file
 * PCL's registration classes that ours are compared with. Each costs 10 s and more to
 * compile, so the instances that several tests use are compiled once (pcl_peers_*.cpp, in
 * pcl6d_test_pcl_peers). Include it instead of PCL's headers of these classes.
 */

// Each calls EXPLICIT(class) for some of the instances that are compiled once.
#define PCL6D_TEST_PCL_PEERS_OF_SCALAR_(EXPLICIT, Scalar)                              \
  EXPLICIT(pcl::registration::DefaultConvergenceCriteria<Scalar>)                      \
  PCL6D_TEST_PCL_PEERS_OF_POINT_(EXPLICIT, pcl::PointXYZ, Scalar)                      \
  PCL6D_TEST_PCL_PEERS_OF_POINT_(EXPLICIT, pcl::PointNormal, Scalar)                   \
  PCL6D_TEST_PCL_PEERS_BY_NORMALS_(EXPLICIT, pcl::PointNormal, Scalar)
#define PCL6D_TEST_PCL_PEERS_OF_POINT_(EXPLICIT, P, Scalar)                            \
  EXPLICIT(pcl::registration::CorrespondenceEstimationBase<P, P, Scalar>)              \
  EXPLICIT(pcl::registration::CorrespondenceEstimation<P, P, Scalar>)                  \
  EXPLICIT(pcl::registration::TransformationEstimationSVD<P, P, Scalar>)               \
  EXPLICIT(pcl::Registration<P, P, Scalar>)                                            \
  EXPLICIT(pcl::IterativeClosestPoint<P, P, Scalar>)
#define PCL6D_TEST_PCL_PEERS_BY_NORMALS_(EXPLICIT, P, Scalar)                          \
  EXPLICIT(pcl::registration::TransformationEstimationPointToPlaneLLS<P, P, Scalar>)   \
  EXPLICIT(pcl::registration::                                                         \
               TransformationEstimationSymmetricPointToPlaneLLS<P, P, Scalar>)         \
  EXPLICIT(pcl::IterativeClosestPointWithNormals<P, P, Scalar>)
#define PCL6D_TEST_PCL_PEERS_BESIDE_(EXPLICIT)                                         \
  EXPLICIT(pcl::registration::CorrespondenceRejectorSampleConsensus<pcl::PointXYZ>)    \
  EXPLICIT(pcl::registration::CorrespondenceRejectorSampleConsensus<pcl::PointNormal>) \
  EXPLICIT(pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>)

#define PCL6D_TEST_COMPILED_ELSEWHERE_(...) extern template class __VA_ARGS__;
#define PCL6D_TEST_COMPILED_HERE_(...) template class __VA_ARGS__;

PCL6D_TEST_PCL_PEERS_OF_SCALAR_(PCL6D_TEST_COMPILED_ELSEWHERE_, float)
PCL6D_TEST_PCL_PEERS_OF_SCALAR_(PCL6D_TEST_COMPILED_ELSEWHERE_, double)
PCL6D_TEST_PCL_PEERS_BESIDE_(PCL6D_TEST_COMPILED_ELSEWHERE_)
