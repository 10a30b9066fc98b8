// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/odometry/sweep_tracker.h>

#include <cstddef>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Tells whether points with times still hold the motion of the sensor within their sweeps. Drivers
 * and recorders may have corrected the points, and kept the times.
 *
 * A drive is tracked both ways: with the times of the points, and with rigid sweeps. The wrong way
 * distorts every sweep differently, and points lie farther from the surfaces of the map.
 * Successive sweeps share the errors of a map, and are compared in blocks: each block is a vote, by the
 * mean logarithm of the ratio of both distances. A clear lead decides (sequential test of A.
 * Wald, 1945). Sweeps with a motion below the noise do not count. \ingroup odometry */
class MotionEvidence {
public:
  /** \brief Counts a sweep. \param[in] moving, rigid the same sweep, tracked both ways, in the order of
   * the drive */
  void
  add(const TrackedSweep& moving, const TrackedSweep& rigid);

  /** \return whether the points hold the motion, as soon as the sweeps so far leave no doubt */
  std::optional<bool>
  holdsMotion() const;

  /** \return whether the points hold the motion, by all sweeps of the drive; in doubt they do: most
   * recordings with times are as measured */
  bool
  holdsMotionInTheEnd() const;

  /** \return the typical distance of points as moving, over that as rigid; 1 before the first block */
  double
  ratio() const;

private:
  void
  vote();

  std::size_t since_begin_ = 0; ///< sweeps of the youngest map of both ways
  std::size_t in_block_ = 0, blocks_ = 0;
  double sum_of_block_ = 0, sum_ = 0; ///< of the logarithms
  int lead_ = 0; ///< votes for rigid sweeps, less those for moving ones
};

} // namespace pcl6d
