// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/hough_searches.h"
#include "detectors/local_triple.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace pcl6d {
using namespace plane_segmentation;

namespace {
constexpr std::size_t kBlock = 256;  // draws
constexpr std::size_t kBatch = 2048; // draws made before they vote
constexpr int kLevels = 3;           // cell sizes to draw from

constexpr Named<HoughVariant> kVariants[] = {
    {HoughVariant::kStandard, "standard"},
    {HoughVariant::kProbabilistic, "probabilistic"},
    {HoughVariant::kRandomized, "randomized"},
    {HoughVariant::kAdaptive, "adaptive"},
    {HoughVariant::kProgressive, "progressive"}};

/** The randomized transform. */
class RandomizedHough {
public:
  RandomizedHough(const PlaneCloud& cloud, const HoughPlaneOptions& options)
  : options_(options)
  , ball_(options.slices)
  , num_threads_(cloud.numThreads())
  , search_(makeHoughSearch(cloud, options))
  {
    triple_.num_levels = kLevels;
    triple_.min_distance = options.min_side;
    triple_.min_cosine = portableSinCos(options.max_angle).cos;
  }

  PlaneCandidates
  run()
  {
    int failures = 0;
    while (search_.surfels().size() >= options_.min_surfels &&
           failures < options_.max_failures) {
      const Votes best = vote();
      const bool found = best.count > 0 && takeMean(best);
      failures = found ? 0 : failures + 1;
    }
    return search_.found();
  }

private:
  /** The votes of a cell, with their sum. */
  struct Votes {
    int count = 0;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    float offset = 0;
  };

  /** \return the first cell with enough votes, or else the cell with most votes */
  Votes
  vote()
  {
    std::unordered_map<std::uint64_t, Votes> cells;
    Votes best;
    for (int draws = 0; draws < options_.max_draws; draws += static_cast<int>(kBatch))
      for (const auto& plane : drawBatch()) {
        Votes& votes = cells[keyOf(plane)];
        ++votes.count;
        votes.normal += plane.normal;
        votes.offset += plane.offset;
        if (votes.count > best.count)
          best = votes;
        if (best.count >= options_.votes)
          return best;
      }
    return best;
  }

  std::uint64_t
  keyOf(const TriplePlane& plane) const
  {
    const auto direction =
        static_cast<std::int64_t>(ball_.cellOf(plane.normal.cast<double>()));
    const auto offset =
        clampedTo<std::int64_t>(std::floor(plane.offset / options_.offset_cell));
    return static_cast<std::uint64_t>(offset) << 24 ^
           static_cast<std::uint64_t>(direction);
  }

  std::vector<TriplePlane>
  drawBatch()
  {
    std::vector<std::vector<TriplePlane>> planes(kBatch / kBlock);
    parallelBlocks(kBatch, kBlock, num_threads_, [&](const Block& block) {
      Random random(mixBits(mixBits(options_.seed) + num_blocks_ + block.index));
      for (std::size_t i = block.begin; i < block.end; ++i)
        if (const auto plane = drawTriple(search_.surfels(), triple_, random))
          planes[block.index].push_back(*plane);
    });
    num_blocks_ += planes.size();
    std::vector<TriplePlane> all;
    for (const auto& block : planes)
      all.insert(all.end(), block.begin(), block.end());
    return all;
  }

  bool
  takeMean(const Votes& votes)
  {
    const auto count = static_cast<float>(votes.count);
    const Support support = search_.supportOf(
        search_.slab(votes.normal.normalized(), votes.offset / count));
    return !support.slots.empty() && search_.take(support);
  }

  HoughPlaneOptions options_;
  AccumulatorBall ball_;
  unsigned int num_threads_;
  PlaneSearch search_;
  TripleOptions triple_;
  std::size_t num_blocks_ = 0;
};

} // namespace

void
HoughPlaneOptions::validate() const
{
  constexpr double kRightAngle = 1.5707963267948966;
  const auto requirePositive = [](const char* name, double value) {
    require(std::isfinite(value) && value > 0, name, value, "finite and > 0");
  };
  require(slices >= 2 && slices <= 1000, "slices", slices, "in [2, 1000]");
  requirePositive("offset_cell", offset_cell);
  requirePositive("max_plane_distance", max_plane_distance);
  require(
      max_angle > 0 && max_angle < kRightAngle, "max_angle", max_angle, "in (0, pi/2)");
  require(std::isfinite(bend) && bend >= 0, "bend", bend, "finite and >= 0");
  require(min_surfels >= 3, "min_surfels", min_surfels, ">= 3");
  require(min_side >= 0, "min_side", min_side, ">= 0");
  require(std::isfinite(max_side) && max_side > min_side,
          "max_side",
          max_side,
          "finite and > min_side");
  require(votes >= 2, "votes", votes, ">= 2");
  require(max_draws >= 1, "max_draws", max_draws, ">= 1");
  require(max_failures >= 1, "max_failures", max_failures, ">= 1");
  require(share > 0 && share <= 1, "share", share, "in (0, 1]");
  require(peaks >= 1, "peaks", peaks, ">= 1");
  require(stable_batches >= 1, "stable_batches", stable_batches, ">= 1");
  require(chance > 0 && chance < 1, "chance", chance, "in (0, 1)");
}

PlaneSearch
plane_segmentation::makeHoughSearch(const PlaneCloud& cloud,
                                    const HoughPlaneOptions& options)
{
  return {cloud,
          options.max_side / (1 << (kLevels - 1)),
          {options.max_plane_distance, options.bend},
          portableSinCos(options.max_angle).cos,
          options.min_surfels};
}

PlaneCandidates
houghCandidates(const PlaneCloud& cloud, const HoughPlaneOptions& options)
{
  options.validate();
  switch (options.variant) {
  case HoughVariant::kRandomized:
    return RandomizedHough(cloud, options).run();
  case HoughVariant::kProgressive:
    return progressiveHough(cloud, options);
  default:
    return fullHough(cloud, options);
  }
}

HoughVariant
houghVariantFromName(const std::string& name)
{
  return fromName(kVariants, "Hough variant", name);
}

std::vector<std::string>
houghVariantNames()
{
  return namesOf(kVariants);
}

std::string
toString(HoughVariant variant)
{
  return nameOf(kVariants, variant);
}

} // namespace pcl6d
