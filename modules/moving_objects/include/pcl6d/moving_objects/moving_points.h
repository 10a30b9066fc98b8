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
class Observer;
}

namespace PCL6D_EXPORTS pcl6d {

/** \brief Accuracy of a pose: standard deviations along, and about, its least accurate axis. */
struct PoseSigma {
  double translation = 0; ///< [m] finite, >= 0
  double rotation = 0;    ///< [rad] finite, >= 0
};

/** \brief A scan as an observer of other scans. Pointers are kept, not owned. */
struct SeenScan {
  const RayImage* rays = nullptr; ///< of every measured point;
                                  ///< null: the scan is no observer
  /** surfaces, reduced by a voxel: the possible hits of rays that end near a point. Without
   * surfaces the rays alone decide */
  const Points* surface = nullptr;
  const Normals* normals = nullptr; ///< one per point of the surface
  const PointTree* tree = nullptr;  ///< over the points of the surface
  double voxel = 0;                 ///< [m] of their reduction; > 0
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  PoseSigma sigma; ///< of T_world_scan relative to its neighbours
};

/** \brief Knobs of MovingPoints. */
struct MovingPointsOptions {
  /** number of observers of a scan, chosen by common view; points without an observer get as
   * many further observers; in [1, 8] */
  std::size_t neighbours = 8;
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Classifies the points of registered scans as static or dynamic, by the free space
 * that other scans measured.
 *
 * Points that the image of an observer cannot resolve, within one of its cells and near in
 * range, are tested as one place. Observers are the scans that see most of the scan. A ray of
 * an observer passes through the place (a miss), measures a surface there (a hit, which must
 * lie on the observer's surfaces), or is inconclusive. A miss counts where the ray ended
 * farther behind than a grazing angle explains. A hit counts twice, because rays miss thin
 * objects but never hit free space. Hits before the first miss, in time from the scan on, do
 * not count: the object stayed for a while. Places with more misses form clusters. A cluster
 * with few misses, or with many hit places in between, as foliage and fences, is static. A
 * dynamic cluster grows by places nearby that lie on no surface of an observer, and are
 * surrounded by the cluster or in front of its middle: the parts of the object without a miss.
 *
 * Bit-identical for any number of threads; const members are thread-safe. Idea: J. Schauer, A.
 * Nuechter, "The Peopleremover: removing dynamic objects from 3-D point cloud data by
 * traversing a voxel occupancy grid", RA-L 2018, with images in place of the grid.
 * \code
 * const pcl6d::MovingPoints moving(seen_scans);
 * const auto motion = moving.classify(3, points_of_scan_3); // one per point
 * \endcode
 * \ingroup moving_objects */
class MovingPoints {
public:
  /** \throws BadArgument an invalid option; a pose is not a rigid motion, a sigma is negative
   * or not finite; a surface without tree, normals or voxel */
  explicit MovingPoints(std::vector<SeenScan> scans,
                        const MovingPointsOptions& options = {});

  std::size_t
  size() const
  {
    return scans_.size();
  }

  /** \return the share of surface points violated by rays even between the scans that fit best:
   * the effect of scanner and pose errors, and of glass; 0 without surfaces. Dynamic objects
   * alone add little, as each blocks the rays of few scans */
  double
  background() const
  {
    return background_;
  }

  /** \return whether the background is too large to classify points: every point is then unknown */
  bool
  isBlind() const;

  /** \brief Classifies points of a scan by the rays of the other scans.
   * \param[in] scan the index of the scan; it must have rays
   * \param[in] points [m] measured points of the scan, in its frame: the whole scan or a part
   * \return one value a point: kUnknown for a non-finite coordinate or without an observer, and
   * everywhere if isBlind()
   * \throws BadArgument the index is too large, or the scan has no rays */
  std::vector<PointMotion>
  classify(std::size_t scan, const Points& points) const;

private:
  std::vector<std::size_t>
  around(std::size_t scan, std::size_t count) const;
  std::vector<moving_objects::Observer>
  candidatesFor(std::size_t scan) const;

  std::vector<SeenScan> scans_;
  MovingPointsOptions options_;
  double
  contradictionOf(std::size_t scan) const;

  double background_ = 0;
  std::vector<std::size_t> by_place_; ///< scans with rays, in the order of origins_
  Points origins_;                    ///< [m] ray origins, relative to the first
  PointTree places_;                  ///< over origins_
};

} // namespace pcl6d
