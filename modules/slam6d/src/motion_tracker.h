// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "motion_sample.h"

#include <pcl6d/common/export.h>
#include <pcl6d/registration/motion_icp.h>
#include <pcl6d/slam6d/motion_options.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** \brief A scan that was taken on the move, in a clock that all scans share. */
struct MovingScan {
  TimedPoints measured; ///< times in the clock [s]
  double stamp = 0;     ///< [s] the time of its pose
  /** step of the odometry from this scan's stamp to that of the next, and the time it
   * took [s]; none: there is no odometry, or no next scan */
  std::optional<Eigen::Isometry3d> step;
  double step_time = 0;
};

/** \brief What was found of a scan. */
struct PCL6D_EXPORTS TrackedScan { // shown to the test of MotionTracker
  Trajectory knots; ///< T_world_knot at times of the clock; poses alike if it is rigid
  TimedPoints sample; ///< some of the measured points
  double stamp = 0;
  std::optional<Eigen::Isometry3d> step; ///< of the odometry, to the next scan
  double step_time = 0;                  ///< [s] of it
  bool is_matched = false;               ///< the first one is
  bool is_moved = false;                 ///< its motion counts
  bool is_timed = true;                  ///< its stamps are those of the clock
  bool is_guide = false;                 ///< its knots tell how the next scan goes on
  /** at its stamp, as if it had not moved, and as if it had, whatever counts */
  Eigen::Isometry3d rigid_pose = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d moved_pose = Eigen::Isometry3d::Identity();
  std::string reason; ///< why it does not, or why it was not matched
  std::vector<double>
      fit; ///< of the points of the sample that judge, on the map before it
  AgreementChange gain;      ///< of the motion over a rigid scan
  AgreementChange odometry;  ///< from where the odometry led to where it was found
  double odometry_error = 0; ///< [m] between these

  /** \return T_world_scan at its stamp */
  Eigen::Isometry3d
  pose() const;
};

/** \return how many points of a scan are looked at */
std::size_t
sampleSize(const Trajectory& knots);

/** \brief Finds the motion within scans, scan after scan: each against a map of those before
 * whose motion is undone already, from constant velocity or the odometry, whichever fits
 * better. The world is that of the first pose. The same bits for any number of threads. */
class PCL6D_EXPORTS MotionTracker { // shown to its test
public:
  /** \param[in] voxel [m] of the reduction \param[in] noise [m] of the points across surfaces
   * \param[in] knots [s] between the poses of a scan, of which at least two are found; none: a
   * third of a second */
  MotionTracker(double voxel,
                double noise,
                std::optional<double> knots,
                std::uint64_t seed,
                unsigned int num_threads);

  /** \brief Begins with a scan at a pose. It is taken as rigid until the next one comes, of
   * which it is told then how it moved itself. */
  void
  begin(const MovingScan& scan, const Eigen::Isometry3d& pose);

  /** \brief The next scan. */
  void
  track(const MovingScan& scan);

  /** \brief Takes the first scan to have moved on to the second one as if without a stop, and all
   * to move unless their points agree less so. To be asked for between these two. */
  void
  assumeMoving()
  {
    assumes_moving_ = true;
  }

  /** \return whether a scan began about when the one before ended */
  bool
  isContinued(const MovingScan& scan) const;

  /** \brief A scan whose pose is known and which has not moved, in place of the next one. Its
   * time is not known. */
  void
  take(const Points& points, const Eigen::Isometry3d& pose);

  /** \brief No more scans are to be waited for: looks again at those that were not yet. */
  void
  finish();

  /** \return the number of scans, from the first on, that stand. Where a scan has more than two
   * knots, that is when some after it are known, too; else all do, but for the first without a
   * second one */
  std::size_t
  numSettled() const
  {
    return num_settled_;
  }

  /** \return the scans so far */
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

  /** \return how far its scans reach [m] */
  double
  reach() const
  {
    return reach_;
  }

  /** \return of the points across surfaces [m] */
  double
  noise() const
  {
    return icp_.noise;
  }

  /** \return how much velocities change, as the scans so far show it */
  MotionNoise
  motionNoise() const;

private:
  /** Between two knots the motion is one turn about one axis: beyond a right angle the chord is
   * far from any path. */
  static constexpr double kLargestTurn = 1.5708; // [rad]

  /** So many scans after one, and twice as many before it, show what lies around it. */
  static constexpr std::size_t kLater = 5;

  struct Attempt {
    MotionIcpResult found;
    double fit = -1;   ///< mean over the points on planes; -1: nothing was found
    double broken = 0; ///< how much its rules are: a logarithm of how seldom that is
    double score = -INFINITY; ///< a logarithm of how likely it is
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
  double cube_; ///< [m] whose points count as one
  std::vector<TrackedScan> scans_;
  std::size_t num_settled_ = 0;
  MovingScan first_; ///< until the second one is tracked
  std::vector<double> linear_changes_, angular_changes_;
  double reach_ = 0;                                  ///< [m] of the scans so far
  Eigen::Vector3d cleared_ = Eigen::Vector3d::Zero(); ///< where the map was last cut
};

} // namespace pcl6d::slam6d
