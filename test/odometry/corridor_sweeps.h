// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/corridor_drive.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/odometry/sweep_tracker.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl6d::test {

constexpr double kSweepTime = 0.1; // [s]

/** \brief A lidar of 24 rings, 2.5 degrees apart, that drives along a corridor with closets, at 1.5 m/s in a slalom:
 * each ray starts where the sensor is at its time. Ranges have 5 mm of noise. */
class CorridorSweeps {
public:
  explicit CorridorSweeps(std::uint64_t seed = 5) : random_(seed)
  {
    room_ = corridorWithClosets(random_);
  }

  /** \return T_world_sensor; the drive stands still where the speed [m/s] is zero */
  static Eigen::Isometry3d
  poseAt(double time, double speed = 1.5)
  {
    const double way = speed * time;
    return poseFromEuler({way, 0.3 * std::sin(0.5 * way), 0},
                         {0.02 * std::sin(way), 0, 0.3 * std::sin(0.5 * way)});
  }

  /** \return the sweep that begins at a time */
  Sweep
  sweep(double stamp, double speed = 1.5)
  {
    return sweepAlong([speed](double time) { return poseAt(time, speed); }, stamp);
  }

  /** \return the sweep that begins at a time, of a sensor with a pose for each time
   * \param[in] between [deg] from ring to ring */
  template <typename PoseOfTime>
  Sweep
  sweepAlong(const PoseOfTime& poseOf, double stamp, double between = 2.5)
  {
    constexpr int kColumns = 300;
    Sweep sweep;
    sweep.stamp = stamp;
    for (int column = 0; column < kColumns; ++column) {
      const double time = kSweepTime * column / kColumns;
      const Eigen::Isometry3d pose = poseOf(stamp + time);
      const double turn = 2 * M_PI * column / kColumns;
      for (int ring = 0; ring < 24; ++ring) {
        const double up = radians(between * (ring - 11.5));
        const Eigen::Vector3d ray(
            std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
        const double range = room_.range(pose.translation(), pose.linear() * ray);
        sweep.points.push_back(
            ((range + 0.005 * random_.normal()) * ray).cast<float>());
        sweep.times.push_back(time);
      }
    }
    return sweep;
  }

  /** \return the range [m] along a ray of unit length, without noise */
  double
  range(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) const
  {
    return room_.range(origin, ray);
  }

  /** \return sweeps without a pause, from time 0 */
  std::vector<Sweep>
  drive(std::size_t count, double speed = 1.5)
  {
    std::vector<Sweep> sweeps;
    for (std::size_t i = 0; i < count; ++i)
      sweeps.push_back(sweep(kSweepTime * static_cast<double>(i), speed));
    return sweeps;
  }

private:
  Random random_;
  PillarRoom room_;
};

/** Corrects the points of a sweep of CorridorSweeps::drive() by the true motion within it, to its
 * begin; the times stay. */
inline void
takeMotionOut(Sweep& sweep)
{
  const Eigen::Isometry3d T_begin_world =
      CorridorSweeps::poseAt(*sweep.stamp).inverse();
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
    sweep.points[i] =
        (T_begin_world * CorridorSweeps::poseAt(*sweep.stamp + sweep.times[i]) *
         sweep.points[i].cast<double>())
            .cast<float>();
}

inline std::vector<TrackedSweep>
trackAll(const std::vector<Sweep>& sweeps, const SweepTrackerOptions& options = {})
{
  SweepTracker tracker(options);
  std::vector<TrackedSweep> tracked;
  for (const Sweep& sweep : sweeps)
    tracked.push_back(tracker.track(sweep));
  return tracked;
}

} // namespace pcl6d::test
