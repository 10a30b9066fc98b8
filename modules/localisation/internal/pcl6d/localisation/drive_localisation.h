// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/localisation/monte_carlo_localisation.h>

#include <cstddef>
#include <vector>

/** \file The scans of a drive, localised in a plan (book 6.4). */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan of a drive, prepared for Monte Carlo localisation. */
struct DriveScan {
  Eigen::Isometry3d odometry = Eigen::Isometry3d::Identity(); ///< T_world_scan
  Eigen::Matrix3d R_level_scan = Eigen::Matrix3d::Identity(); ///< turns the scan
                                                              ///< upright
  VirtualScan virtual_scan;
};

/** \brief Sources of roll and pitch of a scan. */
struct DriveLevelling {
  Eigen::Matrix3d R_map_world =
      Eigen::Matrix3d::Identity(); ///< turns a tilted map upright
  bool by_poses = true; ///< false: poses are of wheel odometry, without roll and pitch
  bool by_walls = true; ///< walls correct the tilt of the poses
};

/** \return the scan with its levelling and its walls
 * \param[in] points [m] within the range gate, in the scan's frame
 * \param[in] odometry T_world_scan */
DriveScan
driveScan(const Points& points,
          const Eigen::Isometry3d& odometry,
          const DriveLevelling& levelling);

/** \brief Where the first scan was taken. */
enum class MclStart {
  kPoses,   ///< by the poses: the map is in their world
  kGiven,   ///< DriveStart::pose
  kAnywhere ///< to be found
};

/** \brief Where a drive starts. */
struct DriveStart {
  MclStart kind = MclStart::kPoses;
  Eigen::Vector3d pose = Eigen::Vector3d::Zero(); ///< x, y [m], yaw [rad] of kGiven
};

/** \brief A stretch of scans with doubtful poses, for one reason. */
struct DoubtfulStretch {
  std::size_t first = 0; ///< index in the drive
  std::size_t last = 0;
  MclDoubt doubt = MclDoubt::kNone;
};

/** \brief Where the scans of a drive were taken; relative to the offset of the map. */
struct LocalisedDrive {
  std::vector<MclEstimate> estimates;        ///< per scan, in the plan
  std::vector<Eigen::Isometry3d> T_map_scan; ///< per scan, with z, roll, pitch
  Eigen::Isometry3d T_map_world = Eigen::Isometry3d::Identity(); ///< of the odometry

  std::size_t
  numTrusted() const;
  std::vector<DoubtfulStretch>
  doubtfulStretches() const;
};

/** \brief Localises the scans of a drive in a plan, one after the other, and
 * computes their heights: each way measured by the odometry climbs with the mean
 * slope at its ends.
 * \param[in] R_map_world turns a tilted map upright
 * \param[in] progress called with each scan ("localising"); its exceptions propagate
 * \throws BadArgument an option is invalid, or a pose is not finite
 * \ingroup localisation */
LocalisedDrive
localiseDrive(const SegmentMap& map,
              const Eigen::Matrix3d& R_map_world,
              const std::vector<DriveScan>& scans,
              const DriveStart& start,
              const MclOptions& options = MclOptions(),
              const ProgressCallback& progress = {});

} // namespace pcl6d
