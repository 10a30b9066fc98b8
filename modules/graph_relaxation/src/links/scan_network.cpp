// SPDX-License-Identifier: BSD-3-Clause
#include "links/partner_search.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/graph_relaxation/scan_network.h>
#include <pcl6d/registration/plane_sums.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pcl6d {

namespace {
/** Links are chosen again after a pose has moved by this share of max_distance, or turned by
 * the angle. */
constexpr double kMoved = 0.2, kTurned = 0.01; // [rad]

/** The norm of a pair in the axes of the world, from the normals of both points. */
Eigen::Matrix3d
normOf(Metric metric,
       const Eigen::Vector3d& normal_a,
       const Eigen::Vector3d& normal_b,
       double epsilon)
{
  if (metric == Metric::kGicp)
    return planeToPlane(normal_a, normal_b, epsilon);
  return normal_a * normal_a.transpose();
}

/** Average number of links per scan with the full number of points; more links use fewer points
 * each. */
constexpr std::size_t kLinksPerScan = 32;

/** Least points of a link: with fewer, links lack the pairs needed by relaxation. */
constexpr std::size_t kLeastPoints = 200;

/** Most points of a last round: their pairs take 100 MB. */
constexpr std::size_t kPointsOfLastRound = 1000000;

std::size_t
strideFor(std::size_t points, std::size_t wanted)
{
  return std::max<std::size_t>(1, (points + wanted - 1) / wanted);
}

constexpr Named<LinkRule> kRules[] = {{LinkRule::kOverlap, "overlap"},
                                      {LinkRule::kDistance, "distance"}};
} // namespace

std::vector<std::string>
linkRuleNames()
{
  return namesOf(kRules);
}

LinkRule
linkRuleFromName(const std::string& name)
{
  return fromName(kRules, "links", name);
}

const char*
toString(LinkRule rule)
{
  return nameOf(kRules, rule);
}

void
ScanNetworkOptions::validate() const
{
  require(max_distance > 0, "max_distance", max_distance, "> 0");
  require(
      min_overlap >= 0 && min_overlap <= 1, "min_overlap", min_overlap, "in [0, 1]");
  require(link_distance > 0, "link_distance", link_distance, "> 0");
  require(hysteresis >= 0 && hysteresis < 1, "hysteresis", hysteresis, "in [0, 1)");
  require(points_per_link > 0, "points_per_link", points_per_link, "> 0");
  require(
      gicp_epsilon > 0 && gicp_epsilon <= 1, "gicp_epsilon", gicp_epsilon, "in (0, 1]");
  require(last_gicp_epsilon > 0 && last_gicp_epsilon <= 1,
          "last_gicp_epsilon",
          last_gicp_epsilon,
          "in (0, 1]");
}

ScanNetwork::ScanNetwork(const std::vector<NetworkScan>& scans,
                         std::vector<bool> usable,
                         const ScanNetworkOptions& options)
: scans_(scans), usable_(std::move(usable)), options_(options)
{
  options_.validate();
  require(usable_.size() == scans_.size(), "usable", usable_.size(), "one per scan");
  for (const NetworkScan& scan : scans_)
    require(options_.metric == Metric::kPoint ||
                scan.model().normals().size() == scan.model().points().size(),
            "normals of a scan",
            scan.model().normals().size(),
            "equal to the number of points, for metrics of planes");
}

void
ScanNetwork::keep(std::size_t a, std::size_t b, LinkKind kind, bool trusted)
{
  require(a < scans_.size(), "scan of a link", a, "below the number of scans");
  require(b < scans_.size(), "scan of a link", b, "below the number of scans");
  require(a != b, "link of a scan to itself", a, "between two scans");
  const ScanPair link = std::minmax(a, b);
  const auto known = kept_.find(link);
  if (known == kept_.end())
    kept_[link] = {kind, trusted};
}

/** \return tolerance for a link chosen before: share of min_overlap, link_distance */
double
ScanNetwork::slack(const ScanPair& link) const
{
  return chosen_.count(link) > 0 ? options_.hysteresis : 0;
}

