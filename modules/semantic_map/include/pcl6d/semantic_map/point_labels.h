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
      0.02; ///< [m] so near to a labelled plane a point is on it even inside the
            ///< box of an object; >= 0
  double box_margin = 0.02;     ///< [m] by which boxes of objects are grown; >= 0
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What points are. */
struct PointLabels {
  std::vector<std::uint32_t> label;     ///< place in SemanticMap::labelNames()
  std::vector<std::uint32_t> plane_id;  ///< 0: on none
  std::vector<std::uint32_t> object_id; ///< 0: of none
};

/** \brief Tells which plane or object of a map a point belongs to (book 7.3): the nearest
 * plane whose hull it lies in, or the smallest object whose box it lies in. A point on a
 * labelled plane stays on it; others in a box are of the object.
 * \ingroup semantic_map */
class PointLabeller {
public:
  /** \param[in] map kept by reference \throws BadArgument an option breaks its rule */
  explicit PointLabeller(const SemanticMap& map, const PointLabelOptions& options = {});

  /** \param[in] points [m] \param[in] T_world_points takes them into the world */
  PointLabels
  label(const Points& points, const Eigen::Isometry3d& T_world_points) const;

private:
  struct Prism { ///< the space about a hull
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
  std::vector<std::uint32_t> plane_label_;  ///< places in labelNames()
  std::vector<std::uint32_t> object_label_; ///< places in labelNames()
};

} // namespace pcl6d
