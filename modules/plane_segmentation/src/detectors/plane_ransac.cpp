// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/local_triple.h"
#include "detectors/plane_support.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/plane_segmentation/plane_ransac.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {
using namespace plane_segmentation;

namespace {
constexpr std::size_t kBlock = 256;       // draws
constexpr std::size_t kFirstDraws = 1024; // doubled from round to round
constexpr std::size_t kSampleSize = 4096; // points to score a draw on
constexpr int kLevels = 4;                // sizes of neighbourhoods
/** Chance that the second and third point of a draw are on the plane of the first, and
 * determine its direction well enough for a fit to find the rest. */
constexpr double kGoodDraw = 0.1;
/** Promising drafts to fit before the best is taken. */
constexpr int kLooks = 4;

/** A candidate plane. */
struct Draft {
  Slab slab;
  double size = 0;       ///< number of its points: estimated, or counted
  std::size_t round = 0; ///< number of planes taken when `size` was computed

  bool
  operator<(const Draft& other) const
  {
    return size < other.size;
  }
};

class RansacSearch {
public:
  RansacSearch(const PlaneCloud& cloud, const RansacPlaneOptions& options)
  : options_(options)
  , num_threads_(cloud.numThreads())
  , search_(cloud,
            options.neighbourhood / (1 << (kLevels - 1)),
            {options.max_plane_distance, options.bend},
            portableSinCos(options.max_angle).cos,
            options.min_surfels)
  {
    triple_.num_levels = kLevels;
    triple_.min_cosine = portableSinCos(options.max_angle).cos;
    resample();
  }

  PlaneCandidates
  run()
  {
    std::size_t draws = kFirstDraws;
    while (surfels().size() >= options_.min_surfels) {
      draw(draws);
      while (takeBest()) {}
      if (trustedSize() <= static_cast<double>(options_.min_surfels))
        break;
      draws *= 2;
    }
    return search_.found();
  }

private:
  const RemainingSurfels&
  surfels() const
  {
    return search_.surfels();
  }

  void
  resample()
  {
    sample_ = surfels().sample(kSampleSize, mixBits(options_.seed) + num_taken_);
  }

  double
  estimatedSize(const Slab& slab) const
  {
    return static_cast<double>(countInside(sample_, slab)) *
           static_cast<double>(surfels().size()) / static_cast<double>(sample_.size());
  }

  /** Draws samples and keeps candidate planes. */
  void
  draw(std::size_t count)
  {
    std::vector<std::vector<Draft>> drafts((count + kBlock - 1) / kBlock);
    parallelBlocks(count, kBlock, num_threads_, [&](const Block& block) {
      Random random(mixBits(mixBits(options_.seed) + num_blocks_ + block.index));
      for (std::size_t i = block.begin; i < block.end; ++i)
        if (const auto triple = drawTriple(surfels(), triple_, random)) {
          const Slab slab = search_.slab(triple->normal, triple->offset);
          drafts[block.index].push_back({slab, estimatedSize(slab), num_taken_});
        }
    });
    num_blocks_ += drafts.size();
    draws_per_surfel_ +=
        static_cast<double>(count) / static_cast<double>(surfels().size());
    for (const auto& block : drafts)
      for (const auto& draft : block)
        push(draft);
  }

  void
  push(const Draft& draft)
  {
    if (draft.size < static_cast<double>(options_.min_surfels))
      return;
    heap_.push_back(draft);
    std::push_heap(heap_.begin(), heap_.end());
  }

  Draft
  pop()
  {
    std::pop_heap(heap_.begin(), heap_.end());
    const Draft draft = heap_.back();
    heap_.pop_back();
    return draft;
  }

  /** \return the number of points of a plane at which a larger plane would have been
   * drawn by now: (1 - n q / N)^draws = 1 - P, for small n q / N */
  double
  trustedSize() const
  {
    return -portableLog(1 - options_.probability) / (kGoodDraw * draws_per_surfel_);
  }

  /** Takes the largest plane if its size can be trusted.
   * \return whether a plane was taken */
  bool
  takeBest()
  {
    Support best;
    for (int looks = 0; looks < kLooks && mayBeat(best.slots.size());) {
      Draft draft = pop();
      if (draft.round < num_taken_) {
        draft.size = std::min(draft.size, estimatedSize(draft.slab));
        draft.round = num_taken_;
        push(draft);
        continue;
      }
      Support support = search_.supportOf(draft.slab);
      ++looks;
      if (support.slots.size() > best.slots.size())
        std::swap(support, best);
      putBack(support);
    }
    if (static_cast<double>(best.slots.size()) < trustedSize()) {
      putBack(best);
      return false;
    }
    search_.take(best);
    ++num_taken_;
    resample();
    return true;
  }

  /** \return whether the next draft may beat a plane of known size */
  bool
  mayBeat(std::size_t size) const
  {
    return !heap_.empty() &&
           heap_.front().size >= std::max(trustedSize(), static_cast<double>(size));
  }

  void
  putBack(const Support& support)
  {
    push({support.slab, static_cast<double>(support.slots.size()), num_taken_});
  }

  RansacPlaneOptions options_;
  unsigned int num_threads_;
  PlaneSearch search_;
  TripleOptions triple_;
  SurfelColumns sample_; // to score draws on
  std::vector<Draft> heap_;
  std::size_t num_taken_ = 0; // patches, including curved patches
  std::size_t num_blocks_ = 0;
  double draws_per_surfel_ = 0;
};
} // namespace

void
RansacPlaneOptions::validate() const
{
  constexpr double kRightAngle = 1.5707963267948966;
  require(std::isfinite(max_plane_distance) && max_plane_distance > 0,
          "max_plane_distance",
          max_plane_distance,
          "finite and > 0");
  require(
      max_angle > 0 && max_angle < kRightAngle, "max_angle", max_angle, "in (0, pi/2)");
  require(std::isfinite(neighbourhood) && neighbourhood > 0,
          "neighbourhood",
          neighbourhood,
          "finite and > 0");
  require(std::isfinite(bend) && bend >= 0, "bend", bend, "finite and >= 0");
  require(min_surfels >= 3, "min_surfels", min_surfels, ">= 3");
  require(probability > 0 && probability < 1, "probability", probability, "in (0, 1)");
}

PlaneCandidates
ransacCandidates(const PlaneCloud& cloud, const RansacPlaneOptions& options)
{
  options.validate();
  return RansacSearch(cloud, options).run();
}

} // namespace pcl6d
