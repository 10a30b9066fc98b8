// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <filesystem>
#include <vector>

namespace pcl6d::app {

/** \brief A finished run of pcl_slam6d (share/doc/run_folder.md): the parts for a
 * semantic map. */
class FinishedRun {
public:
  /** \throws IoFailed the folder is no run, or was interrupted */
  explicit FinishedRun(const std::filesystem::path& folder);

  const std::filesystem::path&
  folder() const
  {
    return run_.path();
  }

  /** \return the scans in the order of their ids */
  const std::vector<MapScan>&
  scans() const
  {
    return scans_;
  }

  /** \return whole metres subtracted from the clouds of the run */
  const Eigen::Vector3d&
  worldOffset() const
  {
    return run_.summary().world_offset;
  }

  /** \brief Reads links.csv and graph.g2o; without links.csv the run has no links.
   * \return the links in use \throws IoFailed a file is broken */
  std::vector<MapLink>
  readLinks() const;

  /** \return map.pcd; its points are relative to worldOffset() \throws IoFailed */
  Scan
  readMap() const;

  /** \return a scan in its own frame \throws IoFailed */
  Scan
  readScan(std::size_t place) const;

private:
  std::string
  faultOf(const RunLink& link) const;

  RunFolder run_;
  std::vector<MapScan> scans_;
  std::vector<std::size_t> places_; ///< of the scans in the summary
};

} // namespace pcl6d::app
