// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/parameter.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/maps/mapped_scan.h>
#include <pcl6d/run/run_folder.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The registered scans of a finished run, read one at a time for a map.
 *
 * The frame of the map is the frame of the run, relative to its world offset, z up. Left out:
 * unregistered scans, scans disconnected from the first scan, dynamic points, and points
 * outside the range gate of the run.
 * \code
 * pcl6d::MapScans scans("OUT");
 * pcl6d::OctreeMap map({scans.resolution().value});
 * for (std::size_t i = 0; i < scans.size(); ++i)
 *   map.insert(scans.read(i));
 * map.write("map.bt");
 * \endcode
 * \ingroup maps */
class MapScans {
public:
  /** \param[in] run folder of a finished run of pcl_slam6d
   * \throws IoFailed the folder is no run, or the run was interrupted or is damaged */
  explicit MapScans(const std::filesystem::path& run);

  /** \return the number of scans */
  std::size_t
  size() const
  {
    return places_.size();
  }

  /** \return the i-th scan; the origin is tested by isPlausibleOrigin()
   * \throws IoFailed the file of the scan is missing or damaged */
  MappedScan
  read(std::size_t i);

  /** \return [m] the voxel of the run or, if larger, the line spacing of its scans, rounded up
   * to 0.05, 0.1, 0.2, 0.5, 1, ...: neighbouring lines then leave no gaps of unknown cells
   * \throws IoFailed under the conditions of read() */
  Parameter
  resolution() const;

  const RunFolder&
  run() const
  {
    return run_;
  }

  /** \return the number of scans left out because unregistered or disconnected */
  std::size_t
  leftOut() const
  {
    return left_out_;
  }

  /** \return the number of scans read that are not centred on the scanner */
  std::size_t
  withoutRays() const;

private:
  Points
  ownPoints(std::size_t place) const;

  RunFolder run_;
  Trajectory trajectory_;           ///< relative to the world offset
  double min_range_ = 0;            ///< [m]
  double max_range_ = 0;            ///< [m]
  std::vector<std::size_t> places_; ///< in the summary of the run, of the scans in use
  std::vector<std::optional<bool>> has_rays_; ///< empty: not tested yet
  std::size_t left_out_ = 0;
};

} // namespace pcl6d
