// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/triangle_mesh.h>
#include <pcl6d/object_localization/oriented_points.h>

namespace pcl6d {

/** \brief Spreads points evenly over a mesh, always the same, each with the normal of its
 * triangle. \param[in] spacing [m] > 0: one point per square of this side */
OrientedPoints
sampleMesh(const TriangleMesh& mesh, double spacing);

} // namespace pcl6d
