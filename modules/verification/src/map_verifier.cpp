// SPDX-License-Identifier: BSD-3-Clause
#include "links_of_map.h"
#include "map_doubts.h"
#include "refined_fit.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/verification/map_verifier.h>
#include <pcl6d/verification/ties.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using verification::surestLinkOf;

// For transfer to other processes.

template <typename Archive>
void
packFields(Archive& archive, SurfaceFit& fit)
{
  archive(fit.pairs, fit.overlap, fit.residual, fit.centroid, fit.spread, fit.step);
  archive(fit.covariance, fit.pose_covariance, fit.open_directions);
}

template <typename Archive>
void
packFields(Archive& archive, LinkEvidence& evidence)
{
  archive(evidence.sight, evidence.fit, evidence.refined, evidence.T_first_second);
  archive(evidence.voxel, evidence.abstained, evidence.off_centre);
}

template <typename Archive>
void
packFields(Archive& archive, NoticedError& noticed)
{
  archive(noticed.least, noticed.most, noticed.turn, noticed.weakest);
}

namespace {
/** Number of nearest scans that are candidates for links of a scan. */
constexpr std::size_t kAsked = 12;

/** Number of sampled points of a scan to estimate how informative a link is. */
constexpr std::size_t kAskedPoints = 300;

/** Least share of informative points for a link, in both directions. */
constexpr double kLeastSpeaking = 0.05;

Eigen::Vector3d
centreOf(const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points)
    sum += p.cast<double>();
  return points.empty() ? sum
                        : Eigen::Vector3d(sum / static_cast<double>(points.size()));
}

/** [voxels] Distance within which points of two scans without rays are on a common surface. */
constexpr double kSameSurface = 2;

/** \return the number of sampled points confirmed or contradicted by rays; without a valid ray
 * origin, the number of points on a surface */
std::size_t
spokenOf(const VerifiedScan& rays,
         const VerifiedScan& points,
         const Eigen::Isometry3d& T)
{
  const Points& all = points.surfaces().points();
  const std::size_t stride = std::max<std::size_t>(1, all.size() / kAskedPoints);
  std::size_t spoken = 0;
  const auto reach = static_cast<float>(std::pow(kSameSurface * rays.voxel(), 2));
  for (std::size_t i = 0; i < all.size(); i += stride) {
    if (rays.isOffCentre()) {
      const Eigen::Vector3f place = (T * all[i].cast<double>()).cast<float>();
      spoken += rays.surfaces().tree().nearest(place, reach).index >= 0 ? 1 : 0;
      continue;
    }
    const Sight sight = rays.rays()
                            .look((T * all[i].cast<double>()).cast<float>(),
                                  static_cast<float>(points.noise()))
                            .sight;
    spoken += sight == Sight::kConfirmed || sight == Sight::kFree ? 1 : 0;
  }
  return spoken;
}

bool
isUnregistered(std::size_t scan, const std::vector<bool>& unregistered)
{
  return !unregistered.empty() && unregistered[scan];
}

/** \return the links as they connect scans: a link of an unregistered scan connects nothing. Its pose
 * is a prediction, and would connect two parts of the map that no link of registered scans
 * connects */
std::vector<LinkCheck>
connectingLinks(std::vector<LinkCheck> links, const std::vector<bool>& unregistered)
{
  for (LinkCheck& link : links)
    if (isUnregistered(link.from, unregistered) ||
        isUnregistered(link.to, unregistered))
      link.trust = LinkTrust::kWeak;
  return links;
}

} // namespace

void
MapVerifierOptions::validate() const
{
  require(links_per_scan > 0, "links_per_scan", links_per_scan, "> 0");
}

MapVerifier::MapVerifier(const std::deque<VerifiedScan>& scans,
                         std::vector<std::string> names,
                         const MapVerifierOptions& options)
: scans_(scans), names_(std::move(names)), options_(options)
{
  options_.validate();
  require(names_.size() == scans_.size(), "names", names_.size(), "one per scan");
  const auto requireOnePerScan = [&](const char* name, const std::vector<bool>& flags) {
    require(flags.empty() || flags.size() == scans_.size(),
            name,
            flags.size(),
            "empty or equal to the number of scans");
  };
  requireOnePerScan("unsure", options_.unsure);
  requireOnePerScan("unregistered", options_.unregistered);
  for (const VerifiedScan& scan : scans_)
    centres_.push_back(centreOf(scan.surfaces().points()));
}

