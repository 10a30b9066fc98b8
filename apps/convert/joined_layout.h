// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Fields of the joined points of many scans: the fields common to the scans,
 * and the index of the scan, `scan`, as in map.pcd. */
class JoinedLayout {
public:
  /** \brief Adds the fields of a scan. */
  void
  addScan(const std::vector<pcl::PCLPointField>& fields);

  /** \brief To be called after the last scan, before the functions below. */
  void
  finish();

  const std::vector<pcl::PCLPointField>&
  fields() const
  {
    return fields_;
  }

  /** \return [byte] */
  std::size_t
  pointStep() const
  {
    return point_step_;
  }

  /** \return fields missing in the joined points, in words */
  std::vector<std::string>
  losses() const;

  /** \brief Moves positions and normals of the points [begin, end) of a scan into the
   * world; computed in double, rounded once. \param[in] kept selected points
   * \param[in] T_world_scan relative to the world offset \return the selected points in
   * the joined layout */
  pcl::PCLPointCloud2
  joined(const pcl::PCLPointCloud2& scan,
         const std::vector<bool>& kept,
         std::size_t begin,
         std::size_t end,
         const Eigen::Isometry3d& T_world_scan,
         std::uint32_t index) const;

private:
  void
  gather(const pcl::PCLPointCloud2& scan,
         const std::vector<bool>& kept,
         std::size_t begin,
         pcl::PCLPointCloud2& block) const;

  std::vector<pcl::PCLPointField> fields_;
  std::vector<std::string> incomplete_; ///< names of fields missing in some scans
  std::size_t point_step_ = 0;
  std::size_t index_offset_ = 0;
  bool first_ = true;
  bool replaces_index_ = false;
};

} // namespace pcl6d::app
