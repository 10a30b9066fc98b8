// SPDX-License-Identifier: BSD-3-Clause
#include "icp/correspondence_search.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d::registration {

namespace {
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float
squaredAsFloat(double distance)
{
  // PCL's "no limit" is the root of the largest double.
  return static_cast<float>(std::min(
      distance * distance, static_cast<double>(std::numeric_limits<float>::max())));
}

bool
isIdentity(const Eigen::Isometry3d& T)
{
  return (T.matrix().array() == Eigen::Matrix4d::Identity().array()).all();
}
} // namespace

struct CorrespondenceSearch::Look {
  std::size_t stride;
  Placement source;
  std::vector<Placement> source_in_part;
  float limit;    ///< [m]
  float reach;    ///< [m] reach of the search beyond the neighbour, for later
  float reach_sq; ///< [m^2] of limit + reach
};

CorrespondenceSearch::CorrespondenceSearch(const IcpTarget& target,
                                           const IcpSource& source,
                                           const IcpOptions& options)
: target_(target)
, source_(*source.points)
, source_normals_(options.metric == Metric::kGicp || options.symmetric ? source.normals
                                                                       : nullptr)
, options_(options)
, remembers_(options.remember_neighbours &&
             std::all_of(target.begin(),
                         target.end(),
                         [](const IcpTargetPart& part) {
                           return part.memory == SearchMemory::kNeighbours;
                         }))
, partners_(source_.size())
{
  for (const auto& part : target_) {
    const bool of_leaves = part.memory == SearchMemory::kLeaves;
    leaves_.emplace_back(of_leaves ? source_.size() : 0, -1);
    is_identity_.push_back(isIdentity(part.T_target_part));
    frames_ =
        std::max(frames_, static_cast<float>(part.T_target_part.translation().norm()));
  }
}

void
CorrespondenceSearch::update(const Placement& source,
                             double limit,
                             double next_motion,
                             int stride)
{
  Look look;
  look.stride = stride;
  look.source = source;
  for (std::size_t i = 0; i < target_.size(); ++i) {
    look.source_in_part.push_back(source);
    if (!is_identity_[i])
      look.source_in_part.back().T = target_[i].T_target_part.inverse() * source.T;
  }
  look.limit = std::sqrt(squaredAsFloat(limit));
  look.reach = remembers_ ? static_cast<float>(next_motion) : 0;
  look.reach_sq = squaredAsFloat(limit + look.reach);
  searches_.assign((source_.size() + kBlockSize - 1) / kBlockSize, {});
  parallelBlocks(source_.size(), kBlockSize, options_.num_threads, [&](const Block& b) {
    searches_[b.index] = updateBlock(look, b);
  });
}

/** Keeps a neighbour if no other point can have become nearer, by the triangle inequality with a
 * margin for the rounding of the compared distances. */
CorrespondenceSearch::Searches
CorrespondenceSearch::updateBlock(const Look& look, const Block& block)
{
  constexpr float kRounding = 16 * std::numeric_limits<float>::epsilon();
  const float limit_sq = look.limit * look.limit;
  Searches searches;
  for (std::size_t i = block.begin; i < block.end; ++i) {
    Partner& partner = partners_[i];
    if (i % look.stride != 0) {
      partner.weight = 0;
      continue;
    }
    const Eigen::Vector3f p = look.source(source_[i]).cast<float>();
    const float own = partner.index < 0 ? kInfinity : (p - partner.point).norm();
    const float moved = (p - partner.searched_at).norm();
    const float sizes = p.cwiseAbs().maxCoeff() + frames_ + partner.others +
                        (partner.index < 0 ? 0 : own);
    const float others = partner.others - moved - kRounding * sizes;
    const bool is_known =
        remembers_ && (own < others || (own >= look.limit && others >= look.limit));
    if (!is_known) {
      ++searches.all;
      searches.from_leaf += knowsLeaf(i) ? 1 : 0;
      search(look, i, p, own);
    }
    partner.distance_sq =
        partner.index < 0 ? kInfinity : pcl6d::distanceSq(p, partner.point);
    partner.weight =
        partner.usable && partner.distance_sq < limit_sq && facesAlike(look, i) ? 1 : 0;
  }
  return searches;
}

bool
CorrespondenceSearch::knowsLeaf(std::size_t i) const
{
  return std::any_of(leaves_.begin(), leaves_.end(), [i](const auto& of_part) {
    return !of_part.empty() && of_part[i] >= 0;
  });
}

/** Normals with a smaller cosine point apart: clearly, since pairs that come and go with the noise
 * of a normal would keep ICP from converging. */
constexpr double kOpposite = -0.5;

/** \return false for the two faces of a wall: normals that point apart */
bool
CorrespondenceSearch::facesAlike(const Look& look, std::size_t i) const
{
  if (!options_.facing_normals || !source_normals_)
    return true;
  const Eigen::Vector3d normal =
      look.source.T.linear() * (*source_normals_)[i].cast<double>();
  return normal.dot(partners_[i].normal.cast<double>()) > kOpposite;
}

/** Searches the parts, starting with the part of the last neighbour: its distance
 * prunes the others. */
