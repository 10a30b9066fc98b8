// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/trajectory.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Measured points of a sweep. */
struct Sweep {
  Points points; ///< [m] each in the sensor's frame at its own time
  /** [s] since the stamp, one per point; empty: every point is taken as measured at the stamp */
  std::vector<double> times;
  std::optional<double> stamp; ///< [s] missing: the sweep begins where the
                               ///< sweep before ended
  /** T_world_sensor at the stamp, from another source, where matching starts, and which decides
   * where surfaces leave a direction free; missing: constant velocity */
  std::optional<Eigen::Isometry3d> prediction;
};

/** \brief Result of tracking a sweep. */
enum class SweepStatus {
  kFirst,      ///< first sweep of a map: the first of the drive, or after the track
               ///< was lost for good
  kTracked,    ///< matched with the map
  kFoundAgain, ///< matched, after lost sweeps
  kLost        ///< not matched: the pose is the prediction; the map is unchanged
};

/** \return "first", "tracked", "found again" or "lost" */
PCL6D_EXPORTS const char*
toString(SweepStatus status);

/** \brief A sweep with its pose. */
struct TrackedSweep {
  SweepStatus status = SweepStatus::kLost;
  Eigen::Isometry3d T_world_sweep = Eigen::Isometry3d::Identity(); ///< at the stamp
  Eigen::Isometry3d T_world_begin =
      Eigen::Isometry3d::Identity();                             ///< at its first time
  Eigen::Isometry3d T_world_end = Eigen::Isometry3d::Identity(); ///< at its last time
  double begin = 0, end = 0; ///< [s] since the stamp: first and last time
  /** T_world_sensor at times [s] since the stamp, from begin to end: the motion within the sweep;
   * empty where points have no times */
  Trajectory path;
  std::size_t segment = 0; ///< sweeps of one segment share a map
  std::size_t points = 0;  ///< finite points within the range gate
  std::size_t inliers = 0; ///< of the points compared with the map
  double overlap = 0;      ///< share of inliers
  double distance = 0; ///< [m] median of the points from the planes of the map; 0 of
                       ///< a sweep without a match
  double deviation =
      0; ///< [m] of the begin and end from the prediction, at the typical range
  /** of begin, for motions (translation [m], rotation [rad]) in world axes about the sensor */
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  int free_directions = 0; ///< of the pose, not fixed by a surface, but by the
                           ///< prediction or constant velocity
  /** [m] in the frame at the stamp: points of the sweep without the motion within, reduced to the
   * resolution of the map; of a lost sweep none */
  Points reduced;
  bool corrects_opening = false; ///< SweepTracker::openingOfSegment() has changed
  bool is_keyframe = false;      ///< much of the sweep is new; the keyframes
                                 ///< together cover the map
};

/** \brief Knobs of SweepTracker. */
struct SweepTrackerOptions {
  std::optional<double> voxel; ///< [m] of the map; missing: from the line spacing and
                               ///< range of the first sweep
  double max_range = 1e4;      ///< [m] points beyond do not count; > 0
  std::size_t points_of_match = 3000; ///< of a sweep, about; >= 100
  double keyframe_overlap = 0.6; ///< the next keyframe is due when a smaller share of a
                                 ///< sweep was seen from the last; in (0, 1)
  double keyframe_way = 0.5;     ///< ... or at this distance from the last keyframe, in
                                 ///< units of the typical range (median of the first
                                 ///< sweep); > 0
  std::size_t most_lost = 5;     ///< lost sweeps in a row after which the
                                 ///< map begins anew
  unsigned int num_threads = 0;  ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Lidar odometry: poses of successive sweeps at the rate of the sensor. Each sweep is
 * matched with a local map of the sweeps before.
 *
 * The initial pose follows from constant velocity. The gate follows the errors of the predictions
 * so far; it is wide at the begin, and widened again where a match fits worse than usual. Where
 * points have times, two poses are found, at the begin and the end of the sweep, with a linear
 * change of velocity in between; the begin is known from the sweep before. Sweeps without a match
 * are left out of the map. Time and memory per sweep do not grow with the drive. The world is the
 * frame of the first sweep, or of its prediction. Bit-identical for any number of threads.
 * \code
 * pcl6d::SweepTracker tracker;
 * for (const pcl6d::Sweep& sweep : sweeps)
 *   use(tracker.track(sweep).T_world_sweep);
 * \endcode
 * \note Source: constant velocity, adaptive gate and hashed voxels from I. Vizzo et al.,
 * "KISS-ICP", RA-L 2023; two poses a sweep from P. Dellenbach et al., "CT-ICP", ICRA 2022.
 * \ingroup odometry */
class SweepTracker {
public:
  /** \throws BadArgument an option is invalid */
  explicit SweepTracker(const SweepTrackerOptions& options = {});
  ~SweepTracker();
  SweepTracker(SweepTracker&&) noexcept;
  SweepTracker&
  operator=(SweepTracker&&) noexcept;

  /** \brief Finds the pose of the next sweep. Sweeps with too few points are lost, never an error.
   * \throws BadArgument not one time per point, or the prediction is not a rigid motion */
  TrackedSweep
  track(const Sweep& sweep);

  /** \return the first sweeps of the current segment in order, without lost ones, as known so far.
   * The second sweep tells the motion within the first. Where all points have times, the first
   * twenty sweeps are kept. If each one jumps against the sweep before, the map is distorted: it is
   * made anew, and all are matched again. Then the first ten are tracked backward: the first one is
   * corrected, and the others if their motion becomes more even. TrackedSweep::corrects_opening
   * tells of each change. A caller with absolute predictions moves all sweeps by the correction of the
   * first one */
  const std::vector<TrackedSweep>&
  openingOfSegment() const;

  /** \return [m] edge of the map's smallest voxels; 0 before the first sweep */
  double
  voxel() const;

  /** \return [m] edge of the voxels to which sweeps are reduced (TrackedSweep::reduced); 0 before the
   * first sweep */
  double
  resolution() const;

  /** \return the number of sweeps whose lines together are as close as the noise of the sensor lets
   * them tell surfaces apart: 1 for dense sweeps, 4 for 16 lines with 2 degrees in between; 0
   * before the first sweep */
  std::size_t
  sweepsOfSurface() const;

  /** \return the size of the map in memory [bytes] */
  std::size_t
  mapBytes() const;

private:
  class Track;
  std::unique_ptr<Track> track_;
};

} // namespace pcl6d
