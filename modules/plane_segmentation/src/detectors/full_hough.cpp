// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/hough_searches.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/common/random.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pcl6d::plane_segmentation {

namespace {
/** Parts of the points that vote before the peaks are compared. */
constexpr std::size_t kAdaptiveBatches = 20;

/** Result of a vote: cells, and share of the voters. */
struct Election {
  std::vector<HoughCell> cells;
  double share = 1; ///< of the surfels that voted
};

/** Hough transforms in which each point votes for every plane through it before peaks
 * are taken. */
class FullHough {
public:
  FullHough(const PlaneCloud& cloud, const HoughPlaneOptions& options)
  : options_(options)
  , ball_(options.slices)
  , num_threads_(cloud.numThreads())
  , search_(makeHoughSearch(cloud, options))
  {}

  PlaneCandidates
  run()
  {
    std::size_t before = 0;
    do {
      before = search_.found().size();
      takePeaks();
    } while (search_.found().size() > before);
    return search_.found();
  }

private:
  /** Votes once, and takes the peaks with a plane. */
  void
  takePeaks()
  {
    HoughPeaks peaks(vote().cells, ball_, kHoughWindow);
    int failures = 0;
    while (failures < options_.max_failures) {
      const HoughCell* const peak = peaks.next();
      if (peak == nullptr)
        break;
      failures = takePeak(*peak) ? 0 : failures + 1;
    }
  }

  Election
  vote() const
  {
    if (options_.variant == HoughVariant::kAdaptive)
      return adaptiveVote();
    Election election;
    if (options_.variant == HoughVariant::kProbabilistic)
      election.share = options_.share;
    const auto size = static_cast<double>(search_.surfels().size());
    const auto voters = static_cast<std::size_t>(std::ceil(election.share * size));
    HoughVoteOptions voting = this->voting();
    voting.min_votes = fewest(election.share);
    election.cells =
        voteForAll(search_.surfels().sample(voters, seed()), ball_, voting);
    return election;
  }

  /** Votes batch by batch until the largest peaks are stable. */
  Election
  adaptiveVote() const
  {
    const std::vector<std::uint32_t> order = search_.surfels().shuffled(seed());
    HoughVotes votes(ball_, voting());
    Election election;
    std::vector<HoughCell> before;
    int stable = 0;
    for (std::size_t batch = 1; batch <= kAdaptiveBatches; ++batch) {
      const auto place = [&](std::size_t of) {
        return order.begin() +
               static_cast<std::ptrdiff_t>(of * order.size() / kAdaptiveBatches);
      };
      votes.add(search_.surfels().columnsOf({place(batch - 1), place(batch)}));
      election.share = static_cast<double>(batch) / kAdaptiveBatches;
      election.cells = votes.cells(fewest(election.share));
      const std::vector<HoughCell> largest = largestPeaks(election.cells);
      stable = sameRanks(before, largest) ? stable + 1 : 0;
      if (stable >= options_.stable_batches)
        break;
      before = largest;
    }
    return election;
  }

  /** The largest peaks, by falling count. */
  std::vector<HoughCell>
  largestPeaks(const std::vector<HoughCell>& cells) const
  {
    HoughPeaks peaks(cells, ball_, kHoughWindow);
    std::vector<HoughCell> largest;
    while (largest.size() < static_cast<std::size_t>(options_.peaks)) {
      const HoughCell* const peak = peaks.next();
      if (peak == nullptr)
        break;
      largest.push_back(*peak);
    }
    return largest;
  }

  /** Whether each peak is within the window of the peak with the same rank. */
  bool
  sameRanks(const std::vector<HoughCell>& a, const std::vector<HoughCell>& b) const
  {
    const auto near = [&](const HoughCell& x, const HoughCell& y) {
      const auto window = ball_.window(x.direction, kHoughWindow);
      return std::abs(x.offset - y.offset) <= kHoughWindow &&
             std::binary_search(window.begin(), window.end(), y.direction);
    };
    return !a.empty() && std::equal(a.begin(), a.end(), b.begin(), b.end(), near);
  }

  bool
  takePeak(const HoughCell& peak)
  {
    const Support support = supportOfPeak(search_, ball_, peak, options_.offset_cell);
    return !support.slots.empty() && search_.take(support);
  }

  HoughVoteOptions
  voting() const
  {
    HoughVoteOptions voting;
    voting.offset_cell = options_.offset_cell;
    voting.max_angle = options_.max_angle;
    voting.num_threads = num_threads_;
    return voting;
  }

  /** \return the fewest votes of a plane if a share of the surfels votes */
  std::uint32_t
  fewest(double share) const
  {
    const double votes = share * static_cast<double>(options_.min_surfels);
    return clampedTo<std::uint32_t>(std::max(1.0, votes));
  }

  std::uint64_t
  seed() const
  {
    return mixBits(options_.seed) + search_.found().size();
  }

  HoughPlaneOptions options_;
  AccumulatorBall ball_;
  unsigned int num_threads_;
  PlaneSearch search_;
};
} // namespace

Support
supportOfPeak(const PlaneSearch& search,
              const AccumulatorBall& ball,
              const HoughCell& peak,
              double offset_cell)
{
  const double offset = (peak.offset + 0.5) * offset_cell;
  Slab slab = search.slab(ball.centre(peak.direction).cast<float>(),
                          static_cast<float>(offset));
  slab.slack = static_cast<float>(offset_cell / 2);
  return search.supportOf(slab);
}

PlaneCandidates
fullHough(const PlaneCloud& cloud, const HoughPlaneOptions& options)
{
  return FullHough(cloud, options).run();
}

} // namespace pcl6d::plane_segmentation
