// SPDX-License-Identifier: BSD-3-Clause
#include "bag/messages/frame_tree.h"

#include <algorithm>

namespace pcl6d::sources {

namespace {
/** Odometry is published at 10 Hz or more; across a longer gap the motion is unknown. */
constexpr std::int64_t kLargestGap = 2000000000; // [ns]
/** Two sweeps of a scanner at 10 Hz: the first cloud is often older than the first pose. */
constexpr std::int64_t kLargestHold = 200000000; // [ns]
} // namespace

void
PoseSeries::add(std::int64_t time, const Eigen::Isometry3d& pose)
{
  samples_.push_back({time, pose});
}

void
PoseSeries::finish()
{
  std::stable_sort(samples_.begin(), samples_.end(), [](const auto& a, const auto& b) {
    return a.time < b.time;
  });
  std::vector<Sample> kept;
  for (const Sample& sample : samples_) {
    if (!kept.empty() && kept.back().time == sample.time)
      kept.pop_back();
    kept.push_back(sample);
  }
  samples_ = std::move(kept);
}

std::optional<Eigen::Isometry3d>
PoseSeries::at(std::int64_t time) const
{
  const auto after = std::lower_bound(
      samples_.begin(), samples_.end(), time, [](const Sample& sample, std::int64_t t) {
        return sample.time < t;
      });
  if (after != samples_.end() && after->time == time)
    return after->pose;
  const bool is_first = after == samples_.begin(), is_last = after == samples_.end();
  if (is_first && is_last)
    return {};
  if (is_first)
    return after->time - time <= kLargestHold ? std::optional(after->pose)
                                              : std::nullopt;
  const Sample& before = *(after - 1);
  if (is_last)
    return time - before.time <= kLargestHold ? std::optional(before.pose)
                                              : std::nullopt;
  if (after->time - before.time > kLargestGap)
    return {};
  const double s = static_cast<double>(time - before.time) /
                   static_cast<double>(after->time - before.time);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() =
      (1 - s) * before.pose.translation() + s * after->pose.translation();
  pose.linear() = Eigen::Quaterniond(before.pose.linear())
                      .slerp(s, Eigen::Quaterniond(after->pose.linear()))
                      .normalized()
                      .toRotationMatrix();
  return pose;
}

void
FrameTree::add(const FramePose& pose, std::int64_t time, bool is_static)
{
  Edge& edge = edges_[pose.child];
  if (edge.parent.empty())
    edge.parent = pose.parent;
  if (edge.parent != pose.parent) {
    edge.other_parent = pose.parent;
    return;
  }
  if (is_static)
    edge.fixed = pose.T_parent_child;
  else
    edge.moving.add(time, pose.T_parent_child);
}

void
FrameTree::finish()
{
  for (auto& [child, edge] : edges_)
    edge.moving.finish();
}

std::vector<std::string>
FrameTree::chainFrom(const std::string& frame) const
{
  std::vector<std::string> chain = {frame};
  for (auto edge = edges_.find(frame); edge != edges_.end();
       edge = edges_.find(chain.back())) {
    const std::string next_step =
        "; choose poses by --odometry TOPIC, or --odometry none";
    if (!edge->second.other_parent.empty())
      text::fail(path_,
                 "tf: frame " + text::quoted(edge->first) + " has two parents, " +
                     text::quoted(edge->second.parent) + " and " +
                     text::quoted(edge->second.other_parent) + next_step);
    const std::string& parent = edge->second.parent;
    if (std::find(chain.begin(), chain.end(), parent) != chain.end())
      text::fail(path_,
                 "tf: the frames " + text::quoted(frame) + " to " +
                     text::quoted(chain.back()) + " form a loop" + next_step);
    chain.push_back(parent);
  }
  return chain;
}

bool
FrameTree::movesAlong(const std::vector<std::string>& chain) const
{
  for (std::size_t i = 0; i + 1 < chain.size(); ++i)
    if (!edges_.at(chain[i]).moving.empty())
      return true;
  return false;
}

std::optional<Eigen::Isometry3d>
FrameTree::poseAlong(const std::vector<std::string>& chain, std::int64_t time) const
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Edge& edge = edges_.at(chain[i]);
    const auto here = edge.moving.empty() ? edge.fixed : edge.moving.at(time);
    if (!here)
      return {};
    pose = *here * pose;
  }
  return pose;
}

std::optional<Eigen::Isometry3d>
FrameTree::poseIn(const std::string& frame,
                  const std::string& other,
                  std::int64_t time) const
{
  std::vector<std::string> up = chainFrom(frame), down = chainFrom(other);
  const auto shared =
      std::find_first_of(up.begin(), up.end(), down.begin(), down.end());
  if (shared == up.end())
    return {};
  down.erase(std::find(down.begin(), down.end(), *shared) + 1, down.end());
  up.erase(shared + 1, up.end());
  const auto T_shared_frame = poseAlong(up, time),
             T_shared_other = poseAlong(down, time);
  if (!T_shared_frame || !T_shared_other)
    return {};
  return T_shared_other->inverse() * *T_shared_frame;
}

} // namespace pcl6d::sources
