// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "group/joint_placement.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/verification/ties.h>

#include <algorithm>
#include <utility>

namespace pcl6d::global_registration {

namespace {
/** Numbers of candidate poses of a scan: scored, and matched. */
constexpr std::size_t kPlacesLookedAt = 8, kSettled = 3;

/** Each second point is enough for the score. */
constexpr std::size_t kLookEvery = 2;

/** If rays contradict more than this share of the common points, a pose is rejected when the
 * share exceeds this multiple of the share at its members' own poses. Right poses in the
 * street, the corridor and simulated rooms have up to 0.09, wrong poses 0.13 and more; the
 * mean of right poses is a third of the limit. */
constexpr double kMuchContradicted = 0.12, kTimesUsual = 2;
constexpr std::size_t kUsualMembers = 6;

/** A wrong link rejects the pose if its ray test alone gives a larger probability; and all links
 * together reject an expected pose from this probability on: it is rather wrong than right. */
constexpr double kElsewhere = 0.5;

void
sortPlaces(std::vector<Place>& places)
{
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.support.score > b.support.score;
  });
}

/** \return the contradictions of a pose's links \param[out] is_held a link is good */
Rejection
contradictionBy(const std::vector<LinkEvidence>& of_place,
                const std::vector<LinkEvidence>& links,
                bool& is_held)
{
  const double background = contradictionBackground(links);
  is_held = false;
  for (const auto& link : of_place) {
    const LinkTestResult test_result = testLink(link, background);
    if (test_result.trust == LinkTrust::kWrong && test_result.elsewhere > kElsewhere)
      return {RejectReason::kInconsistentLink, test_result.rejection};
    is_held = is_held ||
              test_result.trust == LinkTrust::kGood; // inconclusive links do not count
  }
  return {};
}

/** Joint evidence of the links of a pose: a cut in a map with good links elsewhere. A pose found
 * anywhere (kConnected) may be one of several that look alike: it is rejected, too, if the few known
 * links contradict as much as its own. A predicted pose is not, since people or cars explain that.
 * \param[in] links of the map, to estimate the usual share of contradictions */
Rejection
contradictionByAll(const std::vector<LinkEvidence>& of_place,
                   const std::vector<LinkEvidence>& links,
                   PlaceNeeds needs)
{
  const double background = contradictionBackground(links);
  const std::size_t scan = of_place.size(), rest = scan + 1; // the others come first
  std::vector<LinkCheck> checks;
  for (std::size_t k = 0; k < scan; ++k) {
    checks.push_back(
        linkCheck(k, scan, of_place[k], testLink(of_place[k], background)));
    LinkCheck held; // a consistent link besides `checks`
    held.from = k;
    held.to = rest;
    held.trust = LinkTrust::kGood;
    checks.push_back(held);
  }
  LinkCheck& all = checks.back();
  for (const auto& link : links) {
    all.patches += link.sight.patches;
    all.contradicted += link.sight.contradicted_patches;
  }
  return needs == PlaceNeeds::kConnected
             ? verification::tiesOf(rest + 1, checks, background).cut_from[scan]
             : verification::contradictionOfScan(
                   scan, rest + 1, checks, background, kElsewhere);
}

std::vector<LinkEvidence>
withThingsOnce(std::vector<LinkEvidence> links)
{
  for (LinkEvidence& link : links)
    link = pcl6d::withThingsOnce(std::move(link));
  return links;
}

/** \return why a pose is rejected: its links contradict the pose, or no link is good although
 * one is needed; empty if accepted. At the pose predicted by odometry, each isolated object in
 * the way of rays counts once: people may walk around the scanner */
Rejection
rejectionBy(std::vector<LinkEvidence> of_place,
            std::vector<LinkEvidence> links,
            PlaceNeeds needs)
{
  if (needs == PlaceNeeds::kConfirmedAsExpected) {
    of_place = withThingsOnce(std::move(of_place));
    links = withThingsOnce(std::move(links));
  }
  bool is_held = false;
  Rejection contradiction = contradictionBy(of_place, links, is_held);
  if (contradiction || needs == PlaceNeeds::kNoContradiction)
    return contradiction;
  if (!is_held)
    return RejectReason::kNoConsistentLink;
  return contradictionByAll(of_place, links, needs);
}
} // namespace

JointPlacement::JointPlacement(const ScanList& scans,
                               const PlaceHypotheses& hypotheses,
                               double max_ambiguity,
                               unsigned int num_threads)
: scans_(scans)
, hypotheses_(hypotheses)
, max_ambiguity_(max_ambiguity)
, num_threads_(num_threads)
{}

