// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "pair/place_hypotheses.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/place_search.h>

#include <algorithm>
#include <map>

namespace pcl6d::global_registration {

namespace {
/** Pairs between two progress reports. */
constexpr std::size_t kPlacedAtATime = 16;

/** Poses of two scans, from the first to the second of the requested pair. */
Eigen::Isometry3d
between(const PlaceHypothesis& one, std::size_t from)
{
  return one.first == from ? one.T_first_second : one.T_first_second.inverse();
}

std::size_t
partnerOf(const PlaceHypothesis& one, std::size_t scan)
{
  return one.first == scan ? one.second : one.first;
}
} // namespace

bool
areSamePlace(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double cell)
{
  const MotionSize apart = distanceBetween(a, b);
  return apart.translation < kOtherCells * cell && apart.rotation < kOtherTurn;
}

PlaceHypotheses::PlaceHypotheses(const ScanList& scans,
                                 double max_ambiguity,
                                 unsigned int num_threads,
                                 const ProgressCallback& progress,
                                 PairMemory* memory)
: scans_(scans)
, max_ambiguity_(max_ambiguity)
, num_threads_(num_threads)
, progress_(progress)
, memory_(memory)
, of_scan_(scans.size())
{}

std::vector<PairMemory::Candidate>
PlaceHypotheses::candidatesOf(const ScanPlaces& pair) const
{
  if (memory_)
    if (const auto* known = memory_->candidates(pairOf(scans_, pair), max_ambiguity_))
      return *known;
  PlaceSearchOptions options;
  options.max_ambiguity = max_ambiguity_;
  options.any_axis = false;
  options.num_threads = 1;
  const PlaceResult found =
      placeScan(*scans_[pair.first], *scans_[pair.second], options);
  std::vector<PairMemory::Candidate> candidates;
  for (std::size_t k = 0; k < found.candidates.size(); ++k)
    candidates.push_back({found.candidates[k].T_first_second,
                          found.candidates[k].score,
                          k == 0 && found.answer == PlaceAnswer::kUnique});
  return candidates;
}

void
PlaceHypotheses::add(const std::vector<RankedPair>& pairs)
{
  std::vector<std::vector<PairMemory::Candidate>> found(pairs.size());
  if (progress_)
    progress_({"placing", 0, pairs.size()});
  for (std::size_t begin = 0; begin < pairs.size(); begin += kPlacedAtATime) {
    const std::size_t count = std::min(kPlacedAtATime, pairs.size() - begin);
    parallelFor(count, num_threads_, [&](std::size_t k) {
      found[begin + k] = candidatesOf(pairs[begin + k].scans);
    });
    for (std::size_t i = begin; i < begin + count && memory_; ++i)
      memory_->keepCandidates(pairOf(scans_, pairs[i].scans), max_ambiguity_, found[i]);
    if (progress_)
      progress_({"placing", begin + count, pairs.size()});
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [first, second] = pairs[i].scans;
    for (const PairMemory::Candidate& one : found[i]) {
      if (one.score <= 0)
        continue;
      of_scan_[first].push_back(all_.size());
      of_scan_[second].push_back(all_.size());
      all_.push_back(
          {first, second, one.T_first_second, one.score, one.score, one.is_unique});
    }
  }
  strengthen();
}

std::optional<PlaceHypothesis>
PlaceHypotheses::strongestBeginning(const std::vector<bool>& joined,
                                    const std::set<ScanPlaces>& tried) const
{
  std::optional<PlaceHypothesis> best;
  for (const auto& one : all_)
    if (one.can_begin && !joined[one.first] && !joined[one.second] &&
        (!best || one.strength > best->strength) &&
        tried.count({one.first, one.second}) == 0)
      best = one;
  return best;
}

void
PlaceHypotheses::strengthen()
{
  std::vector<double> strengths(all_.size());
  parallelFor(all_.size(), num_threads_, [&](std::size_t h) {
    const PlaceHypothesis& one = all_[h];
    std::map<std::size_t, std::vector<std::size_t>> by_third; // of the second scan
    for (const std::size_t k : of_scan_[one.second])
      by_third[partnerOf(all_[k], one.second)].push_back(k);
    std::map<std::size_t, double> closing; // for each third scan the best
    for (const std::size_t a : of_scan_[one.first]) {
      const std::size_t third = partnerOf(all_[a], one.first);
      const auto others = by_third.find(third);
      if (third == one.second || others == by_third.end())
        continue;
      const Eigen::Isometry3d T_first_third = between(all_[a], one.first);
      for (const std::size_t b : others->second) {
        const double least = std::min(all_[a].score, all_[b].score);
        double& best = closing[third];
        if (least > best &&
            areSamePlace(T_first_third,
                         one.T_first_second * between(all_[b], one.second),
                         scans_[third]->cell()))
          best = least;
      }
    }
    double sum = 1;
    for (const auto& [third, least] : closing)
      sum += least;
    strengths[h] = one.score * sum;
  });
  for (std::size_t h = 0; h < all_.size(); ++h)
    all_[h].strength = strengths[h];
}

} // namespace pcl6d::global_registration
