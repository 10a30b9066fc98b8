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

/** \brief Knobs of justifyByIcp(). */
struct JustificationOptions {
  double low = 0;            ///< [m] foot of the extruded walls above the ground
  double high = 10;          ///< [m] their top; > low
  double spacing = 0.25;     ///< [m] of their points; finite, > 0
  double voxel = 0.25;       ///< [m] of the reduction of the scans; finite, > 0
  std::size_t metascan = 10; ///< matched scans that stand beside the map; > 0
  IcpOptions icp;            ///< point to point
  JustificationOptions()
  {
    icp.max_distance = 0.5;
    icp.max_distance_start = 1;
    icp.translation_epsilon = 1e-3; // walls leave z open, along which ICP creeps
    icp.rotation_epsilon = 1e-4;
  }
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief A scan to be matched against the map. */
struct JustificationScan {
  Points points; ///< [m] in the scan's frame
  Eigen::Matrix3d R_level_scan = Eigen::Matrix3d::Identity();
};

/** \brief How far one way of matching is from the localisation, over the trusted scans. */
struct JustificationRow {
  std::string method;       ///< such as "map, no ground"
  ErrorStatistics position; ///< [m] in the plan
  ErrorStatistics yaw;      ///< [rad]
  std::size_t failed =
      0; ///< scans that ICP could not match: it found no pairs, or diverged
};

/** \return the walls as points: upright grids over the segments, relative to the map's
 * offset \throws BadArgument an option breaks its rule */
Points
extruded(const SegmentMap& map, const JustificationOptions& options);

/** \brief Justifies a localisation in the plan by ICP in 3D (book 6.4.4): matches every
 * trusted scan, from its localised pose with its ground at height 0, against the plan
 * extruded to walls; once against them alone, once together with the last scans matched
 * (metascan), and once without the points of the ground. Agreement within the noise of
 * both supports the localisation.
 * \param[in] estimates of all scans; those that are not trusted are passed over
 * \param[in] scan gives the i-th scan; called in order
 * \param[in] goOn called before each scan with (done, total); false stops
 * \return a row for each of the three, finished ones only
 * \throws BadArgument an option breaks its rule \ingroup benchmarking */
std::vector<JustificationRow>
justifyByIcp(const SegmentMap& map,
             const std::vector<MclEstimate>& estimates,
             const std::function<JustificationScan(std::size_t)>& scan,
             const JustificationOptions& options = JustificationOptions(),
             const std::function<bool(std::size_t, std::size_t)>& goOn = {});

} // namespace pcl6d