std::set<ScanPair>
ScanNetwork::byOverlap(const Poses& poses) const
{
  const auto found = overlappingPairs(
      scans_,
      poses,
      1.2 * options_.max_distance, // some come nearer later
      [&](const ScanPair& link) { return (1 - slack(link)) * options_.min_overlap; },
      options_.num_threads,
      options_.sharing);
  return {found.begin(), found.end()};
}

std::set<ScanPair>
ScanNetwork::byDistance(const Poses& poses) const
{
  std::set<ScanPair> links;
  for (std::size_t b = 0; b < scans_.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      const double apart = (poses[a].translation() - poses[b].translation()).norm();
      if (apart < (1 + slack({a, b})) * options_.link_distance)
        links.insert({a, b});
    }
  return links;
}

void
ScanNetwork::choose(const Poses& poses)
{
  const bool as_before =
      chosen_at_.size() == poses.size() &&
      std::equal(poses.begin(),
                 poses.end(),
                 chosen_at_.begin(),
                 [&](const Eigen::Isometry3d& now, const Eigen::Isometry3d& then) {
                   const MotionSize moved = distanceBetween(then, now);
                   return moved.translation < kMoved * options_.max_distance &&
                          moved.rotation < kTurned;
                 });
  if (as_before)
    return;
  chosen_at_ = poses;
  std::set<ScanPair> chosen;
  for (const ScanPair& link :
       options_.rule == LinkRule::kOverlap ? byOverlap(poses) : byDistance(poses))
    if (usable_[link.first] && usable_[link.second])
      chosen.insert(link);
  for (const auto& [link, kept] : kept_)
    if (usable_[link.first] && usable_[link.second])
      chosen.insert(link);
  chosen_ = std::move(chosen);
  for (auto link = remembered_.begin(); link != remembered_.end();)
    link = chosen_.count(link->first) > 0 ? std::next(link) : remembered_.erase(link);
}

std::size_t
ScanNetwork::pointsPerLink() const
{
  const std::size_t full = kLinksPerScan * scans_.size();
  if (chosen_.size() <= full)
    return options_.points_per_link;
  return std::max(std::min(kLeastPoints, options_.points_per_link),
                  options_.points_per_link * full / chosen_.size());
}

std::size_t
ScanNetwork::strideOf(const ScanPair& link, std::size_t points_per_link) const
{
  return strideFor(scans_[link.second].model().points().size(), points_per_link);
}

LinkPairs
ScanNetwork::pairsOf(const ScanPair& link,
                     const Poses& poses,
                     const Round& round,
                     std::vector<RememberedPartner>& remembered) const
{
  const auto [a, b] = link;
  LinkPairs pairs;
  pairs.from = a;
  pairs.to = b;
  const auto kept = kept_.find(link);
  pairs.trusted = kept != kept_.end() && kept->second.trusted;
  const std::size_t stride = strideOf(link, round.points_per_link);
  const std::size_t usual = strideOf(link, pointsPerLink());
  pairs.redundancy = static_cast<double>(usual) / static_cast<double>(stride);
  if (options_.sharing && !options_.sharing->owns(b))
    return pairs;
  const IcpModel &from = scans_[a].model(), &to = scans_[b].model();
  const PartnerSearch partnerOf(
      scans_[a], scans_[b], poses[a].inverse() * poses[b], options_.max_distance);
  const std::size_t looked_at = (to.points().size() + usual - 1) / usual;
  if (remembered.size() != looked_at) // different points
    remembered.assign(looked_at, {});
  for (std::size_t i = 0; i < to.points().size(); i += stride) {
    const int partner =
        stride == usual ? partnerOf(i, remembered[i / stride]) : partnerOf(i);
    if (partner < 0)
      continue;
    if (options_.metric != Metric::kPoint) {
      const Eigen::Vector3d n =
          poses[a].linear() * from.normals()[partner].cast<double>();
      const Eigen::Vector3d m = poses[b].linear() * to.normals()[i].cast<double>();
      if (options_.metric == Metric::kPlane && n.isZero(0))
        continue;
      pairs.norms.push_back(normOf(options_.metric, n, m, round.gicp_epsilon));
    }
    pairs.points_from.push_back(from.points()[partner]);
    pairs.points_to.push_back(to.points()[i]);
  }
  return pairs;
}

