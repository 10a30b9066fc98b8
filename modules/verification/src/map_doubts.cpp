// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "map_doubts.h"

#include <algorithm>
#include <cmath>

namespace pcl6d::verification {

namespace {
/** The most scans named in a message. */
constexpr std::size_t kMostNamed = 8;

/** Share of the links of a right map that may be wrong by chance; three standard deviations
 * are added. (0 of 1212 right links of bench_verification were wrong.) */
constexpr double kWrongByChance = 0.01;

std::size_t
mostByChance(std::size_t links)
{
  const double expected = kWrongByChance * static_cast<double>(links);
  return static_cast<std::size_t>(expected + 3 * std::sqrt(expected) + 1);
}

std::string
listed(const std::vector<std::string>& names)
{
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
    text += (i > 0 ? ", " : "") + names[i];
  return names.size() > kMostNamed
             ? text + " and " + std::to_string(names.size() - kMostNamed) + " more"
             : text;
}

/** \return the reason, with the name of a scan and the cause */
Rejection
withCause(RejectReason reason, const std::string& name, const Rejection& cause)
{
  Rejection rejection(reason, cause);
  rejection.text = name;
  return rejection;
}

/** \return a doubt about scans, by their names */
Rejection
aboutScans(RejectReason reason, const std::vector<std::string>& names)
{
  Rejection rejection(reason, static_cast<double>(names.size()));
  rejection.text = listed(names);
  return rejection;
}

/** \return a doubt with a cause for each scan or link */
Rejection
withCauses(RejectReason reason, const std::vector<Rejection>& causes)
{
  Rejection rejection(reason, static_cast<double>(causes.size()));
  rejection.causes = causes;
  return rejection;
}

/** \return for each scan the number of its good links minus the number of wrong ones */
std::vector<int>
votesOf(const MapVerification& map)
{
  std::vector<int> votes(map.scans.size(), 0);
  for (const LinkCheck& link : map.links)
    for (const std::size_t i : {link.from, link.to})
      votes[i] += link.trust == LinkTrust::kWrong  ? -1
                  : link.trust == LinkTrust::kWeak ? 0
                                                   : 1;
  return votes;
}
} // namespace

Rejection
MapDoubts::told(const LinkCheck& link) const
{
  return withCause(RejectReason::kOfScans,
                   names_[link.from] + " and " + names_[link.to],
                   link.rejection);
}

/** \return why a scan is disconnected: its most informative link */
Rejection
MapDoubts::reasonFor(std::size_t scan, const MapVerification& map) const
{
  const LinkCheck* telling = nullptr;
  for (const LinkCheck& link : map.links)
    if ((link.from == scan || link.to == scan) && link.rejection &&
        (!telling || link.patches > telling->patches))
      telling = &link;
  if (!telling)
    return RejectReason::kNoCommonSurfaces;
  const std::size_t other = telling->from == scan ? telling->to : telling->from;
  return withCause(RejectReason::kLinkNotConsistent, names_[other], telling->rejection);
}

/** \return the connected scans with an ambiguous pose, with the second pose */
std::vector<Rejection>
MapDoubts::twins(const MapVerification& map) const
{
  std::vector<Rejection> twins;
  for (std::size_t i = 0; i < scans_.size(); ++i)
    if (map.scans[i].tied && map.scans[i].doubt &&
        map.scans[i].doubt.reason != RejectReason::kSecondPoseNotSought)
      twins.push_back(withCause(RejectReason::kOfScans, names_[i], map.scans[i].doubt));
  return twins;
}

/** \return whether a scan is disconnected, though its pose can be tested */
bool
MapDoubts::isLoose(std::size_t scan, const MapVerification& map) const
{
  return !map.scans[scan].tied && !scans_[scan].isTooSmall();
}

/** \return whether scans are disconnected */
bool
MapDoubts::tellLoose(MapVerification& map) const
{
  std::vector<std::string> loose;
  Rejection why; // the rejected link, or the link of the first scan
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    ScanCheck& scan = map.scans[i];
    if (!isLoose(i, map))
      continue;
    if (!scan.doubt)
      scan.doubt = reasonFor(i, map);
    else
      why = scan.doubt;
    if (!why)
      why = scan.doubt;
    loose.push_back(names_[i]);
  }
  if (!loose.empty()) {
    map.doubts.push_back(aboutScans(RejectReason::kScansDisconnected, loose));
    map.doubts.back().causes = {why};
  }
  return !loose.empty();
}

