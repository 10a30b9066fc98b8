// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/plane.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/segment.h>
#include <pcl6d/common/triangle_mesh.h>

/** \file
 * Plans of walls from 3D planes, meshes and clouds (book 6.4.1). */
namespace PCL6D_EXPORTS pcl6d {

/** \brief The walls among planes, seen from above: one segment of the length of the hull for each
 * plane labelled wall or door with inliers, that is, with measured points.
 * \param[in] R_level_world turns the planes upright; see levelOfPlanes()
 * \param[in] min_length [m] shorter walls are left out */
Segments
wallsOf(const std::vector<Plane>& planes,
        const Eigen::Matrix3d& R_level_world = Eigen::Matrix3d::Identity(),
        double min_length = 0.3);

/** \brief Roll and pitch that turn the walls among planes upright, weighted by area; the identity
 * without walls. */
Eigen::Matrix3d
levelOfPlanes(const std::vector<Plane>& planes);

/** \return the cut of a mesh with the horizontal plane z = height [m]; triangles within the
 * plane are left out */
Segments
sliceOf(const TriangleMesh& mesh, double height);

/** \brief Knobs of sliceOf() a cloud. */
struct CloudSliceOptions {
  double low = 0.5;          ///< [m] lowest z used; finite
  double high = 2.0;         ///< [m] highest z; > low
  double cell = 0.1;         ///< [m] edge of a cell of the plan; finite, > 0
  double min_cover = 0.5;    ///< least share of [low, high] covered by the points of a
                             ///< wall's cell; in [0, 1]
  double max_distance = 0.1; ///< [m] of a cell from its segment; finite, > 0
  double max_gap = 0.3;      ///< [m] between cells of a segment; finite, > 0
  double min_length = 0.5;   ///< [m] of a segment; finite, > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief The walls of an upright cloud: cells of the plan with points over much of the height,
 * grown into straight lines.
 * \throws BadArgument an option is invalid
 * \note Source: the region growing of R. Grompone von Gioi et al., "LSD: a fast line segment
 * detector", PAMI 32(4), 2010. */
Segments
sliceOf(const Points& points, const CloudSliceOptions& options);

} // namespace pcl6d
