// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/voxel_numbers.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Shape of the distribution of a voxel's points. */
enum class VoxelShape {
  kNone,  ///< too few points, or points along a line: a line fixes no normal, and
          ///< the scan lines of a spinning lidar move with the lidar, hence would
          ///< pull its pose back
  kPlane, ///< points on a plane
  kBlob   ///< points spread in all three directions, as in a bush
};

/** \brief A distribution of points in the map, against which a point is matched. */
struct MapSurface {
  VoxelShape shape = VoxelShape::kNone;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(); ///< [m] of the points
  Eigen::Vector3d normal =
      Eigen::Vector3d::Zero(); ///< of a plane, unit length; any sign
  double variance =
      0; ///< [m^2] of the points across the plane; of a blob: along an axis,
         ///< mean of the three
};

/** \brief Knobs of LocalMap. */
struct LocalMapOptions {
  double voxel = 0.25; ///< [m] edge of the smallest voxels; finite, > 0
  int levels = 4;      ///< of voxels, each level twice as large; in [1, 8]
  /** most points of one sweep that count in a voxel, since they share the error of
   * the pose; >= 1 */
  double points_of_sweep = 20;
  /** most points that count in a voxel: beyond, older points fade away; >= 1 */
  double points_of_voxel = 200;
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Local map of bounded size around a moving scanner: distributions of points in hashed
 * voxels of several sizes.
 *
 * A voxel holds count, mean and covariance of its points rather than the points: its size in memory
 * is constant, and finding the surface at a position takes one look-up per level. A position
 * belongs to the largest voxel around it with a plane as thin as the planes of the smaller voxels
 * within: a wall is one large and exact plane, furniture many small planes. Distant voxels are
 * dropped (keepWithin()).
 * \note Source: see SurfaceMap (registration). LocalMap is the variant for thousands of sweeps: a
 * voxel takes a third of the memory, voxels without a plane have a shape, too, and dropping distant
 * voxels allocates no memory per voxel. \ingroup odometry */
class LocalMap {
public:
  /** \throws BadArgument an option is invalid */
  explicit LocalMap(const LocalMapOptions& options = {});

  /** \brief Adds the points of a sweep [m, world]; points that are not finite, or farther than 2^20
   * voxels from the origin, are left out.
   * \param[in] scanner its position during the sweep [m, world]: a single scan line, widened along
   * the rays by the noise of the ranges, is then not taken for a plane; missing: not known */
  void
  add(const std::vector<Eigen::Vector3d>& points,
      const std::optional<Eigen::Vector3d>& scanner = std::nullopt);

  /** \brief Drops the voxels with a centre farther than a distance [m] from a place. */
  void
  keepWithin(const Eigen::Vector3d& place, double distance);

  /** \return the surface at a place: a plane, else a blob; null: no surface. Valid until the map
   * changes; safe to call from several threads */
  const MapSurface*
  surfaceAt(const Eigen::Vector3d& place) const;

  /** \return the key of the smallest voxel around a place; all places in it have one surface;
   * none: the place is outside the grid */
  std::optional<VoxelKey>
  voxelAt(const Eigen::Vector3d& place) const;

  /** \return the surface at the places in a smallest voxel; null: no surface */
  const MapSurface*
  surfaceIn(VoxelKey smallest) const;

  /** \return whether a point of the map lies in the voxel of a level around a place */
  bool
  isOccupied(const Eigen::Vector3d& place, int level) const;

  /** \return the number of occupied voxels, all levels together */
  std::size_t
  size() const;

  /** \return the size of the map in memory [bytes] */
  std::size_t
  numBytes() const;

  const LocalMapOptions&
  options() const
  {
    return options_;
  }

private:
  /** Sums over points, as offsets [m] from the centre of their voxel. */
  struct Sums {
    double count = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    /** xx, xy, xz, yy, yz, zz */
    Eigen::Matrix<double, 6, 1> second = Eigen::Matrix<double, 6, 1>::Zero();
    Eigen::Vector3d rays =
        Eigen::Vector3d::Zero(); ///< sum of unit vectors; zero: not known
  };
  struct Voxel {
    VoxelKey key = 0;
    Sums sums;
  };
  /** The data of a voxel are apart by use: a look-up touches only one of the vectors. */
  struct Level {
    double edge = 0; ///< [m]
    VoxelNumbers numbers;
    std::vector<Voxel> voxels;
    std::vector<MapSurface> surfaces;
    /** 1 + index of the voxel's sums over the sweep being added; 0: none */
    std::vector<std::uint32_t> fresh;
  };
  struct Fresh {
    std::size_t number = 0; ///< of the voxel
    Sums sums;
  };

  bool
  isInside(const Eigen::Vector3d& place) const;
  static Sums&
  freshSums(VoxelKey key, Level& level, std::vector<Fresh>& fresh);
  static void
  shift(const Sums& from, const Eigen::Vector3d& offset, Sums& to);
  void
  take(const Fresh& fresh,
       const std::optional<Eigen::Vector3d>& scanner,
       Level& level) const;
  static MapSurface
  surfaceOf(const Sums& sums, const Eigen::Vector3d& centre, double edge);

  LocalMapOptions options_;
  std::vector<Level> levels_; ///< the smallest voxels first
};

} // namespace pcl6d
