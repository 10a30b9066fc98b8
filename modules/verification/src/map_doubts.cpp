// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "map_doubts.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

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

std::string
silenceOf(double background)
{
  std::ostringstream text; // read by people
  text << "rays contradict " << std::fixed << std::setprecision(0) << 100 * background
       << " % of the surface even where scans fit best (glass, motion during the scan, "
          "errors of the scanner?): rays cannot tell equal-looking places apart";
  return text.str();
}
} // namespace

std::string
MapDoubts::told(const LinkCheck& link) const
{
  return names_[link.from] + " and " + names_[link.to] + " (" +
         toWords(link.rejection) + ")";
}

/** \return why a scan is disconnected: its most informative link */
std::string
MapDoubts::reasonFor(std::size_t scan, const MapVerification& map) const
{
  const LinkCheck* telling = nullptr;
  for (const LinkCheck& link : map.links)
    if ((link.from == scan || link.to == scan) && link.rejection &&
        (!telling || link.patches > telling->patches))
      telling = &link;
  if (!telling)
    return "no second scan has these surfaces";
  const std::size_t other = telling->from == scan ? telling->to : telling->from;
  return "with " + names_[other] + ": " + toWords(telling->rejection);
}

/** \return the connected scans with an ambiguous pose, with the second pose */
std::vector<std::string>
MapDoubts::twins(const MapVerification& map) const
{
  std::vector<std::string> twins;
  for (std::size_t i = 0; i < scans_.size(); ++i)
    if (map.scans[i].tied && !map.scans[i].doubt.empty())
      twins.push_back(names_[i] + " (" + map.scans[i].doubt + ")");
  return twins;
}

/** \return whether scans are disconnected */
bool
MapDoubts::tellLoose(MapVerification& map) const
{
  std::vector<std::string> loose;
  std::string why; // the rejected link, or the link of the first scan
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    ScanCheck& scan = map.scans[i];
    if (scan.tied || scans_[i].isTooSmall()) // its pose cannot be tested
      continue;
    if (scan.doubt.empty())
      scan.doubt = reasonFor(i, map);
    else
      why = scan.doubt;
    if (why.empty())
      why = scan.doubt;
    loose.push_back(names_[i]);
  }
  if (!loose.empty())
    map.doubts.push_back(text::counted(loose.size(), "scan") +
                         " not connected to the rest: " + listed(loose) + " (" + why +
                         "); better initial poses or scans in between would help");
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
  std::vector<std::string> contradicted;
  for (const std::size_t k : links) {
    const LinkCheck& link = map.links[k];
    contradicted.push_back(told(link));
    for (const std::size_t i : {link.from, link.to})
      if (map.scans[i].doubt.empty())
        map.scans[i].doubt = "contradicts " +
                             names_[i == link.from ? link.to : link.from] + ": " +
                             toWords(link.rejection);
  }
  if (!contradicted.empty())
    map.doubts.push_back("scans contradict each other: " + listed(contradicted));
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
    map.doubts.push_back(
        text::counted(off_centre.size(), "scan") +
        " not centred on the scanner (rays from the origin would cross surfaces of "
        "their own scan): free-space tests are off, only surfaces were compared: " +
        listed(off_centre));
  if (!abstaining.empty())
    map.doubts.push_back(
        text::counted(abstaining.size(), "scan") +
        " cannot be verified: too few surfaces, or rays contradicting points of their "
        "own scan (merged scans, motion during the scan?): " +
        listed(abstaining));
  return !abstaining.empty() || !off_centre.empty();
}

void
MapDoubts::tell(MapVerification& map) const
{
  const bool is_silent = map.background > kMostBackground;
  const std::vector<std::string> twins = this->twins(map); // before further doubts
  const bool is_loose = tellLoose(map);
  const Against against = this->against(map, is_silent);
  tellContradicted(against.proven, map);
  const bool abstains = tellAbstaining(map);
  if (is_silent)
    map.doubts.push_back(silenceOf(map.background));
  std::vector<std::string> outvoted;
  for (const std::size_t k : against.alone)
    outvoted.push_back(told(map.links[k]));
  if (!outvoted.empty())
    map.doubts.push_back("most links of these scans are consistent, a single link is "
                         "not (glass, dynamic objects, little overlap?): " +
                         listed(outvoted));
  if (!twins.empty())
    map.doubts.push_back(
        "AMBIGUOUS, two places fit: " + listed(twins) +
        "; rough initial poses, or scans on the way between, would decide");
  const bool is_unverified = scans_.size() < 2 || abstains || is_silent;
  map.trust = is_loose || !against.proven.empty() ? MapTrust::kDoubtful
              : !twins.empty()                    ? MapTrust::kAmbiguous
              : is_unverified                     ? MapTrust::kUnverified
                                                  : MapTrust::kGood;
}

} // namespace pcl6d::verification
