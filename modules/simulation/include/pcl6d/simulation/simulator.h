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

/** \brief How the robot takes a scan. */
enum class ScanMotion {
  kStop,      ///< it stands still, then drives on
  kContinuous ///< it drives on: every sample is taken from another place
};

/** \brief What odometry the robot has. */
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
  int num_scans = 40;     ///< evenly along the path, in [1, 100000]
  std::uint64_t seed = 1; ///< of all noise; the seed in `range` is not used
  std::shared_ptr<const ScannerModel> scanner; ///< null: a DrivenScanner's default
  RangeOptions range;
  RobotOptions robot;
  ScanMotion motion = ScanMotion::kStop;
  /// [m/s] in plan, in (0, 50]; none: 1, or less where a scan could not end before the
  /// next one starts
  std::optional<double> speed;
  /// \name Of kContinuous only; see RobotMotionOptions
  ///@{
  bool turns_in_place = false;     ///< it drives straight from waypoint to waypoint
  std::optional<double> turn_rate; ///< [rad/s] none: any, in place 30 deg/s
  double vibration = 0;            ///< [m]
  /** [s] from scan to scan, at least what one takes: with just that, scans follow each other
   * without a pause; none: evenly along the way, once round */
  std::optional<double> period;
  ///@}
  OdometryKind odometry_kind = OdometryKind::kWheel;
  OdometryOptions odometry;              ///< of kWheel
  VisualInertialOptions visual_inertial; ///< of kVisualInertial
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief A robot drives once through a scene, takes scans on its way, and keeps a
 * drifting odometry. Writes nothing; the same seed gives the same bytes on any x86-64
 * CPU.
 *
 * The world is the frame of the first scan: both trajectories start at identity. A pose
 * is that at the scan's stamp, which is the start of the scan; of a scan that was taken
 * on the move, the sample measured at time t since then comes from scanPose(i, t).
 * Stamps count from the start of the drive [s].
 * \code
 * pcl6d::Simulator simulator(pcl6d::builtInScene("corridor"));
 * for (std::size_t i = 0; i < simulator.size(); ++i)
 *   use(simulator.scan(i), simulator.truth().poses[i]);
 * \endcode \ingroup simulation */
class Simulator {
public:
  /** \throws BadArgument scene or options break a rule, or the speed is too high, or the
   * period too short, for a scan to end before the next one starts \throws ComputeFailed the path leaves the
   * floor or leads through a surface */
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

  /** \return the odometry at the same stamps */
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

  /** \return what there is to see; times are those of the stamps */
  const MovingScene&
  scene() const
  {
    return scene_;
  }

  /** \return what stands still of it */
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

  /** \return what it was made with, and the scanner that it took */
  const SimulationOptions&
  options() const
  {
    return options_;
  }

  /** \return where the sensor is in the coordinates of the scene, also between the scans.
   * \param[in] time [s] from the start of the drive, >= 0 */
  Eigen::Isometry3d
  poseAt(double time) const;

  /** \return T_world_scan during the i-th scan. \param[in] time [s] since its stamp
   * \throws BadArgument i >= size() */
  Eigen::Isometry3d
  scanPose(std::size_t i, double time) const;

  /** \brief Makes the i-th scan; nothing is kept. \throws BadArgument i >= size() */
  RangeScan
  rangeScan(std::size_t i) const;

  /** \brief The same as an organized cloud, each point in the frame of the scanner at
   * its own time. */
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
  std::optional<RobotMotion> motion_; // none: it stops for each scan
  Eigen::Isometry3d T_scene_world_;
  Trajectory truth_, odometry_;
};

} // namespace pcl6d
