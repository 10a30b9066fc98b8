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

/** \brief How a cloud stores the times of its points. */
struct TimeFormat {
  double unit = 1;          ///< [s] 1, 1e-3, 1e-6 or 1e-9
  bool is_absolute = false; ///< true: as the scan's stamp; false: relative to it
};

/** \return "in ns since the scan's stamp", "in s, absolute" and so on */
std::string
toString(const TimeFormat& format);

/** \return the field of a cloud that holds the times of its points: "t", else "time",
 * or nothing */
std::optional<FieldValues>
timeField(const pcl::PCLPointCloud2& cloud);

/** \brief Finds the unit of the times of a scan that nothing else is known of: a floating type
 * holds seconds, an integer that of ms, us and ns in which the scan lasts 20 ms to 20 s. Times
 * later than 20 s are absolute: they count from no scan.
 * \throws BadArgument a time is not finite, the scan lasts longer than 20 s, or in no unit so
 * long */
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

/** \brief Undoes the motion of the scanner during a scan ("deskewing").
 *
 * A point that was measured at time t is moved into the frame that the scanner had at
 * its scan's stamp t0: p' = T(t0)^-1 T(t) p. Between two poses of the odometry the pose
 * is interpolated; before the first and after the last one the motion goes on as it
 * was. What counts is the motion within one scan, so drift does no harm.
 *
 * With kCubic the velocity at a pose is the mean of those before and after it, weighted
 * as a parabola through the three poses has it; the spline of the rotation runs in the
 * rotation vectors about the pose that it starts from.
 * \code
 * const pcl6d::MotionCorrection correction(folder.odometry());
 * const auto times = pcl6d::timeField(scan.cloud); // nothing: nothing to correct
 * const auto format = correction.timeFormat(*times, stamp);
 * correction.correct(scan.points, correction.timesOf(*times, format, stamp), stamp);
 * \endcode \ingroup filters */
class MotionCorrection {
public:
  /** \param[in] odometry T_world_scan and stamps [s], at least 2
   * \throws BadArgument there are no stamps, not one per pose, or they do not increase */
  explicit MotionCorrection(
      const Trajectory& odometry,
      MotionInterpolation interpolation = MotionInterpolation::kLinear);

  /** \return T_world_scan at any time [s] */
  Eigen::Isometry3d
  poseAt(double time) const;

  /** \return the time from a stamp to the next one [s]; after the last one the time that
   * led to it */
  double
  period(double stamp) const;

  /** \brief Finds the unit of times by their type and range, since files do not tell it.
   * A floating type holds seconds. An integer holds the largest of ms, us, ns (ROS
   * drivers write ns) in which all times stay within 1.5 periods of the stamp. Times
   * count from the stamp if that is possible, or are absolute. They may be negative
   * (stamps at the end of a scan) and in any order (rings).
   * \throws BadArgument a time is not finite, or no format fits */
  TimeFormat
  timeFormat(const FieldValues& times, double stamp) const;

  /** \return the times [s] since the stamp
   * \throws BadArgument a time is not finite, or farther from the stamp than 1.5 periods */
  std::vector<double>
  timesOf(const FieldValues& times, const TimeFormat& format, double stamp) const;

  /** \brief Moves points [m, frame of the scanner at their own time] into the scanner's
   * frame at the stamp. \param[in] times [s] since the stamp, one per point
   * \param[in] num_threads 0: one per core; never changes the result
   * \throws BadArgument there is not one time per point */
  void
  correct(Points& points,
          const std::vector<double>& times,
          double stamp,
          unsigned num_threads = 0) const;

  /** \brief The same for a PCL cloud; points that are NaN stay so. */
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
