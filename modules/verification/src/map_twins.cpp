// SPDX-License-Identifier: BSD-3-Clause
// Second poses of scans placed without a prior pose.
#include "calibration.h"
#include "links_of_map.h"
#include "map_doubts.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/verification/map_verifier.h>
#include <pcl6d/verification/twin_search.h>

#include <algorithm>

namespace pcl6d {
using verification::kMostBackground;
using verification::kTwinShare;
using verification::linkBetween;
using verification::surestLinkOf;

namespace {
/** Number of scans searched for a second pose first, independent of the number of threads: a map of
 * which one is ambiguous is searched no further. Then twice as many, and so on. */
constexpr std::size_t kSearchedFirst = 8;
} // namespace

/** \return whether a second pose of a scan makes a consistent link with a neighbour, is not
 * contradicted by any other scan with a consistent link, and is confirmed about as much as the
 * present pose, by the neighbour and by all these scans together */
bool
MapVerifier::fitsElsewhere(std::size_t scan,
                           std::size_t beside,
                           const Eigen::Isometry3d& T_world_scan,
                           const std::vector<Eigen::Isometry3d>& poses,
                           const MapVerification& map) const
{
  const auto evidenceAt = [&](std::size_t other, const Eigen::Isometry3d& pose) {
    return linkEvidence(scans_[other], scans_[scan], poses[other].inverse() * pose);
  };
  const LinkEvidence there = evidenceAt(beside, T_world_scan);
  const LinkEvidence& here = evidence_[linkBetween(scan, beside, map)];
  auto confirmed_there = static_cast<double>(there.sight.confirmed_patches);
  auto confirmed_here = static_cast<double>(here.sight.confirmed_patches);
  if (testLink(there, map.background).trust != LinkTrust::kGood ||
      confirmed_there < kTwinShare * confirmed_here)
    return false;
  for (const LinkCheck& link : map.links) {
    const std::size_t other = link.from == scan ? link.to : link.from;
    if ((link.from != scan && link.to != scan) || other == beside ||
        link.trust != LinkTrust::kGood)
      continue;
    const LinkEvidence of_other = evidenceAt(other, T_world_scan);
    if (testLink(of_other, map.background).trust == LinkTrust::kWrong)
      return false;
    confirmed_there += static_cast<double>(of_other.sight.confirmed_patches);
    confirmed_here += static_cast<double>(link.patches - link.contradicted);
  }
  return confirmed_there >= kTwinShare * confirmed_here;
}

/** \return connected scans placed without a prior pose, the least certain first: those with the least
 * common surface in their most certain link */
std::vector<std::size_t>
MapVerifier::unsureScans(const MapVerification& map) const
{
  std::vector<std::pair<std::size_t, std::size_t>> unsure; // patches, scan
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    if (!options_.unsure[i] || !map.scans[i].tied || scans_[i].abstains())
      continue;
    const LinkCheck* most = surestLinkOf(i, map);
    unsure.emplace_back(most ? most->patches : 0, i);
  }
  std::sort(unsure.begin(), unsure.end());
  std::vector<std::size_t> order;
  order.reserve(unsure.size());
  for (const auto& [patches, scan] : unsure)
    order.push_back(scan);
  return order;
}

/** Finds second poses of scans placed without a prior pose, where good links are possible at all and
 * as long as the verdict depends on them: a few scans at a time, until one has a second pose. The rest
 * is marked as not searched for. */
void
MapVerifier::findTwins(const std::vector<Eigen::Isometry3d>& poses,
                       MapVerification& map) const
{
  if (map.background > kMostBackground)
    return; // rays are inconclusive
  const std::vector<std::size_t> unsure = unsureScans(map);
  bool is_decided =
      verification::MapDoubts(scans_, names_, test_results_).isDoubtful(map);
  std::vector<Rejection> doubts;
  for (std::size_t begin = 0; begin < unsure.size(); begin += doubts.size()) {
    doubts.assign(std::min(kSearchedFirst + begin, unsure.size() - begin), {});
    const auto place = [&](std::size_t k) { return unsure[begin + k]; };
    if (!is_decided)
      sharedFor(
          options_.sharing, options_.num_threads, doubts, place, [&](std::size_t k) {
            doubts[k] = twinOf(place(k), poses, map);
          });
    else
      doubts.assign(doubts.size(), RejectReason::kSecondPoseNotSought);
    for (std::size_t k = 0; k < doubts.size(); ++k)
      if (doubts[k]) {
        map.scans[place(k)].doubt = doubts[k];
        is_decided = true;
      }
  }
}

/** Finds a second pose of a scan, relative to the scan before and to the scan with the largest
 * overlap. \return its distance; none: accepted */
Rejection
MapVerifier::twinOf(std::size_t scan,
                    const std::vector<Eigen::Isometry3d>& poses,
                    const MapVerification& map) const
{
  std::vector<std::size_t> besides;
  if (const LinkCheck* most = surestLinkOf(scan, map))
    besides.push_back(most->from == scan ? most->to : most->from);
  if (scan > 0 && (besides.empty() || besides.front() != scan - 1))
    besides.push_back(scan - 1);
  for (const std::size_t beside : besides) {
    if (scans_[beside].abstains())
      continue; // no link with it is good
    const Eigen::Vector3d up =
        poses[beside].linear().transpose() * Eigen::Vector3d::UnitZ();
    for (const Eigen::Isometry3d& T : pcl6d::findTwins(
             scans_[beside], scans_[scan], poses[beside].inverse() * poses[scan], up)) {
      const Eigen::Isometry3d place = poses[beside] * T;
      if (!fitsElsewhere(scan, beside, place, poses, map))
        continue;
      const MotionSize way = distanceBetween(poses[scan], place);
      Rejection second(
          RejectReason::kFitsElsewhere, way.translation, degrees(way.rotation));
      second.text = names_[beside];
      return second;
    }
  }
  return {};
}

} // namespace pcl6d
