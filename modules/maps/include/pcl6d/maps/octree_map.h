// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/maps/mapped_scan.h>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of OctreeMap. Probabilities are OctoMap's published defaults (Hornung et al.
 * 2013, section 5.1): log-odds 0.85 of a hit, -0.4 of a miss, kept within -2 and 3.5. */
struct OctreeMapOptions {
  double resolution = 0.1; ///< [m] edge of the smallest voxels; finite and > 0
  double max_range = std::numeric_limits<
      double>::infinity(); ///< [m] rays end here, without a hit; > 0
  double hit = 0.7;        ///< probability of occupied at the end of a ray; in (0.5, 1)
  double miss = 0.4;       ///< probability of occupied along a ray; in (0, 0.5)
  double lowest = 0.12;    ///< least probability of a voxel; in (0, 0.5)
  double highest = 0.97;   ///< largest probability of a voxel; in (0.5, 1)
  std::size_t memory = std::size_t{1}
                       << 30; ///< [byte] of the tree with the rays of a scan

  /** \throws BadArgument naming the first invalid field, with the value */
  void
  validate() const;
};

/** \brief Occupancy of space in an octree of OctoMap.
 *
 * Each voxel changes once a scan: occupied where points lie in the voxel, else free where a ray
 * goes through the voxel. The rays of all points in a voxel count as a single ray to the
 * centre, like in OctoMap's computeDiscreteUpdate().
 * \note Source: A. Hornung, K. Wurm, M. Bennewitz, C. Stachniss, W. Burgard, "OctoMap: an
 * efficient probabilistic 3D mapping framework based on octrees", Autonomous Robots 34, 2013.
 * \ingroup maps */
class OctreeMap {
public:
  /** \throws BadArgument an option is invalid */
  explicit OctreeMap(const OctreeMapOptions& options);
  ~OctreeMap();
  OctreeMap(const OctreeMap&) = delete;
  OctreeMap&
  operator=(const OctreeMap&) = delete;

  /** \brief Adds a scan.
   * \return false: tree and rays would exceed options.memory, and the scan was not added
   * \throws BadArgument a point lies beyond OctoMap's limit of 32768 voxels on each side of the
   * origin */
  bool
  insert(const MappedScan& scan);

  /** \return the state of the voxel at a position [m] */
  CellState
  state(const Eigen::Vector3d& place) const;

  /** \return the probability that the voxel at a position [m] is occupied; 0.5 if unknown */
  double
  probability(const Eigen::Vector3d& place) const;

  /** \return the number of nodes of the tree */
  std::size_t
  numNodes() const;

  /** \return whether no voxel is occupied */
  bool
  isEmpty() const;

  /** \brief Writes a file of OctoMap, atomically: `.ot` holds probabilities, `.bt` only whether
   * a voxel is occupied or free. Writing `.bt` also changes the map: each voxel gets the
   * largest or least probability. \param[in] path the extension selects the format
   * \throws BadArgument another extension \throws IoFailed the file cannot be written */
  void
  write(const std::filesystem::path& path);

private:
  struct Tree;
  OctreeMapOptions options_;
  std::unique_ptr<Tree> tree_;
};

} // namespace pcl6d
