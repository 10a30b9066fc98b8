// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/mcl/mcl_evaluation.h"

#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
/** Compares the localised poses with a reference, in the map.
 * \param[in] reference one pose per scan, in the world of the odometry */
MclErrors
mclErrors(const MclEvaluation& e, const Trajectory& reference, bool only_trusted)
{
  std::vector<double> position_2d, yaw, position, orientation;
  for (std::size_t i = 0; i < e.scans.size(); ++i) {
    if (only_trusted && !e.drive.estimates[i].trusted())
      continue;
    const PoseError error =
        poseError(e.drive.T_map_scan[i], e.drive.T_map_world * reference.poses[i]);
    position_2d.push_back(error.position_2d);
    yaw.push_back(error.yaw);
    position.push_back(error.position);
    orientation.push_back(error.orientation);
  }
  return {yaw.size(),
          errorStatistics(position_2d),
          errorStatistics(yaw),
          errorStatistics(position),
          errorStatistics(orientation)};
}

/** \return the reference poses of the scans
 * \throws IoFailed the file is broken or has not one pose per scan */
Trajectory
readReference(const std::string& file, const ScanFolder& folder)
{
  const Trajectory all = readTrajectory(file);
  if (all.poses.size() == folder.size())
    return all;
  if (all.poses.size() != folder.odometry().poses.size())
    throw IoFailed(file + ": holds " + std::to_string(all.poses.size()) +
                   " poses, but must hold a pose for each of the " +
                   std::to_string(folder.size()) + " scans");
  Trajectory selected;
  for (std::size_t i = 0; i < folder.size(); ++i)
    selected.poses.push_back(all.poses[static_cast<std::size_t>(folder.index(i))]);
  return selected;
}

/** Wheel odometry, which does not measure roll and pitch. */
bool
isPlanar(const ScanFolder& folder)
{
  for (std::size_t i = 0; i < folder.size(); ++i) {
    const Eigen::Vector3d up = folder.initialPose(i).linear().row(2).transpose();
    if ((up - Eigen::Vector3d::UnitZ()).norm() > 1e-9)
      return false;
  }
  return true;
}

/** Reads the scans and makes a virtual scan of each. */
class ScanReader {
public:
  ScanReader(const MclSettings& settings,
             const ScanFolder& folder,
             const Eigen::Matrix3d& R_map_world)
  : folder_(folder)
  {
    levelling_.R_map_world = R_map_world;
    levelling_.by_poses = !settings.level_by_walls || !isPlanar(folder);
    levelling_.by_walls = settings.level_by_walls;
    Slam6DOptions gate = settings.gate;
    gate.planar_rows = 0; // points as measured
    gate_ = deriveParameters(gate, {folder.read(0).points});
  }

  const Slam6DParameters&
  gate() const
  {
    return gate_;
  }

  Points
  points(std::size_t i) const
  {
    return gateScan(folder_.read(i).points, folder_.file(i).string(), gate_);
  }

  DriveScan
  scan(std::size_t i) const
  {
    return driveScan(points(i), folder_.initialPose(i), levelling_);
  }

private:
  const ScanFolder& folder_;
  DriveLevelling levelling_;
  Slam6DParameters gate_;
};

/** \return false if a signal came in */
bool
readScans(const ScanReader& reader,
          std::size_t count,
          const MclSettings& s,
          ProgressBar& bar,
          const Interrupt& interrupt,
          MclEvaluation& e)
{
  constexpr std::size_t kTogether = 16; // between two looks at the signals
  e.scans.resize(count);
  for (std::size_t begin = 0; begin < count; begin += kTogether) {
    if (interrupt.requested())
      return false;
    const std::size_t end = std::min(begin + kTogether, count);
    parallelFor(end - begin, s.mcl.num_threads, [&](std::size_t i) {
      e.scans[begin + i] = reader.scan(begin + i);
    });
    bar.show({"reading", end, count});
  }
  return true;
}

/** \return false if a signal came in */
bool
justify(const MclSettings& s,
        const ScanReader& reader,
        ProgressBar& bar,
        const Interrupt& interrupt,
        MclEvaluation& e)
{
  JustificationOptions options;
  options.icp.num_threads = s.mcl.num_threads;
  e.justification = justifyByIcp(
      e.map,
      e.drive.estimates,
      [&](std::size_t i) {
        return JustificationScan{reader.points(i), e.scans[i].R_level_scan};
      },
      options,
      [&](std::size_t done, std::size_t total) {
        bar.show({"matching", done, total});
        return !interrupt.requested();
      });
  return !interrupt.requested();
}
} // namespace

std::optional<MclEvaluation>
evaluateMcl(const MclSettings& s, ProgressBar& bar, const Interrupt& interrupt)
{
  const MclMap map = readMclMap(s);
  const ScanFolder folder(s.folder, s.scans);
  if (!folder.hasPoses())
    throw IoFailed(s.folder +
                   ": no poses were found, but the odometry is needed to move "
                   "from scan to scan; give --poses");
  std::optional<Trajectory> reference;
  if (!s.reference.empty())
    reference = readReference(s.reference, folder);
  MclEvaluation e(map);
  e.pose_source = folder.poseSource();
  const ScanReader reader(s, folder, map.R_map_world);
  e.gate = reader.gate();
  e.stamps = folder.stamps();
  for (std::size_t i = 0; i < folder.size(); ++i) {
    e.indices.push_back(folder.index(i));
    e.names.push_back(folder.name(i));
  }
  if (!readScans(reader, folder.size(), s, bar, interrupt, e))
    return std::nullopt;
  e.drive = localiseDrive(e.map,
                          map.R_map_world,
                          e.scans,
                          {s.start, s.start_pose},
                          s.mcl,
                          [&bar](const Progress& progress) { bar.show(progress); });
  if (reference) {
    e.all = mclErrors(e, *reference, false);
    e.trusted = mclErrors(e, *reference, true);
  }
  if (s.justify && !justify(s, reader, bar, interrupt, e))
    return std::nullopt;
  return e;
}

} // namespace pcl6d::app
