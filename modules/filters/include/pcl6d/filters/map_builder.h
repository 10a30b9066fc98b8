// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/voxel_numbers.h>

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \return the edge [m] of the voxels with one map point each, for planes: matching
 * needs few points, small planes more */
inline double
planeVoxel(double matching_voxel)
{
  return matching_voxel / 3;
}

/** \brief Joins registered scans into one reduced map: the first point in each voxel of
 * the world stays. Scans can be added one at a time, hence need not be in memory
 * together. The voxels are counted from the whole metres of the first scan's position:
 * a small object is mapped equally finely far from the origin.
 * \ingroup filters */
class MapBuilder {
public:
  /** \param[in] voxel [m] finite and > 0
   * \param[in] world_offset [m] subtracted from world coordinates, for the
   * precision of float
   * \throws BadArgument voxel is invalid */
  explicit MapBuilder(double voxel,
                      const Eigen::Vector3d& world_offset = Eigen::Vector3d::Zero());

  /** \brief Adds the points of a scan.
   * \param[in] points in the scan's frame [m]; points that are not finite are left out
   * \param[in] intensities one per point, or empty
   * \param[in] scan the scan's number, kept with each point
   * \throws BadArgument sizes differ, or a point lies outside the grid about the first
   * scan (voxelKey()) */
  void
  addScan(const Points& points,
          const std::vector<float>& intensities,
          const Eigen::Isometry3d& T_world_scan,
          std::uint32_t scan);

  /** \return the map's points [m], relative to the world offset */
  const Points&
  points() const
  {
    return points_;
  }

  /** \return per point the number of its scan */
  const std::vector<std::uint32_t>&
  scans() const
  {
    return scans_;
  }

  /** \return per point its intensity; empty unless every scan had intensities */
  std::vector<float>
  intensities() const
  {
    return has_intensity_ ? intensities_ : std::vector<float>();
  }

  /** \return the map as a cloud with fields x y z, scan (uint32), and intensity if
   * every scan had intensities */
  pcl::PCLPointCloud2
  cloud() const;

private:
  double voxel_;
  Eigen::Vector3d world_offset_;
  std::optional<Eigen::Vector3d> grid_origin_; ///< [m] in the world
  bool has_intensity_ = true;
  Points points_;
  std::vector<float> intensities_;
  std::vector<std::uint32_t> scans_;
  VoxelNumbers occupied_;
};

} // namespace pcl6d
