// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/trajectory.h>
#include <pcl6d/scanner/odometry_model.h>
#include <pcl6d/scanner/range_scan.h>
#include <pcl6d/scanner/robot_path.h>
#include <pcl6d/scanner/simulation_scene.h>

#include <cstdint>
#include <memory>

namespace pcl6d {

/** \brief Knobs of Simulator. */
struct SimulationOptions {
  int num_scans = 40;     ///< evenly along the path, in [1, 100000]
  std::uint64_t seed = 1; ///< of all noise; the seed in `range` is not used
  std::shared_ptr<const ScannerModel> scanner; ///< null: a DrivenScanner's default
  RangeOptions range;
  RobotOptions robot;
  OdometryOptions odometry;
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief A robot drives once through a scene, stops for each scan, and keeps a
 * drifting odometry. Writes nothing; the same seed gives the same bytes on any x86-64
 * CPU.
 *
 * The world is the frame of the first scan: both trajectories start at identity.
 * \code
 * pcl6d::Simulator simulator(pcl6d::builtInScene("corridor"));
 * for (std::size_t i = 0; i < simulator.size(); ++i)
 *   use(simulator.scan(i), simulator.truth().poses[i]);
 * \endcode \ingroup scanner */
class Simulator {
public:
  /** \throws BadArgument scene or options break a rule \throws ComputeFailed the path
   * leaves the floor */
  explicit Simulator(SimulationScene scene, const SimulationOptions& options = {});

  std::size_t
  size() const
  {
    return truth_.poses.size();
  }

  /** \return T_world_scan, six degrees of freedom */
  const Trajectory&
  truth() const
  {
    return truth_;
  }

  /** \return planar odometry, see wheelOdometry() */
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

  const RayCaster&
  caster() const
  {
    return caster_;
  }

  /** \brief Makes the i-th scan; nothing is kept. \throws BadArgument i >= size() */
  RangeScan
  rangeScan(std::size_t i) const;

  /** \brief The same as an organized cloud in the scan's frame. */
  pcl::PointCloud<pcl::PointXYZI>
  scan(std::size_t i) const;

private:
  RayCaster caster_;
  SimulationOptions options_;
  Eigen::Isometry3d T_scene_world_;
  Trajectory truth_, odometry_;
};

} // namespace pcl6d
