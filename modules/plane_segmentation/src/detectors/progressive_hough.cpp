// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/hough_searches.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace pcl6d::plane_segmentation {

namespace {
constexpr std::size_t kProgressiveBatches = 20; // parts in which the points vote

/** Hough transform that tests a plane once the votes stand out. */
class ProgressiveHough {
public:
  ProgressiveHough(const PlaneCloud& cloud, const HoughPlaneOptions& options)
  : options_(options)
  , ball_(options.slices)
  , search_(makeHoughSearch(cloud, options))
  , votes_(
        ball_,
        {options.offset_cell, options.max_angle, /*min_votes=*/1, cloud.numThreads()})
  , span_(reachOf(search_.surfels().columns(), options.offset_cell))
  , surprise_(-portableLog(options.chance))
  , voted_(cloud.surfels().size(), 0)
  {}

  PlaneCandidates
  run()
  {
    const auto order = search_.surfels().shuffled(mixBits(options_.seed));
    for (std::size_t batch = 0; batch < kProgressiveBatches; ++batch) {
      const auto place = [&](std::size_t of) {
        return order.begin() +
               static_cast<std::ptrdiff_t>(of * order.size() / kProgressiveBatches);
      };
      const std::vector<std::uint32_t> voters(place(batch), place(batch + 1));
      votes_.add(search_.surfels().columnsOf(voters));
      for (const auto surfel : voters)
        voted_[surfel] = 1;
      while (takeNext()) {}
    }
    return search_.found();
  }

private:
  /** \return whether points were removed, so that counting restarts */
  bool
  takeNext()
  {
    const auto least = static_cast<std::uint32_t>(options_.min_surfels);
    HoughPeaks peaks(votes_.cells(least), ball_, kHoughWindow);
    while (const HoughCell* const peak = peaks.next()) {
      if (!standsOut(*peak) || wasLookedAt(*peak))
        continue;
      const Support support =
          supportOfPeak(search_, ball_, *peak, options_.offset_cell);
      if (!support.slots.empty()) {
        take(support);
        return true;
      }
      remember(*peak);
    }
    return false;
  }

  /** Whether chance fails to explain the votes of a cell. If the votes for its
   * direction were spread evenly over the cloud, the votes of a cell would be Poisson
   * with this mean m. They exceed m + sqrt(2 m L) + L / 3 with a probability below
   * exp(-L) (Bernstein). */
  bool
  standsOut(const HoughCell& cell) const
  {
    const double mean = static_cast<double>(votes_.votesFor(cell.direction)) / span_;
    return cell.votes > mean + std::sqrt(2 * mean * surprise_) + surprise_ / 3;
  }

  void
  take(const Support& support)
  {
    std::vector<std::uint32_t> voters;
    for (const auto slot : support.slots)
      if (const auto surfel = search_.surfels().surfel(slot); voted_[surfel])
        voters.push_back(surfel);
    votes_.remove(search_.surfels().columnsOf(voters));
    search_.take(support);
  }

  static std::int64_t
  keyOf(std::size_t direction, std::int32_t offset)
  {
    return static_cast<std::int64_t>(offset) * (std::int64_t{1} << 32) +
           static_cast<std::int64_t>(direction);
  }

  /** Whether a test failed near it, with at least half of the present votes. */
  bool
  wasLookedAt(const HoughCell& cell) const
  {
    const auto found = looked_at_.find(keyOf(cell.direction, cell.offset));
    return found != looked_at_.end() && cell.votes < 2 * found->second;
  }

  void
  remember(const HoughCell& cell)
  {
    for (const auto direction : ball_.window(cell.direction, kHoughWindow))
      for (int step = -kHoughWindow; step <= kHoughWindow; ++step)
        looked_at_[keyOf(direction, cell.offset + step)] = cell.votes;
  }

  HoughPlaneOptions options_;
  AccumulatorBall ball_;
  PlaneSearch search_;
  HoughVotes votes_;
  double span_;     // cells along a normal
  double surprise_; // L of standsOut()
  std::vector<char> voted_;
  std::unordered_map<std::int64_t, std::uint32_t> looked_at_; // votes, by cell
};
} // namespace

PlaneCandidates
progressiveHough(const PlaneCloud& cloud, const HoughPlaneOptions& options)
{
  return ProgressiveHough(cloud, options).run();
}

} // namespace pcl6d::plane_segmentation