void
CorrespondenceSearch::search(const Look& look,
                             std::size_t i,
                             const Eigen::Vector3f& p,
                             float own)
{
  Partner& partner = partners_[i];
  const bool has_candidate = own * own < look.reach_sq;
  TwoNearest best{{-1, look.reach_sq}, look.reach_sq};
  int part = has_candidate ? partner.part : -1;
  if (has_candidate)
    searchPart(look, i, partner.part, partner.index, best);
  int index = best.nearest.index;
  const int count = static_cast<int>(target_.size());
  for (int other = 0; other < count; ++other) {
    if (has_candidate && other == partner.part)
      continue;
    if (searchPart(look, i, other, -1, best)) {
      part = other;
      index = best.nearest.index;
    }
  }
  partner.searched_at = p;
  partner.others = std::sqrt(best.second_sq);
  setPartner(i, part, index);
}

bool
CorrespondenceSearch::searchPart(const Look& look,
                                 std::size_t i,
                                 int place,
                                 int candidate,
                                 TwoNearest& best)
{
  const IcpTargetPart& part = target_[place];
  const Eigen::Vector3f q = look.source_in_part[place](source_[i]).cast<float>();
  if (look.reach > 0 && !part.search) {
    if (candidate >= 0) {
      const float own_sq = distanceSq(q, (*part.points)[candidate]);
      const float second = std::sqrt(own_sq) + look.reach;
      best = {{candidate, own_sq}, std::min(best.second_sq, second * second)};
    }
    return part.tree->improveTwo(q, best, candidate) || candidate >= 0;
  }
  const float limit_sq = best.nearest.distance_sq;
  const Neighbour found =
      part.search ? part.search(q, limit_sq)
      : part.memory == SearchMemory::kLeaves
          ? part.tree->nearestFrom(leaves_[place][i], q, limit_sq)
      : candidate >= 0
          ? part.tree->nearest(q, limit_sq, candidate, (*part.points)[candidate])
          : part.tree->nearest(q, limit_sq);
  if (found.index < 0) { // points between nearest and second remain unknown
    best.second_sq = std::min(best.second_sq, limit_sq);
    return false;
  }
  require(found.index < static_cast<int>(part.points->size()),
          "index found by a search",
          found.index,
          "that of a point");
  best = {found, found.distance_sq};
  return true;
}

void
CorrespondenceSearch::setPartner(std::size_t i, int part, int index)
{
  Partner& partner = partners_[i];
  if (index < 0)
    part = -1;
  const bool same = part == partner.part && index == partner.index;
  partner.part = part;
  partner.index = index;
  if (same)
    return;
  if (part >= 0) {
    const IcpTargetPart& from = target_[part];
    const Eigen::Isometry3d& T = from.T_target_part;
    const Eigen::Vector3f& point = (*from.points)[index];
    const bool moved = !is_identity_[part];
    partner.point = moved ? (T * point.cast<double>()).cast<float>() : point;
    if (options_.metric != Metric::kPoint) {
      const Eigen::Vector3f normal = (*from.normals)[index].stableNormalized();
      partner.normal =
          moved ? (T.linear() * normal.cast<double>()).cast<float>() : normal;
    }
  }
  partner.usable = part >= 0 && isUsable(i);
}

bool
CorrespondenceSearch::isUsable(std::size_t i) const
{
  const Partner& partner = partners_[i];
  return partner.point.allFinite() && source_[i].allFinite() &&
         partner.normal.allFinite() &&
         (options_.metric != Metric::kPlane || !partner.normal.isZero(0)) &&
         (!source_normals_ || (*source_normals_)[i].allFinite());
}

void
CorrespondenceSearch::setPairs(const std::vector<IcpPair>& pairs)
{
  for (Partner& partner : partners_)
    partner.weight = 0;
  for (const IcpPair& pair : pairs) {
    require(pair.source >= 0 && pair.source < static_cast<int>(partners_.size()),
            "source of a pair",
            pair.source,
            "in [0, " + std::to_string(partners_.size()) + ")");
    const std::size_t count = target_.front().points->size();
    require(pair.target >= 0 && pair.target < static_cast<int>(count),
            "target of a pair",
            pair.target,
            "in [0, " + std::to_string(count) + ")");
    Partner& partner = partners_[pair.source];
    if (partner.weight > 0 && partner.distance_sq <= pair.distance_sq)
      continue;
    setPartner(pair.source, 0, pair.target);
    partner.distance_sq = pair.distance_sq;
    partner.weight = partner.usable ? 1 : 0;
  }
}

std::vector<IcpPair>
CorrespondenceSearch::pairs() const
{
  std::vector<IcpPair> pairs;
  for (std::size_t i = 0; i < partners_.size(); ++i)
    if (partners_[i].weight > 0)
      pairs.push_back(
          {static_cast<int>(i), partners_[i].index, partners_[i].distance_sq});
  return pairs;
}

std::size_t
CorrespondenceSearch::count() const
{
  return std::count_if(partners_.begin(), partners_.end(), [](const Partner& partner) {
    return partner.weight > 0;
  });
}

CorrespondenceSearch::Searches
CorrespondenceSearch::searches() const
{
  Searches sum;
  for (const Searches& of_block : searches_) {
    sum.all += of_block.all;
    sum.from_leaf += of_block.from_leaf;
  }
  return sum;
}

} // namespace pcl6d::registration
