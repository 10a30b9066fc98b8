// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/robot_path.h>

#include <vector>

namespace pcl6d::simulation {

/** \brief Timetable of a robot on a path, with limited speed and turn rate. */
class Timetable {
public:
  /** \param[in] speed [m/s] at most \param[in] turn_rate [rad/s] at most */
  Timetable(const RobotPath& path, double speed, double turn_rate);

  /** \return [s] of one round */
  double
  duration() const
  {
    return rows_.back().time;
  }

  struct Row {
    double time;    // [s]
    double way;     // [m]
    double heading; // [rad] without jumps
  };

  /** \return the state at a time of the first round: between rows in proportion */
  Row
  at(double time) const;

private:
  void
  drive(double way, double heading, double speed, double turn_rate);

  std::vector<Row> rows_;
};

} // namespace pcl6d::simulation
