// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "group/joiner.h"
#include "plan/content_order.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <utility>

namespace pcl6d {
using namespace global_registration;

namespace {
/** Copies a group into the result. \param[in] order indices of the scans */
void
take(const JoinedGroup& joined,
     const std::vector<std::size_t>& order,
     JoinedScans& result)
{
  const ScanGroup& group = joined.scans;
  std::vector<std::size_t>& members = result.groups.emplace_back();
  for (const auto& one : group.members()) {
    JoinedScan& scan = result.scans[order[one.scan]];
    const double voxel = group.scan(one.scan).scan().voxel();
    const JointSupport support = group.support(one.scan,
                                               one.T_group_scan,
                                               kMetVoxels * voxel,
                                               kPlaceVoxels * voxel,
                                               kContradictedMatch);
    scan = {result.groups.size() - 1,
            one.T_group_scan,
            support.overlap,
            support.contradiction,
            joined.rejection};
    members.push_back(order[one.scan]);
  }
}

/** Scans without a group, in the order of their indices. */
void
takeLoose(const Joiner& joiner,
          const std::vector<std::size_t>& order,
          JoinedScans& result)
{
  std::vector<bool> is_loose(order.size(), true);
  for (const auto& group : result.groups)
    for (const std::size_t place : group)
      is_loose[place] = false;
  for (std::size_t k = 0; k < order.size(); ++k)
    if (is_loose[order[k]])
      result.scans[order[k]].rejection = joiner.rejectionOf(k)
                                             ? joiner.rejectionOf(k)
                                             : Rejection(RejectReason::kNoSurfacesMeet);
  for (std::size_t place = 0; place < order.size(); ++place)
    if (is_loose[place]) {
      result.scans[place].group = result.groups.size();
      result.groups.push_back({place});
    }
}
} // namespace

void
JoinOptions::validate() const
{
  require(pairs_per_scan > 0, "pairs_per_scan", pairs_per_scan, "> 0");
  require(max_ambiguity >= 0 && max_ambiguity <= 1,
          "max_ambiguity",
          max_ambiguity,
          "in [0, 1]");
}

namespace {
/** \throws BadArgument the numbers of known poses and scans differ, or a pair is not of two
 * scans */
void
requireFitting(const JoinOptions& options, std::size_t num_scans)
{
  if (!options.known.empty() && options.known.size() != num_scans)
    throw BadArgument("known = " + std::to_string(options.known.size()) +
                      " places, but there are " + std::to_string(num_scans) + " scans");
  for (const auto& [first, second] : options.pairs)
    if (first == second || std::max(first, second) >= num_scans)
      throw BadArgument("pairs = " + std::to_string(first) + ", " +
                        std::to_string(second) + ", but there are " +
                        std::to_string(num_scans) + " scans");
}
} // namespace

JoinedScans
joinScans(const std::deque<PlaceableScan>& scans, const JoinOptions& options)
{
  options.validate();
  requireFitting(options, scans.size());
  JoinedScans result;
  result.scans.resize(scans.size());
  if (scans.empty())
    return result;
  const std::vector<std::size_t> order = contentOrder(scans);
  ScanList list;
  Joiner::Known known;
  std::vector<std::size_t> place_of(scans.size());
  for (const std::size_t place : order) {
    place_of[place] = list.size();
    list.push_back(&scans[place]);
    if (!options.known.empty())
      known.push_back(options.known[place]);
  }
  std::set<ScanPlaces> pairs;
  for (const auto& [first, second] : options.pairs)
    pairs.insert(std::minmax(place_of[first], place_of[second]));
  Joiner joiner(list, options, std::move(known), {pairs.begin(), pairs.end()});
  joiner.run(result);
  for (const auto& group : joiner.groups())
    if (group.scans.members().size() > 1 ||
        joiner.isKnown(group.scans.members().front().scan))
      take(group, order, result);
  takeLoose(joiner, order, result);
  return result;
}

} // namespace pcl6d
