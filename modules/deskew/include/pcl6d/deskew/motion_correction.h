// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/io/scan_fields.h>

#include <pcl/point_cloud.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Format of the times of a cloud's points. */
struct TimeFormat {
  double unit = 1;          ///< [s] 1, 1e-3, 1e-6 or 1e-9
  bool is_absolute = false; ///< true: on the clock of the scan's stamp; false:
                            ///< relative to the stamp
};

/** \return "in ns since the scan's stamp", "in s, absolute" etc. */
std::string
toString(const TimeFormat& format);

/** \return the field of a cloud with the times of its points, the first of: t, time, timestamp,
 * time_stamp, offset_time, stamps; empty without any */
std::optional<FieldValues>
timeField(const pcl::PCLPointCloud2& cloud);

/** \brief Finds the unit of the times of a single scan without a stamp: for a floating type the
 * largest of s, ms, us and ns in which the scan lasts at most 20 s, for an integer the largest of
 * ms, us and ns in which the scan lasts 20 ms to 20 s. Times later than 20 s are absolute, not
 * counted from a stamp.
 * \throws BadArgument a time is not finite, or no unit gives the scan a duration within the
 * limits */
TimeFormat
timeFormatAlone(const FieldValues& times);

/** \brief How a pose between two poses of the odometry is found. */
enum class MotionInterpolation {
  kLinear, ///< position linear, rotation by slerp (book A.1): a path with corners
  kCubic   ///< Hermite splines: velocities, too, are continuous. Follows bends better
};

/** \return the interpolation called "linear" or "cubic" \throws BadArgument another name
 */
MotionInterpolation
motionInterpolationFromName(const std::string& name);

/** \brief Deskews scans: corrects the motion of the scanner during a scan.
 *
 * A point measured at time t is moved into the scanner's frame at the scan's stamp t0:
 * p' = T(t0)^-1 T(t) p. Between two poses of the odometry the pose is interpolated; before the
 * first and after the last pose the motion is extrapolated. Only the motion within one scan counts:
 * drift does no harm.
 *
 * With kCubic the velocity at a pose is the weighted mean of the velocities before and after: the
 * slope of a parabola through the three poses. The spline of the rotation runs in rotation vectors
 * about its start pose.
 * \code
 * const pcl6d::MotionCorrection correction(folder.odometry());
 * const auto times = pcl6d::timeField(scan.cloud); // nothing: nothing to correct
 * const auto format = correction.timeFormat(*times, stamp);
 * correction.correct(scan.points, correction.timesOf(*times, format, stamp), stamp);
 * \endcode \ingroup deskew */
class MotionCorrection {
public:
  /** \param[in] odometry T_world_scan and stamps [s], at least 2
   * \throws BadArgument stamps are missing, not one per pose, or not increasing */
  explicit MotionCorrection(
      const Trajectory& odometry,
      MotionInterpolation interpolation = MotionInterpolation::kLinear);

  /** \return T_world_scan at any time [s] */
  Eigen::Isometry3d
  poseAt(double time) const;

  /** \return the time from a stamp to the next [s]; after the last stamp, the time since
   * the stamp before */
  double
  period(double stamp) const;

  /** \brief Finds the unit of times from their type and range, since files do not state the unit.
   * For a floating type it is the largest of s, ms, us, ns, for an integer the largest of ms, us,
   * ns (ROS drivers write ns) in which the times stay within 1.5 periods of the stamp. Times are
   * relative to the stamp if possible, else absolute. Times may be negative (stamps at the end of
   * a scan) and in any order (rings).
   * \throws BadArgument a time is not finite, or no format fits */
  TimeFormat
  timeFormat(const FieldValues& times, double stamp) const;

  /** \return the times [s] since the stamp
   * \throws BadArgument a time is not finite, or farther from the stamp than 1.5 periods */
  std::vector<double>
  timesOf(const FieldValues& times, const TimeFormat& format, double stamp) const;

  /** \brief Moves points [m, frame of the scanner at their own time] into the scanner's
   * frame at the stamp. \param[in] times [s] since the stamp, one per point
   * \param[in] num_threads 0: a thread per core; never changes the result
   * \throws BadArgument not one time per point */
  void
  correct(Points& points,
          const std::vector<double>& times,
          double stamp,
          unsigned num_threads = 0) const;

  /** \brief correct() for a PCL cloud; NaN points stay NaN. */
  template <typename PointT>
  void
  correct(pcl::PointCloud<PointT>& cloud,
          const std::vector<double>& times,
          double stamp,
          unsigned num_threads = 0) const
  {
    Points points = toPoints(cloud);
    correct(points, times, stamp, num_threads);
    for (std::size_t i = 0; i < points.size(); ++i)
      cloud[i].getVector3fMap() = points[i];
  }

private:
  std::size_t
  segmentAt(double time) const;

  /// in the world, per second
  struct Velocity {
    Eigen::Vector3d linear;  // [m/s]
    Eigen::Vector3d angular; // [rad/s]
  };
  Velocity
  meanVelocity(std::size_t segment) const;
  Velocity
  velocityAt(std::size_t pose) const;

  Trajectory odometry_;
  MotionInterpolation interpolation_;
  std::vector<Eigen::Vector3d> turns_; // [rad] axis times angle from pose i to i + 1
  std::vector<Velocity> velocities_;   // of kCubic, at each pose
};

} // namespace pcl6d
