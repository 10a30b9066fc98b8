// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The cell of a regular grid as a 64-bit number: 3 x 21 bits of floor(p / voxel), each
 * shifted to be non-negative. \ingroup common */
using VoxelKey = std::uint64_t;

/** \param[in] p point [m] \param[in] voxel edge length of a cell [m], > 0
 * \return the key of the cell around p; the grid has a corner at the origin
 * \throws BadArgument p is farther than 2^20 cells from the origin along an axis, or
 * not finite (an error, where pcl::VoxelGrid wraps around) */
VoxelKey
voxelKey(const Eigen::Vector3f& p, double voxel);

/** \return the key of the cell around a cell in the grid of twice the edge */
VoxelKey
coarserVoxel(VoxelKey key);

/** \return the centre of the cell [m] */
Eigen::Vector3f
voxelCentre(VoxelKey key, double voxel);

} // namespace pcl6d
