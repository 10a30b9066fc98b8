// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/polygon.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of PointLabeller. */
struct PointLabelOptions {
  double plane_distance =
      0.05; ///< [m] from a point to its plane, and beyond its hull; > 0
  double skin =
      0.02; ///< [m] up to this distance from a labelled plane a point is on the plane,
            ///< even inside the box of an object; >= 0
  double box_margin = 0.02;     ///< [m] by which boxes of objects are grown; >= 0
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Labels and ids of points. */
struct PointLabels {
  std::vector<std::uint32_t> label;     ///< index into SemanticMap::labelNames()
  std::vector<std::uint32_t> plane_id;  ///< 0: on no plane
  std::vector<std::uint32_t> object_id; ///< 0: on no object
};

/** \brief Assigns points to the planes and objects of a map (book 7.3): the nearest
 * plane whose hull contains the point, or the smallest object whose box contains the
 * point. A point on a labelled plane stays on the plane; other points in a box belong
 * to the object.
 * \ingroup semantic_map */
class PointLabeller {
public:
  /** \param[in] map kept by reference \throws BadArgument an option is invalid */
  explicit PointLabeller(const SemanticMap& map, const PointLabelOptions& options = {});

  /** \param[in] points [m] \param[in] T_world_points from the points' frame to the
   * world */
  PointLabels
  label(const Points& points, const Eigen::Isometry3d& T_world_points) const;

private:
  struct Prism { ///< the space around a hull
    HullPrism hull;
    Eigen::AlignedBox3d bounds;
  };

  std::size_t
  planeOf(const Eigen::Vector3d& point, double& distance) const;
  std::size_t
  objectOf(const Eigen::Vector3d& point) const;

  const SemanticMap& map_;
  PointLabelOptions options_;
  std::vector<Prism> prisms_;               ///< of the planes
  std::vector<Eigen::AlignedBox3d> bounds_; ///< of the objects, in the world
  std::vector<std::uint32_t> plane_label_;  ///< indices into labelNames()
  std::vector<std::uint32_t> object_label_; ///< indices into labelNames()
};

} // namespace pcl6d