/** Glass, doors and moving objects disturb rays, a small overlap disturbs surfaces: one wrong
 * link between scans with mostly good links is no proof; many wrong links are. */
MapDoubts::Against
MapDoubts::against(const MapVerification& map, bool is_silent) const
{
  const std::vector<int> votes = votesOf(map);
  Against found;
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < map.links.size(); ++k) {
    const LinkCheck& link = map.links[k];
    if (link.trust != LinkTrust::kWrong || !map.scans[link.from].tied ||
        !map.scans[link.to].tied)
      continue;
    const bool both_object =
        !is_silent && test_results_[k].elsewhere > 0.5 && test_results_[k].beside > 0.5;
    const bool is_alone = votes[link.from] >= 0 && votes[link.to] >= 0 && !both_object;
    (is_alone ? found.alone : found.proven).push_back(k);
    all.push_back(k);
  }
  if (found.alone.size() > mostByChance(map.links.size()))
    return {all, {}};
  return found;
}

void
MapDoubts::tellContradicted(const std::vector<std::size_t>& links,
                            MapVerification& map) const
{
  std::vector<Rejection> contradicted;
  for (const std::size_t k : links) {
    const LinkCheck& link = map.links[k];
    contradicted.push_back(told(link));
    for (const std::size_t i : {link.from, link.to})
      if (!map.scans[i].doubt ||
          map.scans[i].doubt.reason == RejectReason::kSecondPoseNotSought)
        map.scans[i].doubt = withCause(RejectReason::kContradictsScan,
                                       names_[i == link.from ? link.to : link.from],
                                       link.rejection);
  }
  if (!contradicted.empty())
    map.doubts.push_back(withCauses(RejectReason::kScansContradict, contradicted));
}

/** \return whether scans cannot be verified */
bool
MapDoubts::tellAbstaining(MapVerification& map) const
{
  std::vector<std::string> abstaining, off_centre;
  for (std::size_t i = 0; i < scans_.size(); ++i)
    if (map.scans[i].abstains)
      (map.scans[i].off_centre ? off_centre : abstaining).push_back(names_[i]);
  if (!off_centre.empty())
    map.doubts.push_back(aboutScans(RejectReason::kScansOffCentre, off_centre));
  if (!abstaining.empty())
    map.doubts.push_back(aboutScans(RejectReason::kScansNotVerified, abstaining));
  return !abstaining.empty() || !off_centre.empty();
}

/** Names the scans placed without a prior pose that were not searched for a second pose. */
void
MapDoubts::tellNotSought(MapVerification& map) const
{
  std::vector<std::string> not_sought;
  for (std::size_t i = 0; i < scans_.size(); ++i)
    if (map.scans[i].doubt.reason == RejectReason::kSecondPoseNotSought)
      not_sought.push_back(names_[i]);
  if (!not_sought.empty())
    map.doubts.push_back(aboutScans(RejectReason::kSecondPosesNotSought, not_sought));
}

bool
MapDoubts::isDoubtful(const MapVerification& map) const
{
  for (std::size_t i = 0; i < scans_.size(); ++i)
    if (isLoose(i, map))
      return true;
  return !against(map, map.background > kMostBackground).proven.empty();
}

void
MapDoubts::tell(MapVerification& map) const
{
  const bool is_silent = map.background > kMostBackground;
  const std::vector<Rejection> twins = this->twins(map); // before further doubts
  const bool is_loose = tellLoose(map);
  const Against against = this->against(map, is_silent);
  tellContradicted(against.proven, map);
  const bool abstains = tellAbstaining(map);
  if (is_silent)
    map.doubts.emplace_back(
        RejectReason::kBackgroundTooHigh, map.background, kMostBackground);
  std::vector<Rejection> outvoted;
  for (const std::size_t k : against.alone)
    outvoted.push_back(told(map.links[k]));
  if (!outvoted.empty())
    map.doubts.push_back(withCauses(RejectReason::kSingleLinksContradict, outvoted));
  if (!twins.empty())
    map.doubts.push_back(withCauses(RejectReason::kPosesAmbiguous, twins));
  tellNotSought(map);
  const bool is_unverified = scans_.size() < 2 || abstains || is_silent;
  map.trust = is_loose || !against.proven.empty() ? MapTrust::kDoubtful
              : !twins.empty()                    ? MapTrust::kAmbiguous
              : is_unverified                     ? MapTrust::kUnverified
                                                  : MapTrust::kGood;
}

} // namespace pcl6d::verification
