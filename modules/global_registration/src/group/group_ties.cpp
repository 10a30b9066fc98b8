// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "group/group_ties.h"
#include "group/joint_placement.h"
#include "group/scan_blocks.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/verification/ties.h>

#include <algorithm>
#include <set>

namespace pcl6d::global_registration {

namespace {
/** Each second point is enough to find overlapping scans. */
constexpr std::size_t kTiedEvery = 2;

/** \return the members in the order of joining */
std::vector<std::size_t>
scansOf(const ScanGroup& group)
{
  std::vector<std::size_t> scans;
  for (const auto& one : group.members())
    scans.push_back(one.scan);
  return scans;
}

/** The evidence of links between each member and the members with the largest overlap.
 * \param[in] order of the members; links name their scans by the index in `order` */
std::vector<LinkCheck>
linksOf(const ScanGroup& group,
        const std::vector<std::size_t>& order,
        unsigned int num_threads,
        double& background)
{
  const auto& members = group.members();
  std::vector<std::vector<std::size_t>> met(members.size());
  parallelFor(members.size(), num_threads, [&](std::size_t k) {
    const double voxel = group.scan(members[k].scan).scan().voxel();
    met[k] = group
                 .support(members[k].scan,
                          members[k].T_group_scan,
                          kMetVoxels * voxel,
                          kPlaceVoxels * voxel,
                          kContradictedMatch,
                          kTiedEvery)
                 .met;
  });
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 0; k < members.size(); ++k)
    for (std::size_t i = 0; i < std::min(met[k].size(), kTestedLinks); ++i)
      pairs.insert(std::minmax(k, met[k][i]));
  const std::vector<std::pair<std::size_t, std::size_t>> list(pairs.begin(),
                                                              pairs.end());
  std::vector<LinkEvidence> evidence(list.size());
  parallelFor(list.size(), num_threads, [&](std::size_t i) {
    const PlacedScan& a = members[list[i].first];
    const PlacedScan& b = members[list[i].second];
    evidence[i] = linkEvidence(group.scan(a.scan).scan(),
                               group.scan(b.scan).scan(),
                               a.T_group_scan.inverse() * b.T_group_scan);
  });
  background = contradictionBackground(evidence);
  std::vector<std::size_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    place[order[i]] = i;
  std::vector<LinkCheck> links;
  for (std::size_t i = 0; i < list.size(); ++i)
    links.push_back(linkCheck(place[list[i].first],
                              place[list[i].second],
                              evidence[i],
                              testLink(evidence[i], background)));
  return links;
}
} // namespace

void
divide(const ScanGroup& group,
       const JoinedBy& joined_by,
       std::size_t scan,
       ScanGroup& block,
       ScanGroup& rest)
{
  const std::set<std::size_t> part = partBehind(scan, scansOf(group), joined_by);
  for (const auto& one : group.members())
    (part.count(one.scan) > 0 ? block : rest).add(one.scan, one.T_group_scan);
}

std::vector<std::pair<std::size_t, Rejection>>
disconnectedOf(const ScanGroup& group,
               const JoinedBy& joined_by,
               unsigned int num_threads)
{
  const auto order = inTreeOrder(scansOf(group), joined_by);
  double background = 0;
  const auto links = linksOf(group, order, num_threads, background);
  const auto ties = verification::tiesOf(order.size(), links, background);
  std::vector<std::pair<std::size_t, Rejection>> untied;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (!ties.tied[i])
      untied.emplace_back(group.members()[order[i]].scan,
                          ties.cut_from[i]
                              ? ties.cut_from[i]
                              : Rejection(RejectReason::kNoConsistentLink));
  return untied;
}

std::vector<ScanGroup>
splitOff(ScanGroup& group,
         const JoinedBy& joined_by,
         const PlaceHypotheses& hypotheses,
         double max_ambiguity,
         unsigned int num_threads)
{
  std::vector<ScanGroup> parts;
  for (std::size_t k = group.members().size(); k-- > 1;) {
    if (k >= group.members().size())
      continue; // removed with an earlier scan
    ScanGroup block = group.without(), rest = group.without();
    divide(group, joined_by, group.members()[k].scan, block, rest);
    if (block.members().size() < 2 || rest.members().size() < 2 ||
        !fitsElsewhere(rest, block, hypotheses, max_ambiguity, num_threads))
      continue;
    parts.push_back(block);
    group = rest;
  }
  return parts;
}

} // namespace pcl6d::global_registration
