// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "joint_placement.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/verification/ties.h>

#include <algorithm>
#include <utility>

namespace pcl6d::global_registration {

namespace {
/** So many places of a scan are looked at, and so many of these matched. */
constexpr std::size_t kPlacesLookedAt = 8, kSettled = 3;

/** Half of the points are enough for a look. */
constexpr std::size_t kLookEvery = 2;

/** Where rays contradict more of what meets, by points, a place is held to what they contradict
 * of its members' own places: more than so many times as much is none. Places of the street,
 * the corridor and simulated rooms have up to 0.09 where they are right, wrong ones from 0.13
 * on; the mean of right ones is a third of that. */
constexpr double kMuchContradicted = 0.12, kTimesUsual = 2;
constexpr std::size_t kUsualMembers = 6;

/** A link with more than this is another place by its rays. */
constexpr double kElsewhere = 0.5;

void
sortPlaces(std::vector<Place>& places)
{
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.support.score > b.support.score;
  });
}

/** \return what links of a place say against it \param[out] is_held one says it is right */
std::string
objectionOf(const std::vector<LinkEvidence>& of_place,
            const std::vector<LinkEvidence>& links,
            bool& is_held)
{
  const double background = contradictionBackground(links);
  is_held = false;
  for (const auto& link : of_place) {
    const LinkOpinion opinion = judgeLink(link, background);
    if (opinion.trust == LinkTrust::kWrong && opinion.elsewhere > kElsewhere)
      return "a scan speaks against the best place: " + opinion.reason;
    is_held =
        is_held || opinion.trust == LinkTrust::kGood; // who abstains holds nothing
  }
  return "";
}

/** What all links of a place say of it together, as of a map in which the others hold.
 * \param[in] links of the map, by which such links are contradicted anyway */
std::string
doubtOfAll(const std::vector<LinkEvidence>& of_place,
           const std::vector<LinkEvidence>& links)
{
  const double background = contradictionBackground(links);
  const std::size_t scan = of_place.size(), rest = scan + 1; // the others are before it
  std::vector<LinkCheck> checks;
  for (std::size_t k = 0; k < scan; ++k) {
    checks.push_back(
        linkCheck(k, scan, of_place[k], judgeLink(of_place[k], background)));
    LinkCheck held; // by the others, to each other
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
  return verification::tiesOf(rest + 1, checks, background).cut_from[scan];
}

std::vector<LinkEvidence>
withThingsOnce(std::vector<LinkEvidence> links)
{
  for (LinkEvidence& link : links)
    link = pcl6d::withThingsOnce(std::move(link));
  return links;
}

/** \return why the links of a place speak against it, or that no link holds it although one is
 * needed; empty if it is accepted. Where odometry expected the place, each isolated thing in
 * the way of rays counts once: people may walk about the scanner */
std::string
objectionBy(std::vector<LinkEvidence> of_place,
            std::vector<LinkEvidence> links,
            PlaceNeeds needs)
{
  if (needs == PlaceNeeds::kToBeHeldAsExpected) {
    of_place = withThingsOnce(std::move(of_place));
    links = withThingsOnce(std::move(links));
  }
  bool is_held = false;
  const std::string objection = objectionOf(of_place, links, is_held);
  if (!objection.empty() || needs == PlaceNeeds::kNoObjection)
    return objection;
  if (!is_held)
    return "no scan holds it where it fits best";
  return needs == PlaceNeeds::kToBeTied ? doubtOfAll(of_place, links) : "";
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

/** \return whether rays contradict more of a place than of those that its members have */
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
    settled.reason = "too few of its surfaces meet those of others";
  else if (settled.ambiguity > max_ambiguity_)
    settled.reason = "another place is nearly as good";
  else if (isContradicted(support, group))
    settled.reason = "rays go through too much of it where it fits best";
  else {
    settled.links = evidenceOf(scan, settled.best.T_group_scan, support.met, group);
    settled.reason = objectionBy(settled.links, links, needs);
  }
  settled.accepted = settled.reason.empty();
}

std::vector<LinkEvidence>
JointPlacement::evidenceOf(std::size_t scan,
                           const Eigen::Isometry3d& T_group_scan,
                           const std::vector<std::size_t>& met,
                           const ScanGroup& group) const
{
  std::vector<LinkEvidence> links(std::min(met.size(), kJudgedLinks));
  parallelFor(links.size(), num_threads_, [&](std::size_t k) {
    const PlacedScan& member = group.members()[met[k]];
    links[k] = linkEvidence(scans_[member.scan]->scan(),
                            scans_[scan]->scan(),
                            member.T_group_scan.inverse() * T_group_scan);
  });
  return links;
}

std::string
JointPlacement::objectionTo(std::size_t scan,
                            const Eigen::Isometry3d& T_group_scan,
                            const ScanGroup& group,
                            const std::vector<LinkEvidence>& links,
                            PlaceNeeds needs) const
{
  const double voxel = scans_[scan]->scan().voxel();
  const JointSupport support = group.support(
      scan, T_group_scan, kMetVoxels * voxel, kPlaceVoxels * voxel, kContradictedMatch);
  return objectionBy(evidenceOf(scan, T_group_scan, support.met, group), links, needs);
}

} // namespace pcl6d::global_registration
