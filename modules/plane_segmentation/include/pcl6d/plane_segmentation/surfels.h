// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Elements of surface (after Pfister et al., SIGGRAPH 2000): the means of the
 * points in the voxels of a grid. Close to a scanner, where points are closer together
 * than they are exact, a normal from the next few points is noise; these average it
 * away, and there are fewer of them. Far away a surfel is a point. Surfels are in the
 * order of their voxels' keys. \ingroup plane_segmentation */
struct Surfels {
  static constexpr std::size_t kNeighbours = 20; ///< of a normal; itself included

  Points points;            ///< [m] mean of the members; where smooth, on the surface
  Normals normals;          ///< unit, towards the sensor; zero: neighbours on a line
  std::vector<float> radii; ///< [m] to the farthest of the neighbours
  std::vector<float> noise; ///< [m] standard deviation of a point to its surface
  std::vector<float> roughness; ///< [m] rms of the neighbours to their plane
  std::vector<char> smooth;     ///< whether the neighbours make a plane, up to noise

  std::vector<std::uint32_t> of_point; ///< of each point its surfel
  std::vector<std::uint32_t> begin;    ///< first of each in members, and the end
  std::vector<std::uint32_t> members;  ///< points, surfel by surfel, ascending in each
  std::vector<std::uint32_t> link_begin; ///< first of each in links, and the end
  std::vector<std::uint32_t> links; ///< neighbours of each, nearest first, itself too;
                                    ///< of an organized cloud those on its grid

  std::size_t
  size() const
  {
    return points.size();
  }
};

} // namespace pcl6d