std::size_t
MapVerifier::speaking(const Pair& pair,
                      const std::vector<Eigen::Isometry3d>& poses) const
{
  const auto [a, b] = pair;
  const Eigen::Isometry3d T_a_b = poses[a].inverse() * poses[b];
  return spokenOf(scans_[a], scans_[b], T_a_b) +
         spokenOf(scans_[b], scans_[a], T_a_b.inverse());
}

/** Links of each scan: to the scan before, and to the most informative earlier scans. */
std::vector<MapVerifier::Pair>
MapVerifier::choosePairs(const std::vector<Eigen::Isometry3d>& poses) const
{
  const std::size_t n = scans_.size();
  std::vector<std::vector<Pair>> chosen(n);
  sharedFor(options_.sharing, options_.num_threads, chosen, [&](std::size_t i) {
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t k = 0; k < i; ++k)
      near.emplace_back((poses[i] * centres_[i] - poses[k] * centres_[k]).norm(), k);
    const std::size_t asked = std::min(kAsked, near.size());
    std::partial_sort(
        near.begin(), near.begin() + static_cast<long>(asked), near.end());
    near.resize(asked);
    std::vector<std::pair<std::size_t, std::size_t>> most; // informative points, scan
    for (const auto& [distance, k] : near)
      if (k + 1 != i) {
        const std::size_t count = speaking({k, i}, poses);
        if (static_cast<double>(count) >= 2 * kLeastSpeaking * kAskedPoints)
          most.emplace_back(count, k);
      }
    std::sort(most.rbegin(), most.rend());
    if (i > 0)
      chosen[i].emplace_back(i - 1, i);
    for (std::size_t k = 0; k < std::min(most.size(), options_.links_per_scan); ++k)
      chosen[i].emplace_back(most[k].second, i);
  });
  std::vector<Pair> pairs;
  for (const auto& of_scan : chosen)
    pairs.insert(pairs.end(), of_scan.begin(), of_scan.end());
  return pairs;
}

/** Detectable shift of the most certain link of each scan. */
void
MapVerifier::probe(const std::vector<Eigen::Isometry3d>& poses,
                   MapVerification& map) const
{
  std::vector<std::size_t> surest(scans_.size(), map.links.size());
  std::vector<bool> asked(map.links.size(), false);
  for (std::size_t i = 0; i < scans_.size(); ++i)
    if (const LinkCheck* link = surestLinkOf(i, map)) {
      surest[i] = static_cast<std::size_t>(link - map.links.data());
      asked[surest[i]] = true;
    }
  std::vector<std::optional<NoticedError>> noticed(map.links.size());
  const auto later = [&](std::size_t k) { return map.links[k].to; };
  sharedFor(options_.sharing, options_.num_threads, noticed, later, [&](std::size_t k) {
    const LinkCheck& link = map.links[k];
    if (asked[k])
      noticed[k] = noticedError(
          scans_[link.from], scans_[link.to], evidence_[k], map.background);
  });
  for (std::size_t k = 0; k < noticed.size(); ++k)
    map.links[k].noticed = noticed[k];
  for (std::size_t i = 0; i < scans_.size(); ++i)
    if (surest[i] < map.links.size() && map.links[surest[i]].noticed) {
      const LinkCheck& link = map.links[surest[i]];
      map.scans[i].noticed = link.noticed;
      map.scans[i].noticed->weakest = poses[link.from].linear() * link.noticed->weakest;
    }
}

/** Sets which scans are connected and have usable rays. Links with a predicted pose may be consistent
 * by chance, or inconclusive: they neither connect the scan nor others by way of it. */
void
MapVerifier::checkScans(const verification::Ties& ties, MapVerification& map) const
{
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    ScanCheck& scan = map.scans[i];
    scan.abstains = scans_[i].abstains();
    scan.off_centre = scans_[i].isOffCentre();
    scan.tied = ties.tied[i] && !isUnregistered(i, options_.unregistered);
    if (!scan.tied)
      scan.doubt = ties.cut_from[i];
  }
  for (const LinkCheck& link : map.links) {
    if (link.trust != LinkTrust::kGood && link.trust != LinkTrust::kUnverified)
      continue;
    for (const auto& [scan, other] :
         {std::pair(link.from, link.to), std::pair(link.to, link.from)})
      if (isUnregistered(scan, options_.unregistered) &&
          !isUnregistered(other, options_.unregistered))
        map.scans[scan].doubt = RejectReason::kScanUnregistered;
  }
}

/** \return the evidence of a link from the verdict before, perhaps at another pose; null: none */
const LinkEvidence*
MapVerifier::knownEvidence(const Pair& pair) const
{
  if (!options_.memory)
    return nullptr;
  const auto found = options_.memory->find(pair);
  return found == options_.memory->end() ? nullptr : &found->second;
}

