// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/deskew/motion_icp.h>
#include <pcl6d/deskew/motion_options.h>
#include <pcl6d/deskew/motion_sample.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {
namespace deskew {

/** \brief A scan taken in motion, in the common clock of all scans. */
struct MovingScan {
  TimedPoints measured; ///< times in the clock [s]
  double stamp = 0;     ///< [s] time of the scan's pose
  /** odometry step from this scan's stamp to the next scan's, and its duration [s]; none: no
   * odometry, or no next scan */
  std::optional<Eigen::Isometry3d> step;
  double step_time = 0;
};

/** \brief A scan with its estimated trajectory. */
struct TrackedScan {
  Trajectory knots;   ///< T_world_knot at times of the clock; equal poses if rigid
  TimedPoints sample; ///< subset of the measured points
  double stamp = 0;
  std::optional<Eigen::Isometry3d> step; ///< of the odometry, to the next scan
  double step_time = 0;                  ///< [s] of step
  bool is_matched = false;               ///< always true for the first scan
  bool is_moved = false;                 ///< deskewed with the knots
  bool is_timed = true;                  ///< the stamps are times of the clock
  bool is_guide = false; ///< its knots predict the motion of the next scan
  /** T_world_scan at the stamp: matched as a rigid scan, and with motion, both independently of
   * is_moved */
  Eigen::Isometry3d rigid_pose = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d moved_pose = Eigen::Isometry3d::Identity();
  Rejection rejection;       ///< why the scan is rigid or unmatched
  std::vector<double> fit;   ///< of the sample's test half, on the map before the scan
  AgreementChange gain;      ///< of the motion over a rigid scan
  AgreementChange odometry;  ///< from the odometry's pose to the found pose
  double odometry_error = 0; ///< [m] between both poses

  /** \return T_world_scan at the stamp */
  Eigen::Isometry3d
  pose() const;
};

/** \return the number of points sampled from a scan */
std::size_t
sampleSize(const Trajectory& knots);

/** \brief Finds the motion within scans, scan after scan. Each scan is matched with a map of the
 * earlier deskewed scans, from constant velocity or the odometry, whichever fits better. The world
 * is the frame of the first pose. The same bits for any number of threads. */
class MotionTracker {
public:
  /** \param[in] voxel [m] of the reduction \param[in] noise [m] of the points across surfaces
   * \param[in] knots [s] between the poses of a scan, at least two of which are found; none: a
   * third of a second */
  MotionTracker(double voxel,
                double noise,
                std::optional<double> knots,
                std::uint64_t seed,
                unsigned int num_threads);

  /** \brief Begins with a scan at a pose. The scan counts as rigid until the next scan is added;
   * then its own motion is estimated. */
  void
  begin(const MovingScan& scan, const Eigen::Isometry3d& pose);

  /** \brief The next scan. */
  void
  track(const MovingScan& scan);

  /** \brief Assumes no stop between the first two scans, and motion in every scan unless its points
   * agree less with motion. To be called between these two scans. */
  void
  assumeMoving()
  {
    assumes_moving_ = true;
  }

  /** \return whether a scan began at about the end of the previous scan */
  bool
  isContinued(const MovingScan& scan) const;

  /** \brief Adds a rigid scan with known pose in place of the next scan, without a time. */
  void
  take(const Points& points, const Eigen::Isometry3d& pose);

  /** \brief Ends the sequence: no later scans are awaited. Matches the waiting scans again. */
  void
  finish();

  /** \return the number of leading scans with a final result. A scan with more than two knots is
   * final once later scans are known, any other at once; the first scan needs a second */
  std::size_t
  numSettled() const
  {
    return num_settled_;
  }

  /** \return the scans added until now */
  const std::vector<TrackedScan>&
  scans() const
  {
    return scans_;
  }

  const SurfaceMapOptions&
  mapOptions() const
  {
    return map_options_;
  }

  /** \return range of the scans [m] */
  double
  reach() const
  {
    return reach_;
  }