std::vector<Place>
JointPlacement::placesOf(std::size_t scan, const ScanGroup& group) const
{
  std::vector<Place> places;
  for (const std::size_t h : hypotheses_.of(scan)) {
    const PlaceHypothesis& one = hypotheses_.all()[h];
    const bool is_second = one.second == scan;
    const auto fixed = group.placeOf(is_second ? one.first : one.second);
    if (!fixed)
      continue;
    const Eigen::Isometry3d T =
        *fixed * (is_second ? one.T_first_second : one.T_first_second.inverse());
    const auto same = std::find_if(places.begin(), places.end(), [&](const Place& p) {
      return areSamePlace(p.T_group_scan, T, scans_[scan]->cell());
    });
    if (same == places.end())
      places.push_back({T, one.strength, {}});
    else
      same->strength += one.strength;
  }
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.strength > b.strength;
  });
  places.resize(std::min(places.size(), kPlacesLookedAt));
  const double cell = scans_[scan]->cell();
  for (Place& one : places)
    one.support = group.support(
        scan, one.T_group_scan, cell, 0.5 * cell, kContradictedStart, kLookEvery);
  sortPlaces(places);
  return places;
}

Settled
JointPlacement::settle(std::size_t scan,
                       const std::vector<Place>& places,
                       const ScanGroup& group,
                       const std::vector<LinkEvidence>& links,
                       PlaceNeeds needs) const
{
  std::vector<Place> best(
      places.begin(),
      places.begin() + static_cast<std::ptrdiff_t>(std::min(places.size(), kSettled)));
  const double voxel = scans_[scan]->scan().voxel();
  parallelFor(best.size(), num_threads_, [&](std::size_t k) {
    Place& one = best[k];
    one.T_group_scan = group.matched(
        scan, one.T_group_scan, one.support.met, 2 * scans_[scan]->cell());
    one.support = group.support(scan,
                                one.T_group_scan,
                                kMetVoxels * voxel,
                                kPlaceVoxels * voxel,
                                kContradictedMatch);
  });
  sortPlaces(best);
  Settled settled;
  settled.best = best.front();
  for (std::size_t k = 1; k < best.size(); ++k)
    if (!areSamePlace(
            best[0].T_group_scan, best[k].T_group_scan, scans_[scan]->cell())) {
      settled.ambiguity = best[k].support.score / best[0].support.score;
      break;
    }
  decide(scan, group, links, needs, settled);
  return settled;
}

/** \return whether rays contradict a pose more than the poses of its members */
bool
JointPlacement::isContradicted(const JointSupport& support,
                               const ScanGroup& group) const
{
  if (support.contradiction <= kMuchContradicted)
    return false;
  std::vector<double> usual(std::min(support.met.size(), kUsualMembers));
  parallelFor(usual.size(), num_threads_, [&](std::size_t k) {
    const PlacedScan& member = group.members()[support.met[k]];
    const double voxel = scans_[member.scan]->scan().voxel();
    usual[k] = group
                   .support(member.scan,
                            member.T_group_scan,
                            kMetVoxels * voxel,
                            kPlaceVoxels * voxel,
                            kContradictedMatch)
                   .contradiction;
  });
  std::sort(usual.begin(), usual.end());
  const double median = usual.empty() ? 0 : usual[usual.size() / 2];
  return support.contradiction > std::max(kMuchContradicted, kTimesUsual * median);
}

void
JointPlacement::decide(std::size_t scan,
                       const ScanGroup& group,
                       const std::vector<LinkEvidence>& links,
                       PlaceNeeds needs,
                       Settled& settled) const
{
  const JointSupport& support = settled.best.support;
  if (support.overlap < kLeastOverlap)
    settled.rejection = {
        RejectReason::kTooFewSurfacesMeet, support.overlap, kLeastOverlap};
  else if (settled.ambiguity > max_ambiguity_)
    settled.rejection = {RejectReason::kSecondPose, settled.ambiguity, max_ambiguity_};
  else if (isContradicted(support, group))
    settled.rejection = {
        RejectReason::kSurfaceViolated, support.contradiction, kMuchContradicted};
  else {
    settled.links = evidenceOf(scan, settled.best.T_group_scan, support.met, group);
    settled.rejection = rejectionBy(settled.links, links, needs);
  }
  settled.accepted = !settled.rejection;
}

std::vector<LinkEvidence>
JointPlacement::evidenceOf(std::size_t scan,
                           const Eigen::Isometry3d& T_group_scan,
                           const std::vector<std::size_t>& met,
                           const ScanGroup& group) const
{
  std::vector<LinkEvidence> links(std::min(met.size(), kTestedLinks));
  parallelFor(links.size(), num_threads_, [&](std::size_t k) {
    const PlacedScan& member = group.members()[met[k]];
    links[k] = linkEvidence(scans_[member.scan]->scan(),
                            scans_[scan]->scan(),
                            member.T_group_scan.inverse() * T_group_scan);
  });
  return links;
}

Rejection
JointPlacement::rejectionOf(std::size_t scan,
                            const Eigen::Isometry3d& T_group_scan,
                            const ScanGroup& group,
                            const std::vector<LinkEvidence>& links,
                            PlaceNeeds needs) const
{
  const double voxel = scans_[scan]->scan().voxel();
  const JointSupport support = group.support(
      scan, T_group_scan, kMetVoxels * voxel, kPlaceVoxels * voxel, kContradictedMatch);
  return rejectionBy(evidenceOf(scan, T_group_scan, support.met, group), links, needs);
}

} // namespace pcl6d::global_registration
