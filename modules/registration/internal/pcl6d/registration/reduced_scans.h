// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

/** \file Constants for matching reduced scans. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief [voxels] Largest distance of pairs in the metrics with planes (Metric::kPlane, kGicp).
 * 1.7 to 2.5 register every recorded set equally well. */
constexpr double kPlanePairVoxels = 1.7;

/** \brief [voxels] Largest distance of pairs of Metric::kPoint. */
constexpr double kPointPairVoxels = 2;

/** \brief IcpOptions::gicp_epsilon of reduced scans, ten times the value of the paper (Segal,
 * Haehnel, Thrun, "Generalized-ICP", RSS 2009) and of IcpOptions: the points of a voxel are means
 * over surfaces that are not quite planar. */
constexpr double kReducedGicpEpsilon = 0.01;

} // namespace pcl6d