  /** \return deviation of the points across surfaces [m] */
  double
  noise() const
  {
    return icp_.noise;
  }

  /** \return the change of velocities, learnt from the scans */
  MotionNoise
  motionNoise() const;

private:
  /** The motion between two knots is a turn about one axis: beyond a right angle the chord is far
   * from any path. */
  static constexpr double kLargestTurn = 1.5708; // [rad]

  /** Number of later scans, and half the number of earlier scans, in the map around a scan. */
  static constexpr std::size_t kLater = 5;

  struct Attempt {
    MotionIcpResult found;
    double fit = -1;          ///< mean over the points on planes; -1: not matched
    double broken = 0;        ///< violation of the prior: negative log-likelihood
    double score = -INFINITY; ///< log-likelihood of the match
  };

  Trajectory
  restingKnots(const MovingScan& scan, const Eigen::Isometry3d& pose) const;
  std::vector<Trajectory>
  startsOf(const MovingScan& scan) const;
  void
  sortByFit(const TimedPoints& half, std::vector<Trajectory>& starts) const;
  Trajectory
  best(std::vector<Trajectory> starts, const TimedPoints& half) const;
  Attempt
  attempt(const Trajectory& start, bool goes_on, const TimedPoints& half) const;
  Attempt
  attemptBoth(const Trajectory& rough, bool goes_on, const TimedPoints& half) const;
  double
  usualFit() const;
  MotionStart
  startOf(const Trajectory& knots, bool goes_on) const;
  Trajectory
  refined(const Trajectory& start, bool goes_on, const TimedPoints& half) const;
  Eigen::Isometry3d
  nextPose(const Trajectory& knots,
           std::size_t from,
           std::size_t to,
           std::size_t next,
           const TimedPoints& half) const;
  Trajectory
  grown(const Trajectory& start, bool goes_on, const TimedPoints& half) const;
  Trajectory
  grownBack(const Trajectory& start, const TimedPoints& half) const;
  bool
  isSteered(const TrackedScan& scan) const;
  SurfaceMap
  mapAround(std::size_t number) const;
  void
  lookAgain(std::size_t number);
  void
  settle(std::size_t later);
  TrackedScan
  foundAgain(TrackedScan scan) const;
  MotionIcpResult
  matchRigid(const MovingScan& scan,
             const TimedPoints& half,
             const MotionIcpResult& found) const;
  bool
  isMoved(const MovingScan& scan,
          const TimedPoints& half,
          const Trajectory& rigid,
          TrackedScan& found) const;
  bool
  isSure(const AgreementChange& gain) const;
  void
  compareWithOdometry(const TimedPoints& half, TrackedScan& found) const;
  MotionIcpResult
  match(const MovingScan& scan, const TimedPoints& half, MotionIcpResult& rigid) const;
  double
  turnOfOdometry(const MovingScan& scan) const;
  static void
  leaveTurned(double turn, TrackedScan& found);
  TrackedScan
  find(const MovingScan& scan);
  void
  learnNoise(const TrackedScan& scan);
  void
  restartFirst();
  void
  findFirst(const MovingScan& second);
  void
  reachTo(double range);
  void
  keep(TrackedScan scan, const MovingScan& measured);
  void
  addToMap(const TrackedScan& scan, const MovingScan& measured);

  std::optional<double> knot_time_;
  SurfaceMapOptions map_options_;
  SurfaceMap map_;
  MotionSampler sampler_;
  MotionIcpOptions icp_;
  bool assumes_moving_ = false;
  double cube_; ///< [m] edge of the cubes whose points count as a single observation
  std::vector<TrackedScan> scans_;
  std::size_t num_settled_ = 0;
  MovingScan first_; ///< until the second scan is tracked
  std::vector<double> linear_changes_, angular_changes_;
  double reach_ = 0;                                  ///< [m] range of the scans
  Eigen::Vector3d cleared_ = Eigen::Vector3d::Zero(); ///< where the map was last cut
};

} // namespace deskew
} // namespace pcl6d