std::vector<LinkPairs>
ScanNetwork::pairsOfAll(const Poses& poses, const Round& round)
{
  const std::vector<ScanPair> links(chosen_.begin(), chosen_.end());
  std::vector<std::vector<RememberedPartner>*> remembered;
  for (const ScanPair& link : links)
    remembered.push_back(&remembered_[link]);
  std::vector<LinkPairs> found(links.size());
  parallelFor(links.size(), options_.num_threads, [&](std::size_t k) {
    found[k] = pairsOf(links[k], poses, round, *remembered[k]);
  });
  return found;
}

std::vector<LinkPairs>
ScanNetwork::pairs(const Poses& poses)
{
  require(poses.size() == scans_.size(), "poses", poses.size(), "one per scan");
  choose(poses);
  const std::size_t wanted = pointsPerLink();
  for (const ScanPair& link : chosen_)
    looked_at_ += scans_[link.second].model().points().size() / strideOf(link, wanted);
  return pairsOfAll(poses, {wanted, options_.gicp_epsilon});
}

std::vector<LinkPairs>
ScanNetwork::pairsOfLastRound(const Poses& poses)
{
  require(poses.size() == scans_.size(), "poses", poses.size(), "one per scan");
  choose(poses);
  const std::size_t links = std::max<std::size_t>(1, chosen_.size());
  const std::size_t wanted = std::min(looked_at_, kPointsOfLastRound) / links;
  return pairsOfAll(poses,
                    {std::max(pointsPerLink(), wanted), options_.last_gicp_epsilon});
}

ScanLink
ScanNetwork::describeLink(const ScanPair& pair, const Poses& poses) const
{
  const auto [a, b] = pair;
  ScanLink link;
  link.from = a;
  link.to = b;
  const auto kept = kept_.find(pair);
  link.kind = kept != kept_.end() ? kept->second.kind : LinkKind::kNetwork;
  link.distance = (poses[a].translation() - poses[b].translation()).norm();
  if (!usable_[a] || !usable_[b]) {
    link.verdict = LinkVerdict::kRefused;
    link.rejection = RejectReason::kScanUnregistered;
    return link;
  }
  const IcpModel &from = scans_[a].model(), &to = scans_[b].model();
  const Eigen::Isometry3d T_a_b = poses[a].inverse() * poses[b];
  const PartnerSearch partnerOf(scans_[a], scans_[b], T_a_b, options_.max_distance);
  const std::size_t stride = strideOf(pair, pointsPerLink());
  PlaneAccumulator planes;
  double sum_sq = 0;
  std::size_t looked = 0;
  for (std::size_t i = 0; i < to.points().size(); i += stride, ++looked) {
    const int partner = partnerOf(i);
    if (partner < 0)
      continue;
    const Eigen::Vector3d p = T_a_b * to.points()[i].cast<double>();
    const Eigen::Vector3d m = from.points()[partner].cast<double>();
    ++link.pairs;
    sum_sq += (p - m).squaredNorm();
    if (!from.normals().empty())
      planes.add(p, m, from.normals()[partner].cast<double>());
  }
  if (link.pairs > 0) {
    link.overlap = static_cast<double>(link.pairs) / static_cast<double>(looked);
    link.rms = std::sqrt(sum_sq / static_cast<double>(link.pairs));
  }
  if (planes.sums().count >= 6)
    link.condition = localizabilityOf(planes.sums()).eigenvalues.minCoeff();
  return link;
}

std::vector<ScanLink>
ScanNetwork::describe(const Poses& poses) const
{
  std::set<ScanPair> all = chosen_;
  for (const auto& [link, kept] : kept_)
    all.insert(link);
  const std::vector<ScanPair> links(all.begin(), all.end());
  std::vector<ScanLink> described(links.size());
  const auto later = [&](std::size_t k) { return links[k].second; };
  sharedFor(
      options_.sharing, options_.num_threads, described, later, [&](std::size_t k) {
        described[k] = describeLink(links[k], poses);
      });
  return described;
}

} // namespace pcl6d
