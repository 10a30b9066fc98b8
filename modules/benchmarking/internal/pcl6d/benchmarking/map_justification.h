// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/localisation/monte_carlo_localisation.h>
#include <pcl6d/registration/icp_options.h>

#include <functional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Options of justifyByIcp(). */
struct JustificationOptions {
  double low = 0;            ///< [m] foot of the extruded walls above the ground
  double high = 10;          ///< [m] their top; > low
  double spacing = 0.25;     ///< [m] of their points; finite, > 0
  double voxel = 0.25;       ///< [m] of the reduction of the scans; finite, > 0
  std::size_t metascan = 10; ///< number of matched scans added to the map; > 0
  IcpOptions icp;            ///< point to point
  JustificationOptions()
  {
    icp.max_distance = 0.5;
    icp.max_distance_start = 1;
    // walls leave z undetermined, and ICP drifts along z
    icp.translation_epsilon = 1e-3;
    icp.rotation_epsilon = 1e-4;
  }
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A scan to be matched against the map. */
struct JustificationScan {
  Points points; ///< [m] in the scan's frame
  Eigen::Matrix3d R_level_scan = Eigen::Matrix3d::Identity();
};

/** \brief Difference between one way of matching and the localisation, over the trusted
 * scans. */
struct JustificationRow {
  std::string method;       ///< of matching, e.g. "map, no ground"
  ErrorStatistics position; ///< [m] in the plan
  ErrorStatistics yaw;      ///< [rad]
  std::size_t failed = 0;   ///< scans without pairs, or with diverging ICP
};

/** \return the walls as points: upright grids over the segments, relative to the map's
 * offset \throws BadArgument an option is invalid */
Points
extruded(const SegmentMap& map, const JustificationOptions& options);

/** \brief Justifies a localisation in the plan by ICP in 3D (book 6.4.4). Every trusted
 * scan is matched, from its localised pose with its ground at height 0, against the
 * plan extruded to walls. Three ways: against the walls alone, against walls and the
 * last matched scans (metascan), and without ground points. Agreement within the noise
 * of both supports the localisation.
 * \param[in] estimates of every scan; scans that are not trusted are skipped
 * \param[in] scan returns the i-th scan; called in order
 * \param[in] goOn called before each scan with (done, total); false stops
 * \return a row for each finished way
 * \throws BadArgument an option is invalid \ingroup benchmarking */
std::vector<JustificationRow>
justifyByIcp(const SegmentMap& map,
             const std::vector<MclEstimate>& estimates,
             const std::function<JustificationScan(std::size_t)>& scan,
             const JustificationOptions& options = JustificationOptions(),
             const std::function<bool(std::size_t, std::size_t)>& goOn = {});

} // namespace pcl6d
