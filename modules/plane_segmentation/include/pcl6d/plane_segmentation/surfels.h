// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Surface elements (after Pfister et al., SIGGRAPH 2000): the means of the
 * points in the voxels of a grid. Close to a scanner, points are denser than their
 * noise, and a normal from the next few points would be noise. Surfels average the
 * noise and are fewer. Far away a surfel is a single point. Surfels are in the order of
 * their voxels' keys. \ingroup plane_segmentation */
struct Surfels {
  static constexpr std::size_t kNeighbours = 20; ///< for a normal; itself included

  Points points;            ///< [m] mean of the members; where smooth, on the surface
  Normals normals;          ///< unit, towards the sensor; zero: neighbours on a line
  std::vector<float> radii; ///< [m] to the farthest of the neighbours
  std::vector<float> noise; ///< [m] standard deviation of a point to its surface
  std::vector<float> roughness; ///< [m] rms of the neighbours to their plane
  std::vector<char> smooth;     ///< whether the neighbours form a plane, up to noise

  std::vector<std::uint32_t> of_point; ///< surfel of each point
  std::vector<std::uint32_t> begin;    ///< first entry of each in members, and the end
  std::vector<std::uint32_t> members;  ///< points, surfel by surfel, ascending in each
  std::vector<std::uint32_t> link_begin; ///< first entry of each in links, and the end
  std::vector<std::uint32_t> links;      ///< neighbours of each surfel, nearest first,
                                         ///< itself included; in an organized cloud,
                                         ///< neighbours on its grid

  std::size_t
  size() const
  {
    return points.size();
  }
};

} // namespace pcl6d
