// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/scanner/range_scan.h>
#include <pcl6d/simulation/moving_scene.h>
#include <pcl6d/simulation/odometry_model.h>
#include <pcl6d/simulation/robot_motion.h>
#include <pcl6d/simulation/simulation_scene.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Motion of the robot during a scan. */
enum class ScanMotion {
  kStop,      ///< stands still, then drives on
  kContinuous ///< drives on: every sample is taken from another pose
};

/** \brief The robot's odometry. */
enum class OdometryKind {
  kWheel,          ///< planar, see wheelOdometry()
  kVisualInertial, ///< six degrees of freedom, see visualInertialOdometry()
  kExact           ///< the truth
};

/** \return the motion called "stop" or "continuous" \throws BadArgument another name */
ScanMotion
scanMotionFromName(const std::string& name);

/** \return the odometry called "wheel", "visual-inertial" or "exact" \throws BadArgument
 * another name */
OdometryKind
odometryKindFromName(const std::string& name);

/** \brief Knobs of Simulator. */
struct SimulationOptions {
  int num_scans = 40; ///< evenly along the path, in [1, 100000]
  std::optional<int>
      last; ///< index of the last scan, >= 0; the scans before it stay the same
  std::uint64_t seed = 1; ///< of every noise; the seed in `range` is not used
  std::shared_ptr<const ScannerModel> scanner; ///< null: a DrivenScanner's default
  RangeOptions range;
  RobotOptions robot;
  ScanMotion motion = ScanMotion::kStop;
  /// [m/s] in plan, in (0, 50]; default: 1, or less where a scan could not end before
  /// the next scan starts
  std::optional<double> speed;
  /// \name For kContinuous only; see RobotMotionOptions
  ///@{
  bool turns_in_place = false;     ///< drive straight from waypoint to waypoint
  std::optional<double> turn_rate; ///< [rad/s] default: unlimited; in place 30 deg/s
  double vibration = 0;            ///< [m]
  /** [s] from scan to scan, at least the duration of a scan, which leaves no pause;
   * default: evenly along the way, once round */
  std::optional<double> period;
  ///@}
  OdometryKind odometry_kind = OdometryKind::kWheel;
  OdometryOptions odometry;              ///< of kWheel
  VisualInertialOptions visual_inertial; ///< of kVisualInertial
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Simulates one drive of a robot through a scene, with scans and drifting
 * odometry. Writes no files; equal seeds give equal bytes on any x86-64 CPU.
 *
 * The world is the frame of the first scan: both trajectories start at identity. A
 * scan's pose is the pose at its stamp, which is the start of the scan. In a scan taken
 * in motion, the pose of a sample measured t after the stamp is scanPose(i, t). Stamps
 * count from the start of the drive [s].
 * \code
 * pcl6d::Simulator simulator(pcl6d::builtInScene("corridor"));
 * for (std::size_t i = 0; i < simulator.size(); ++i)
 *   use(simulator.scan(i), simulator.truth().poses[i]);
 * \endcode
 * \ingroup simulation */
class Simulator {
public:
  /** \throws BadArgument scene or options are invalid; speed too high, or period too
   * short, for a scan to end before the next scan starts \throws ComputeFailed the path
   * leaves the floor or leads through a surface */
  explicit Simulator(SimulationScene scene, const SimulationOptions& options = {});

  std::size_t
  size() const
  {
    return truth_.poses.size();
  }

  /** \return T_world_scan, six degrees of freedom, at the stamps [s] */
  const Trajectory&
  truth() const
  {
    return truth_;
  }

  /** \return the odometry at the stamps of truth() */
  const Trajectory&
  odometry() const
  {
    return odometry_;
  }

  /** \return the world's frame in the coordinates of the scene */
  const Eigen::Isometry3d&
  sceneFromWorld() const
  {
    return T_scene_world_;
  }

  /** \return the scene; times are in the time of the stamps */
  const MovingScene&
  scene() const
  {
    return scene_;
  }

  /** \return the static part of the scene */
  const RayCaster&
  caster() const
  {
    return scene_.ground();
  }

  const ScannerModel&
  scanner() const
  {
    return *options_.scanner;
  }

  /** \return the speed in plan [m/s], given or derived */
  double
  speed() const
  {
    return speed_;
  }

  /** \return the given options, with the scanner in use */
  const SimulationOptions&
  options() const
  {
    return options_;
  }

  /** \return T_scene_sensor, also between the scans.
   * \param[in] time [s] from the start of the drive, >= 0 */
  Eigen::Isometry3d
  poseAt(double time) const;

  /** \return T_world_scan during the i-th scan. \param[in] time [s] since its stamp
   * \throws BadArgument i >= size() */
  Eigen::Isometry3d
  scanPose(std::size_t i, double time) const;

  /** \brief Makes the i-th scan; not cached. \throws BadArgument i >= size() */
  RangeScan
  rangeScan(std::size_t i) const;

  /** \brief Makes the i-th scan as an organized cloud, each point in the frame of the
   * scanner at its own time. */
  pcl::PointCloud<pcl::PointXYZI>
  scan(std::size_t i) const;

private:
  void
  stopAndScan();
  void
  scanOnTheMove();
  double
  speedOnTheMove() const;

  MovingScene scene_;
  SimulationOptions options_;
  RobotPath path_;
  double speed_ = 1;
  std::optional<RobotMotion> motion_; // nullopt: stops for each scan
  Eigen::Isometry3d T_scene_world_;
  Trajectory truth_, odometry_;
};

} // namespace pcl6d
