// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "group/scan_blocks.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>

#include <algorithm>

namespace pcl6d::global_registration {

namespace {
/** Number of scored candidate poses of a group, from each fourth point of its scans. */
constexpr std::size_t kBlockPlaces = 8, kBlockEvery = 4;
} // namespace

bool
areSameBlockPlaces(const ScanGroup& block,
                   const Eigen::Isometry3d& a,
                   const Eigen::Isometry3d& b)
{
  return std::all_of(
      block.members().begin(), block.members().end(), [&](const PlacedScan& one) {
        return areSamePlace(a * one.T_group_scan,
                            b * one.T_group_scan,
                            2 * block.scan(one.scan).cell());
      });
}

void
evaluateBlock(const ScanGroup& group, const ScanGroup& block, BlockPlace& place)
{
  double overlap = 0, met = 0, free = 0;
  place.support = {};
  for (std::size_t k = 0; k < block.members().size(); ++k) {
    const PlacedScan& one = block.members()[k];
    const double cell = block.scan(one.scan).cell();
    const JointSupport support = group.support(one.scan,
                                               place.T_group_block * one.T_group_scan,
                                               cell,
                                               0.5 * cell,
                                               kContradictedStart,
                                               kBlockEvery);
    overlap += support.overlap;
    met += support.met_points;
    free += support.free_points;
    if (support.overlap > place.support.overlap) {
      place.fixing = k;
      place.support = support;
    }
  }
  const double contradiction = met > 0 ? free / (met + free) : 0;
  place.score = overlap * portableExp(-contradiction / kContradictedMatch);
}

std::vector<BlockPlace>
placesOfBlock(const ScanGroup& group,
              const ScanGroup& block,
              const PlaceHypotheses& hypotheses,
              unsigned int num_threads)
{
  std::vector<BlockPlace> places;
  for (const PlacedScan& one : block.members())
    for (const std::size_t h : hypotheses.of(one.scan)) {
      const PlaceHypothesis& hypothesis = hypotheses.all()[h];
      const bool is_second = hypothesis.second == one.scan;
      const auto fixed =
          group.placeOf(is_second ? hypothesis.first : hypothesis.second);
      if (!fixed)
        continue;
      const Eigen::Isometry3d T_group_scan =
          *fixed *
          (is_second ? hypothesis.T_first_second : hypothesis.T_first_second.inverse());
      const auto same =
          std::find_if(places.begin(), places.end(), [&](const BlockPlace& p) {
            return areSamePlace(p.T_group_block * one.T_group_scan,
                                T_group_scan,
                                2 * block.scan(one.scan).cell());
          });
      if (same == places.end())
        places.push_back(
            {T_group_scan * one.T_group_scan.inverse(), hypothesis.strength, 0, 0, {}});
      else
        same->strength += hypothesis.strength;
    }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) {
    return a.strength > b.strength;
  });
  places.resize(std::min(places.size(), kBlockPlaces));
  parallelFor(places.size(), num_threads, [&](std::size_t k) {
    evaluateBlock(group, block, places[k]);
  });
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) {
    return a.score > b.score;
  });
  return places;
}

bool
fitsElsewhere(const ScanGroup& rest,
              const ScanGroup& block,
              const PlaceHypotheses& hypotheses,
              double max_ambiguity,
              unsigned int num_threads)
{
  BlockPlace here;
  evaluateBlock(rest, block, here);
  const auto others = placesOfBlock(rest, block, hypotheses, num_threads);
  return std::any_of(others.begin(), others.end(), [&](const BlockPlace& other) {
    return other.score > max_ambiguity * here.score &&
           !areSameBlockPlaces(block, other.T_group_block, here.T_group_block);
  });
}

std::optional<BlockPlace>
onlyPlaceOfBlock(const ScanGroup& group,
                 const ScanGroup& block,
                 const PlaceHypotheses& hypotheses,
                 double max_ambiguity,
                 unsigned int num_threads,
                 Rejection& why)
{
  const auto places = placesOfBlock(group, block, hypotheses, num_threads);
  if (places.empty() || places[0].score <= 0) {
    why = RejectReason::kNoSurfacesMeet;
    return std::nullopt;
  }
  for (std::size_t k = 1; k < places.size(); ++k)
    if (places[k].score > max_ambiguity * places[0].score &&
        !areSameBlockPlaces(block, places[k].T_group_block, places[0].T_group_block)) {
      why = {
          RejectReason::kSecondPose, places[k].score / places[0].score, max_ambiguity};
      return std::nullopt;
    }
  return places[0];
}

} // namespace pcl6d::global_registration
