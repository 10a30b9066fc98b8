// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/odometry/sweep_frames.h>
#include <pcl6d/registration/twist.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl6d {

namespace {
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kSweepsAround =
    5; ///< the tracker, too, learns from about ten sweeps

/** Error of the ends as a share of the second difference of the velocities: the sagitta; twice as
 * much where no sweep before holds the begin. */
constexpr double kBend = 0.125, kBendAtFirst = 0.25;

/** [durations of a sweep] From begin to begin: one sweep may be left out in between. */
constexpr double kLongestWay = 2.5;

double
durationOf(const SweepEnds& sweep)
{
  return sweep.end - sweep.begin;
}

/** \return the motion within a sweep, in the frame of its begin */
Twist
velocityOf(const SweepEnds& sweep)
{
  return twistFromMotion(sweep.T_world_begin.inverse() * sweep.T_world_end);
}

/** \return the motion during another sweep, at the velocity of this sweep: the last sweep of a
 * recording may be cut off */
Twist
velocityDuring(const SweepEnds& other, const SweepEnds& sweep)
{
  return durationOf(other) / durationOf(sweep) * velocityOf(sweep);
}

/** \return whether a sweep begins where the sweep before ended, but for a short pause */
bool
goesOn(const SweepEnds& before, const SweepEnds& sweep)
{
  const double from = before.stamp + before.begin, to = sweep.stamp + sweep.begin;
  return sweep.follows && durationOf(before) > 0 && durationOf(sweep) > 0 &&
         to > from && to - from < kLongestWay * durationOf(before);
}

/** \return the motion from the end of a sweep to the begin of the next, beyond the pause */
Twist
jumpOf(const SweepEnds& before, const SweepEnds& sweep)
{
  const double pause =
      (sweep.stamp + sweep.begin - before.stamp - before.begin) / durationOf(before) -
      1;
  return twistFromMotion(before.T_world_end.inverse() * sweep.T_world_begin) -
         pause * velocityOf(before);
}
} // namespace

std::vector<Matrix6>
frameCovariances(const std::vector<SweepEnds>& sweeps)
{
  const std::size_t count = sweeps.size();
  std::vector<Matrix6> covariances(count, Matrix6::Zero());
  std::vector<bool> goes_on(count, false); // from the sweep before
  std::vector<Twist> jumps(count, Twist::Zero()), bends(count, Twist::Zero());
  for (std::size_t i = 1; i < count; ++i) {
    goes_on[i] = goesOn(sweeps[i - 1], sweeps[i]);
    if (goes_on[i])
      jumps[i] = jumpOf(sweeps[i - 1], sweeps[i]);
    if (i > 1 && goes_on[i] && goes_on[i - 1])
      bends[i - 1] = velocityDuring(sweeps[i - 1], sweeps[i - 2]) -
                     2 * velocityOf(sweeps[i - 1]) +
                     velocityDuring(sweeps[i - 1], sweeps[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!(durationOf(sweeps[i]) > 0))
      continue;
    std::size_t num_jumps = 0;
    const std::size_t first = i - std::min(i, kSweepsAround);
    const std::size_t last = std::min(i + kSweepsAround, count - 1);
    for (std::size_t k = first + 1; k <= last; ++k)
      if (goes_on[k]) {
        covariances[i] += 0.5 * jumps[k] * jumps[k].transpose();
        ++num_jumps;
      }
    covariances[i] /= static_cast<double>(std::max<std::size_t>(num_jumps, 1));
    Twist bend = bends[i];
    for (const std::size_t k :
         {i - std::min<std::size_t>(i, 1), std::min(i + 1, count - 1)})
      if (bends[k].squaredNorm() > bend.squaredNorm())
        bend = bends[k];
    const bool is_first = i == 0 || !sweeps[i].follows;
    const double share = is_first ? kBendAtFirst : kBend;
    covariances[i] += share * share * bend * bend.transpose();
    // The error grows from the middle to the ends, and beyond.
    const double away =
        std::max(1.0, std::abs(1 + 2 * sweeps[i].begin / durationOf(sweeps[i])));
    covariances[i] *= away * away;
  }
  return covariances;
}

} // namespace pcl6d
