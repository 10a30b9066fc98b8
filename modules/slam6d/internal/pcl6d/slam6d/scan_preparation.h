// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

std::size_t
countFinite(const Points& points);

/** \return the message for a scan with too few points to be matched */
std::string
tooFewPoints(const std::string& scan, std::size_t count, const std::string& where);

/** \brief The points of a scan within the range gate. A planar scan is raised to walls if the
 * parameters require it (raisedPlanarScan()). \param[in] name for messages
 * \throws ComputeFailed fewer than 3 points are left */
Points
gateScan(const Points& points,
         const std::string& name,
         const Slam6DParameters& parameters);

/** \brief The reduction of a gated scan. \param[in] reduction method; its voxel is ignored
 * \throws ComputeFailed the scan is too large for the grid */
Points
reduceScan(const Points& gated,
           const std::string& name,
           const Slam6DParameters& parameters,
           ReductionOptions reduction = {});

/** \brief Range gate and reduction of one scan. \param[in] name for messages
 * \throws ComputeFailed fewer than 3 points are left, or the scan is too large for the grid */
Points
prepareScan(const Points& points,
            const std::string& name,
            const Slam6DParameters& parameters);

} // namespace pcl6d
