// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/bag_options.h>
#include <pcl6d/io/scan_source.h>
#include <pcl6d/sources/bag.h>

#include <memory>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The clouds of a topic of a recording as scans: PointCloud2 of any layout, CustomMsg of
 * Livox, or LaserScan, each in the encoding of ROS 1 or in CDR (ROS 2).
 *
 * Scans are named scan000, scan001 and so on in the order of time. Clouds without points and
 * damaged messages are left out, and reported by note(). Initial poses T_world_scan come from
 * Odometry or PoseStamped, carried over to the sensor by the transforms of tf, or from the
 * chain of transforms alone, up to the frame odom or the root; poses between two messages are
 * interpolated. Scans without a pose are left out if some scan has a pose.
 * \ingroup sources */
class BagSource : public ScanSource {
public:
  /** \brief Reads the headers of all clouds, and all poses.
   * \throws IoFailed openBag() failed; no topic has clouds, or several have and no topic is
   * chosen; the chosen topic has no clouds; transforms form a loop; poses and clouds do not
   * overlap in time; header times are requested, but do not increase */
  explicit BagSource(const std::filesystem::path& path, const BagOptions& options = {});
  ~BagSource() override;

  const std::filesystem::path&
  path() const override;
  std::string
  format() const override;
  const std::vector<SourceScan>&
  scans() const override;
  std::string
  titleOf(std::size_t i) const override;
  std::string
  poseSource() const override;
  std::string
  note() const override;
  ScanCloud
  read(std::size_t i) const override;

private:
  struct Content;
  std::unique_ptr<const Content> content_;
};

} // namespace pcl6d
