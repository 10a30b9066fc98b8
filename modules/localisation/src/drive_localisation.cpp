// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/pose.h>
#include <pcl6d/localisation/drive_localisation.h>
#include <pcl6d/localisation/levelling.h>

#include <algorithm>

namespace pcl6d {

namespace {
/** \return the pose in the plan: x, y, yaw */
Eigen::Vector3d
planPoseOf(const Eigen::Isometry3d& T)
{
  return {T.translation().x(), T.translation().y(), eulerFromRotation(T.linear()).yaw};
}

/** \return the pose in space of a scan with a pose in the plan */
Eigen::Isometry3d
standing(const Eigen::Vector3d& plan_pose,
         double z,
         const Eigen::Matrix3d& R_level_scan)
{
  Eigen::Isometry3d T = planarPose(plan_pose.x(), plan_pose.y(), plan_pose.z());
  T.translation().z() = z;
  T.linear() *= R_level_scan;
  return T;
}

/** \return the start in the frame of the map, if known */
std::optional<Eigen::Vector3d>
startIn(const SegmentMap& map,
        const DriveStart& start,
        const Eigen::Isometry3d& T_map_first)
{
  if (start.kind == MclStart::kPoses)
    return planPoseOf(T_map_first);
  if (start.kind == MclStart::kAnywhere)
    return {};
  Eigen::Vector3d pose = start.pose;
  pose.head<2>() -= map.offset();
  return pose;
}

/** \return the heights of the scans above the first */
std::vector<double>
heightsOf(const std::vector<DriveScan>& scans)
{
  std::vector<double> heights(1, 0);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const DriveScan &a = scans[i - 1], &b = scans[i];
    const Eigen::Isometry3d motion = a.odometry.inverse() * b.odometry;
    const Eigen::Vector3d way = motion.translation();
    const double climb_a = (a.R_level_scan * way).z();
    const double climb_b = (b.R_level_scan * motion.linear().transpose() * way).z();
    heights.push_back(heights.back() + (climb_a + climb_b) / 2);
  }
  return heights;
}

/** Gives the localised scans their poses in space, and finds the pose of the world in the map
 * (unless given by the poses) from the given start, or from the first trusted scan. */
void
placeScans(const std::vector<DriveScan>& scans,
           MclStart kind,
           const std::optional<Eigen::Vector3d>& start,
           LocalisedDrive& drive)
{
  std::size_t anchor = 0;
  if (kind == MclStart::kAnywhere)
    while (anchor + 1 < scans.size() && !drive.estimates[anchor].trusted())
      ++anchor;
  const std::vector<double> heights = heightsOf(scans);
  const DriveScan& fixed = scans[anchor];
  double z = 0;
  if (kind == MclStart::kPoses)
    z = (drive.T_map_world * fixed.odometry).translation().z();
  for (std::size_t i = 0; i < scans.size(); ++i)
    drive.T_map_scan.push_back(standing(drive.estimates[i].pose,
                                        z + heights[i] - heights[anchor],
                                        scans[i].R_level_scan));
  if (kind == MclStart::kPoses)
    return;
  const Eigen::Vector3d pose =
      kind == MclStart::kGiven ? *start : drive.estimates[anchor].pose;
  drive.T_map_world = standing(pose, z, fixed.R_level_scan) * fixed.odometry.inverse();
}
} // namespace

DriveScan
driveScan(const Points& points,
          const Eigen::Isometry3d& odometry,
          const DriveLevelling& levelling)
{
  DriveScan scan;
  scan.odometry = odometry;
  if (levelling.by_poses)
    scan.R_level_scan =
        levellingOf((levelling.R_map_world * odometry.linear()).row(2).transpose());
  if (levelling.by_walls)
    scan.R_level_scan = levelByWalls(points, scan.R_level_scan).R_level_source;
  scan.virtual_scan = virtualScan(points, scan.R_level_scan);
  return scan;
}

std::size_t
LocalisedDrive::numTrusted() const
{
  return static_cast<std::size_t>(
      std::count_if(estimates.begin(), estimates.end(), [](const auto& estimate) {
        return estimate.trusted();
      }));
}

std::vector<DoubtfulStretch>
LocalisedDrive::doubtfulStretches() const
{
  std::vector<DoubtfulStretch> stretches;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const MclDoubt doubt = estimates[i].doubt;
    if (doubt == MclDoubt::kNone)
      continue;
    if (i > 0 && estimates[i - 1].doubt == doubt)
      stretches.back().last = i;
    else
      stretches.push_back({i, i, doubt});
  }
  return stretches;
}

LocalisedDrive
localiseDrive(const SegmentMap& map,
              const Eigen::Matrix3d& R_map_world,
              const std::vector<DriveScan>& scans,
              const DriveStart& start,
              const MclOptions& options,
              const ProgressCallback& progress)
{
  LocalisedDrive drive;
  if (scans.empty())
    return drive;
  drive.T_map_world.linear() = R_map_world;
  drive.T_map_world.translation().head<2>() = -map.offset();
  const auto known = startIn(map, start, drive.T_map_world * scans.front().odometry);
  MonteCarloLocalisation filter(map, known, options);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    Eigen::Vector3d motion = Eigen::Vector3d::Zero();
    if (i > 0)
      motion = planarMotion(scans[i - 1].odometry.inverse() * scans[i].odometry,
                            scans[i - 1].R_level_scan,
                            scans[i].R_level_scan);
    drive.estimates.push_back(filter.addScan(motion, scans[i].virtual_scan));
    if (progress)
      progress({"localising", i + 1, scans.size()});
  }
  distrustShortStretches(drive.estimates, options.min_stretch);
  placeScans(scans, start.kind, known, drive);
  return drive;
}

} // namespace pcl6d
