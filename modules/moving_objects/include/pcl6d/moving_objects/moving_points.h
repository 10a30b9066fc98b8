// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/moving_objects/point_motion.h>
#include <pcl6d/search/point_tree.h>
#include <pcl6d/visibility/ray_image.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl6d::moving_objects {
class Judge;
}

namespace PCL6D_EXPORTS pcl6d {

/** \brief How exactly a pose is known: standard deviations along, and about, the axis on
 * which it is known least. */
struct PoseSigma {
  double translation = 0; ///< [m] finite, >= 0
  double rotation = 0;    ///< [rad] finite, >= 0
};

/** \brief A scan as those that judge others see it. All pointers are kept, none is owned. */
struct SeenScan {
  const RayImage* rays =
      nullptr; ///< of all its measured points; null: it judges nobody
  /** its surfaces, reduced by a voxel: what a ray that ends near a place has hit. Without
   * them what the rays say must do */
  const Points* surface = nullptr;
  const Normals* normals = nullptr; ///< one per point of the surface
  const PointTree* tree = nullptr;  ///< over the points of the surface
  double voxel = 0;                 ///< [m] of their reduction; > 0
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  PoseSigma sigma; ///< of T_world_scan relative to its neighbours
};

/** \brief Knobs of MovingPoints. */
struct MovingPointsOptions {
  /** so many other scans judge each scan, those that see most of it, and as many more what
   * these did not see; in [1, 8] */
  std::size_t neighbours = 8;
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Tells which points of registered scans moved, by the free space that other scans
 * measured through their places.
 *
 * Points that another scan's image cannot tell apart, those within one of its cells and near in
 * range, are judged as one. Each of these is looked at in the images of the scans that see most of
 * the scan: they saw through its place (a miss), or measured a surface there (a hit, which must
 * lie on their surfaces), or cannot say. A miss counts where the ray ended farther behind than
 * grazing explains. A hit counts twice, as rays pass beside thin things but never end at nothing;
 * but not if all who saw through the place did so before, or after, the thing stayed there. Places
 * that were missed more often make clusters; one with few misses, or strewn with places that were
 * hit, as foliage and fences are, stays. What remains takes in what is near it, on no surface of
 * others, and surrounded by it, or before its middle: the parts of the thing that nobody saw through.
 *
 * Same bits for any number of threads; judge() may be called from several. Idea: J. Schauer,
 * A. Nuechter, "The Peopleremover: removing dynamic objects from 3-D point cloud data by
 * traversing a voxel occupancy grid", RA-L 2018, with images in place of the grid.
 * \code
 * const pcl6d::MovingPoints judges(seen_scans);
 * const auto motion = judges.judge(3, points_of_scan_3); // one per point
 * \endcode \ingroup moving_objects */
class MovingPoints {
public:
  /** \throws BadArgument an option breaks its rule; a pose is not a rigid motion, a sigma is
   * negative or not finite; a surface without tree, normals or voxel */
  explicit MovingPoints(std::vector<SeenScan> scans,
                        const MovingPointsOptions& options = {});

  std::size_t
  size() const
  {
    return scans_.size();
  }

  /** \return the share of surface points that rays contradict even between the scans that fit
   * best: what errors of scanner and poses make, glass too; 0 without surfaces. With things
   * that move alone it is small, as each of them is in the way of few scans */
  double
  background() const
  {
    return background_;
  }

  /** \return whether that is too much for rays to tell what moved: then all is unknown */
  bool
  isBlind() const;

  /** \brief Tells which points of a scan moved, by the rays of the other scans.
   * \param[in] scan the index of the scan; it must have rays
   * \param[in] points [m] measured points of this scan, in its frame: the whole scan or a part
   * \return one value a point. It is kUnknown where a coordinate is not finite or no other scan
   * sees the point, and everywhere if isBlind()
   * \throws BadArgument the index is too large, or the scan has no rays */
  std::vector<PointMotion>
  judge(std::size_t scan, const Points& points) const;

private:
  std::vector<std::size_t>
  around(std::size_t scan, std::size_t count) const;
  std::vector<moving_objects::Judge>
  candidatesFor(std::size_t scan) const;

  std::vector<SeenScan> scans_;
  MovingPointsOptions options_;
  double
  contradictionOf(std::size_t scan) const;

  double background_ = 0;
  std::vector<std::size_t> by_place_; ///< scans with rays, in the order of origins_
  Points origins_;                    ///< [m] of these, relative to the first of them
  PointTree places_;                  ///< over origins_
};

} // namespace pcl6d
