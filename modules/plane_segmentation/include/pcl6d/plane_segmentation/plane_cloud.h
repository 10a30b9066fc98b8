// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/search/point_tree.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl6d {

/** \brief Sets of points, disjoint, one per plane that a detector believes in; places
 * in PlaneCloud::points(). */
using PlaneCandidates = std::vector<std::vector<std::uint32_t>>;

/** \brief A cloud prepared for the search for planes: its finite points, who is next to
 * whom, and the normal of the surface at each. Detectors share one.
 * \ingroup plane_segmentation */
class PlaneCloud {
public:
  /** \param[in] points [m] of one frame; those that are not finite are left out
   * \param[in] num_threads 0: one per core; never changes the result */
  explicit PlaneCloud(const Points& points, unsigned int num_threads = 0);

  /** \return the finite points [m] */
  const Points&
  points() const
  {
    return points_;
  }

  /** \return per finite point its place in the cloud that was given */
  const std::vector<std::uint32_t>&
  places() const
  {
    return places_;
  }

  /** \return a search tree over points() */
  const PointTree&
  tree() const
  {
    return tree_;
  }

  /** \return unit normals of points(), towards the origin of the frame; zero where there
   * is none */
  const Normals&
  normals() const
  {
    return normals_;
  }

private:
  std::vector<std::uint32_t> places_;
  Points points_;
  PointTree tree_;
  Normals normals_;
};

} // namespace pcl6d
