// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/odometry/submaps.h>

#include <algorithm>
#include <utility>

namespace pcl6d {

namespace {
/** Sweeps kept between two keyframes; when full, each second one is dropped. */
constexpr std::size_t kMostBetween = 64;
} // namespace

void
Submaps::addSweep(std::size_t number,
                  const TrackedSweep& sweep,
                  std::size_t wanted,
                  double least)
{
  wanted_ = wanted;
  if (wanted == 0 || keyframes_.empty())
    return;
  const Eigen::Isometry3d& before = between_.empty()
                                        ? keyframes_.back().T_world_keyframe
                                        : between_.back().reduced.pose;
  if ((sweep.T_world_sweep.translation() - before.translation()).norm() < least)
    return;
  if (between_.size() == kMostBetween) {
    for (std::size_t k = 1; k < kMostBetween / 2; ++k)
      between_[k] = std::move(between_[2 * k]);
    between_.resize(kMostBetween / 2);
  }
  between_.push_back({number, {sweep.reduced, sweep.T_world_sweep}});
}

/** Moves sweeps to the last keyframe, spread evenly over those between. */
void
Submaps::gather(std::size_t begin, std::size_t end, std::size_t wanted)
{
  const std::size_t count = std::min(wanted, end - begin);
  for (std::size_t k = 0; k < count; ++k)
    keyframes_.back().around.push_back(
        std::move(between_[begin + (2 * k + 1) * (end - begin) / (2 * count)]));
}

void
Submaps::addKeyframe(std::size_t number, const TrackedSweep& sweep)
{
  const std::size_t half = is_cut_ ? 0 : (between_.size() + 1) / 2;
  gather(0, half, wanted_ - wanted_ / 2);
  keyframes_.push_back({number, sweep.T_world_sweep, {}});
  gather(half, between_.size(), wanted_ / 2);
  between_.clear();
  is_cut_ = false;
}

void
Submaps::cut()
{
  if (!is_cut_)
    gather(0, between_.size(), wanted_ - wanted_ / 2);
  between_.clear();
  is_cut_ = true;
}

void
Submaps::correct(std::size_t number, const TrackedSweep& sweep)
{
  const auto replace = [&](std::vector<Sweep>& sweeps) {
    for (Sweep& known : sweeps)
      if (known.number == number)
        known.reduced = {sweep.reduced, sweep.T_world_sweep};
  };
  replace(between_);
  for (Keyframe& keyframe : keyframes_) {
    if (keyframe.number == number)
      keyframe.T_world_keyframe = sweep.T_world_sweep;
    replace(keyframe.around);
  }
}

std::vector<PosedPoints>
Submaps::take(std::size_t keyframe)
{
  const Eigen::Isometry3d T_keyframe_world =
      keyframes_.at(keyframe).T_world_keyframe.inverse();
  std::vector<PosedPoints> around;
  for (Sweep& sweep : std::exchange(keyframes_[keyframe].around, {})) {
    around.push_back(std::move(sweep.reduced));
    around.back().pose = T_keyframe_world * around.back().pose;
  }
  return around;
}

} // namespace pcl6d
