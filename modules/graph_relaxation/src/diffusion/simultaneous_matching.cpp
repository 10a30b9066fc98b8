// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/simultaneous_matching.h>

#include <algorithm>
#include <deque>
#include <utility>

namespace pcl6d {

namespace {
using Scans = SimultaneousMatching::Scans;

/** A ball about the finite points of a scan, in its frame. */
struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = -1; ///< [m]; < 0: no points
};

Ball
ballAround(const Points& points)
{
  Eigen::AlignedBox3f box;
  for (const auto& p : points)
    if (p.allFinite())
      box.extend(p);
  if (box.isEmpty())
    return {};
  return {box.center().cast<double>(),
          0.5 * (box.max() - box.min()).cast<double>().norm()};
}

class Run {
public:
  Run(const Scans& scans,
      const std::vector<Eigen::Isometry3d>& poses,
      const SimultaneousMatchingOptions& options)
  : scans_(scans), o_(options), queued_(scans.size(), false)
  {
    result_.poses = poses;
    for (const auto& scan : scans)
      balls_.push_back(ballAround(scan->points()));
  }

  SimultaneousMatchingResult
  run(const std::vector<std::size_t>& start, const ProgressCallback& progress)
  {
    for (const std::size_t s : start)
      enqueue(s);
    const std::size_t limit = o_.pops_per_scan * scans_.size();
    while (!queue_.empty() && result_.pops < limit) {
      const std::size_t s = queue_.front();
      queue_.pop_front();
      queued_[s] = false;
      visit(s);
      ++result_.pops;
      if (progress)
        progress({"simultaneous matching", result_.pops, limit});
    }
    if (!queue_.empty())
      result_.status = Status::kMaxIterations;
    else
      result_.status = has_neighbours_ ? Status::kOk : Status::kTooFewPairs;
    return std::move(result_);
  }

private:
  void
  enqueue(std::size_t s)
  {
    if (!queued_[s])
      queue_.push_back(s);
    queued_[s] = true;
  }

  void
  visit(std::size_t s)
  {
    const std::vector<std::size_t> neighbours = neighboursOf(s);
    has_neighbours_ = has_neighbours_ || !neighbours.empty();
    if (neighbours.empty() || (s != o_.master && !moves(s, neighbours)))
      return;
    for (const std::size_t n : neighbours)
      if (n != o_.master)
        enqueue(n);
  }

  /** Matches a scan with its neighbours.
   * \return whether the motion is large enough to wake the neighbours */
  bool
  moves(std::size_t s, const std::vector<std::size_t>& neighbours)
  {
    IcpTarget target;
    for (const std::size_t n : neighbours)
      target.push_back(scans_[n]->part(fromTo(n, s)));
    const IcpResult found =
        icp(target, scans_[s]->source(), Eigen::Isometry3d::Identity(), o_.icp);
    if (found.status == Status::kTooFewPairs || found.status == Status::kDiverged) {
      ++result_.failed;
      return false;
    }
    Eigen::Isometry3d& pose = result_.poses[s];
    pose = exactlyRigid(pose * found.T_target_source);
    const MotionSize moved =
        distanceBetween(Eigen::Isometry3d::Identity(), found.T_target_source);
    return moved.translation > o_.min_translation || moved.rotation > o_.min_rotation;
  }

  /** \return the transform of points of scan n into the frame of scan s */
  Eigen::Isometry3d
  fromTo(std::size_t n, std::size_t s) const
  {
    return result_.poses[s].inverse() * result_.poses[n];
  }

  std::vector<std::size_t>
  neighboursOf(std::size_t s) const
  {
    std::vector<char> overlaps(scans_.size(), false);
    parallelFor(scans_.size(), o_.icp.num_threads, [&](std::size_t n) {
      overlaps[n] = n != s && areNear(s, n) && haveEnoughPairs(s, n);
    });
    std::vector<std::size_t> neighbours;
    for (std::size_t n = 0; n < scans_.size(); ++n)
      if (overlaps[n])
        neighbours.push_back(n);
    return neighbours;
  }

  bool
  areNear(std::size_t s, std::size_t n) const
  {
    const Ball &a = balls_[s], &b = balls_[n];
    const double distance = (fromTo(n, s) * b.centre - a.centre).norm();
    // a millimetre more: points were rounded to float
    return a.radius >= 0 && b.radius >= 0 &&
           distance <= a.radius + b.radius + o_.icp.max_distance + 1e-3;
  }

  /** Whether more than min_pairs points of s have a partner in n; does not count on. */
  bool
  haveEnoughPairs(std::size_t s, std::size_t n) const
  {
    const Eigen::Isometry3d T_n_s = fromTo(s, n);
    const auto max_sq = static_cast<float>(o_.icp.max_distance * o_.icp.max_distance);
    std::size_t pairs = 0;
    for (const auto& p : scans_[s]->points()) {
      const Eigen::Vector3f q = (T_n_s * p.cast<double>()).cast<float>();
      if (scans_[n]->tree().hasNeighbour(q, max_sq) && ++pairs > o_.min_pairs)
        return true;
    }
    return false;
  }

  const Scans& scans_;
  const SimultaneousMatchingOptions& o_;
  std::vector<Ball> balls_;
  std::deque<std::size_t> queue_;
  std::vector<char> queued_;
  bool has_neighbours_ = false;
  SimultaneousMatchingResult result_;
};
} // namespace

void
SimultaneousMatchingOptions::validate() const
{
  icp.validate();
  require(min_translation >= 0, "min_translation", min_translation, ">= 0");
  require(min_rotation >= 0, "min_rotation", min_rotation, ">= 0");
  require(pops_per_scan > 0, "pops_per_scan", pops_per_scan, "> 0");
}

SimultaneousMatching::SimultaneousMatching(const SimultaneousMatchingOptions& options)
: options_(options)
{
  options_.validate();
}

void
SimultaneousMatching::setProgress(ProgressCallback progress)
{
  progress_ = std::move(progress);
}

SimultaneousMatchingResult
SimultaneousMatching::align(const Scans& scans,
                            const std::vector<Eigen::Isometry3d>& poses,
                            const std::vector<std::size_t>& start) const
{
  require(poses.size() == scans.size(), "poses", poses.size(), "one per scan");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    require(scans[i] != nullptr, "scan", i, "given, not null");
    require(isRigid(poses[i]), "pose", i, "finite and rigid");
  }
  const std::string rule = "less than the " + std::to_string(scans.size()) + " scans";
  require(
      scans.empty() || options_.master < scans.size(), "master", options_.master, rule);
  std::vector<std::size_t> queue = start;
  for (const std::size_t s : queue)
    require(s < scans.size(), "start", s, rule);
  for (std::size_t s = 0; start.empty() && s < scans.size(); ++s)
    if (s != options_.master)
      queue.push_back(s);
  return Run(scans, poses, options_).run(queue, progress_);
}

} // namespace pcl6d