/** Tests the links, except for those known from the verdict before. */
void
MapVerifier::collectEvidence(const std::vector<Pair>& pairs,
                             const std::vector<Eigen::Isometry3d>& poses)
{
  evidence_.assign(pairs.size(), {});
  const auto later = [&](std::size_t k) { return pairs[k].second; };
  sharedFor(
      options_.sharing, options_.num_threads, evidence_, later, [&](std::size_t k) {
        const auto [a, b] = pairs[k];
        const Eigen::Isometry3d T = poses[a].inverse() * poses[b];
        const LinkEvidence* known = knownEvidence(pairs[k]);
        const bool is_same = known && known->T_first_second.matrix() == T.matrix();
        evidence_[k] = is_same ? *known : linkEvidence(scans_[a], scans_[b], T);
        if (!options_.refined)
          evidence_[k].refined.reset();
        else if (!is_same && known && known->refined)
          evidence_[k].refined =
              verification::seenFrom(T, known->T_first_second, *known->refined);
      });
}

/** Keeps the evidence for the next verdict. */
void
MapVerifier::remember(const std::vector<Pair>& pairs)
{
  if (!options_.memory)
    return;
  options_.memory->clear();
  for (std::size_t k = 0; k < pairs.size(); ++k)
    options_.memory->emplace(pairs[k], evidence_[k]);
}

/** Fits the links between connected scans anew, as refined matches do: no further link measures a pose. */
void
MapVerifier::refineLinks(MapVerification& map)
{
  std::vector<std::size_t> tied;
  for (std::size_t k = 0; k < map.links.size(); ++k) {
    const LinkCheck& link = map.links[k];
    if (map.scans[link.from].tied && map.scans[link.to].tied && !evidence_[k].refined)
      tied.push_back(k);
  }
  std::vector<LinkEvidence> refined;
  refined.reserve(tied.size());
  for (const std::size_t k : tied)
    refined.push_back(evidence_[k]);
  const auto later = [&](std::size_t k) { return map.links[tied[k]].to; };
  sharedFor(options_.sharing, options_.num_threads, refined, later, [&](std::size_t k) {
    const LinkCheck& link = map.links[tied[k]];
    refineEvidence(scans_[link.from], scans_[link.to], refined[k]);
  });
  for (std::size_t k = 0; k < tied.size(); ++k)
    evidence_[tied[k]] = std::move(refined[k]);
  for (std::size_t k = 0; k < map.links.size(); ++k) {
    LinkCheck& link = map.links[k];
    const LinkCheck anew =
        linkCheck(link.from, link.to, evidence_[k], test_results_[k]);
    link.pull = anew.pull;
    link.covariance = anew.covariance;
    link.refined = anew.refined;
  }
}

MapVerification
MapVerifier::verify(const std::vector<Eigen::Isometry3d>& T_world_scan)
{
  require(T_world_scan.size() == scans_.size(),
          "poses",
          T_world_scan.size(),
          "one per scan");
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (!isRigid(T_world_scan[i]))
      throw BadArgument(names_[i] + ": the pose is not a rigid motion");
  const std::vector<Pair> pairs = choosePairs(T_world_scan);
  collectEvidence(pairs, T_world_scan);
  MapVerification map;
  map.scans.resize(scans_.size());
  map.background = contradictionBackground(evidence_);
  test_results_.clear();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    test_results_.push_back(testLink(evidence_[k], map.background));
    map.links.push_back(
        linkCheck(pairs[k].first, pairs[k].second, evidence_[k], test_results_.back()));
  }
  if (scans_.empty())
    return map;
  const verification::Ties ties = verification::tiesOf(
      scans_.size(), connectingLinks(map.links, options_.unregistered), map.background);
  for (std::size_t k = 0; k < map.links.size(); ++k)
    if (ties.cut[k] && map.links[k].trust == LinkTrust::kGood) {
      map.links[k].trust = LinkTrust::kWeak;
      map.links[k].rejection = ties.cut_from[map.links[k].from];
    }
  checkScans(ties, map);
  std::vector<bool> connected;
  for (const ScanCheck& scan : map.scans)
    connected.push_back(scan.tied);
  const bool is_brief = options_.is_kept && !options_.is_kept(connected);
  if (!options_.unsure.empty() && !is_brief)
    findTwins(T_world_scan, map);
  if (options_.probe && !is_brief)
    probe(T_world_scan, map);
  if (options_.refined && !is_brief)
    refineLinks(map);
  remember(pairs);
  verification::MapDoubts(scans_, names_, test_results_).tell(map);
  return map;
}

} // namespace pcl6d
