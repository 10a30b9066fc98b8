// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/pair_moments.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace graph_relaxation;

namespace {
constexpr std::size_t kBlockSize = 4096;
constexpr double kLeastScale = 1e-6; // [m] finer than any scanner: exact copies

/** The pairs of a link in the world, about a place near them. */
class PlacedPairs {
public:
  PlacedPairs(const LinkPairs& pairs,
              const Eigen::Isometry3d& T_world_from,
              const Eigen::Isometry3d& T_world_to)
  : pairs_(pairs)
  , origin_(T_world_from.translation())
  , R_from_(T_world_from.linear())
  , R_to_(T_world_to.linear())
  , t_to_(T_world_to.translation() - origin_)
  {}

  std::size_t
  size() const
  {
    return pairs_.points_from.size();
  }

  const Eigen::Vector3d&
  origin() const
  {
    return origin_;
  }

  /** \return whether the pair counts \param[out] c, Z midpoint about the origin and
   * difference [m] */
  bool
  place(std::size_t k, Eigen::Vector3d& c, Eigen::Vector3d& Z) const
  {
    const Eigen::Vector3d pa = R_from_ * pairs_.points_from[k].cast<double>();
    const Eigen::Vector3d pb = R_to_ * pairs_.points_to[k].cast<double>() + t_to_;
    Z = pa - pb;
    c = 0.5 * (pa + pb);
    const double w = weight(k);
    // A sum of squares is finite only if all terms are.
    return w > 0 && std::isfinite(w) &&
           std::isfinite(c.squaredNorm() + Z.squaredNorm());
  }

  double
  weight(std::size_t k) const
  {
    return pairs_.weights.empty() ? 1 : pairs_.weights[k];
  }

  bool
  hasNorms() const
  {
    return !pairs_.norms.empty();
  }

  const Eigen::Matrix3d&
  norm(std::size_t k) const
  {
    return pairs_.norms[k];
  }

private:
  const LinkPairs& pairs_;
  Eigen::Vector3d origin_;
  Eigen::Matrix3d R_from_, R_to_;
  Eigen::Vector3d t_to_;
};

/** Square root of what each pair costs; negative: the pair does not count. */
std::vector<double>
residualsOf(const PlacedPairs& placed)
{
  std::vector<double> residuals(placed.size(), -1);
  Eigen::Vector3d c, Z;
  for (std::size_t k = 0; k < placed.size(); ++k)
    if (placed.place(k, c, Z)) {
      const double cost =
          placed.hasNorms() ? Z.dot(placed.norm(k) * Z) : Z.squaredNorm();
      residuals[k] = std::sqrt(std::max(0.0, cost));
    }
  return residuals;
}

/** \return the factor of each pair by its residual over the scale of all; empty: 1 */
std::vector<double>
robustFactors(const PlacedPairs& placed, RobustKernel kernel)
{
  if (kernel == RobustKernel::kNone)
    return {};
  std::vector<double> factors = residualsOf(placed);
  std::vector<double> counting;
  for (const double residual : factors)
    if (residual >= 0)
      counting.push_back(residual);
  if (counting.empty())
    return {};
  const auto middle =
      counting.begin() + static_cast<std::ptrdiff_t>(counting.size() / 2);
  std::nth_element(counting.begin(), middle, counting.end());
  const double scale = std::max(1.4826 * *middle, kLeastScale);
  for (double& factor : factors)
    factor = factor < 0 ? 0 : robustWeight(kernel, factor / scale);
  return factors;
}

PairMoments
sumBlock(const PlacedPairs& placed,
         const std::vector<double>& factors,
         std::size_t begin,
         std::size_t end)
{
  PairMoments moments;
  Eigen::Vector3d c, Z;
  for (std::size_t k = begin; k < end; ++k) {
    if (!placed.place(k, c, Z))
      continue;
    const double w = placed.weight(k) * (factors.empty() ? 1 : factors[k]);
    if (!placed.hasNorms())
      moments.add(c, Z, w);
    else if (placed.norm(k).allFinite())
      moments.addNorm(c, Z, w * placed.norm(k));
  }
  return moments;
}

void
requireSizes(const LinkPairs& pairs)
{
  const std::size_t size = pairs.points_from.size();
  require(pairs.points_to.size() == size,
          "points_to.size()",
          pairs.points_to.size(),
          "points_from.size()");
  require(pairs.norms.empty() || pairs.norms.size() == size,
          "norms.size()",
          pairs.norms.size(),
          "0 or points_from.size()");
  require(pairs.weights.empty() || pairs.weights.size() == size,
          "weights.size()",
          pairs.weights.size(),
          "0 or points_from.size()");
}

/** Some pairs of one link, summed by one thread. */
struct Piece {
  std::size_t link, begin, end;
};

std::vector<Piece>
piecesOf(const std::vector<LinkPairs>& links)
{
  std::vector<Piece> pieces;
  for (std::size_t l = 0; l < links.size(); ++l) {
    const std::size_t size = links[l].points_from.size();
    for (std::size_t begin = 0; begin < size; begin += kBlockSize)
      pieces.push_back({l, begin, std::min(begin + kBlockSize, size)});
  }
  return pieces;
}
} // namespace

double
LinkSums::rms() const
{
  return weight > 0 ? std::sqrt(std::max(0.0, residual_sq) / weight) : 0;
}

std::vector<LinkSums>
sumLinks(const std::vector<LinkPairs>& links,
         const std::vector<Eigen::Isometry3d>& poses,
         RobustKernel kernel,
         unsigned int num_threads)
{
  std::vector<PlacedPairs> placed;
  placed.reserve(links.size());
  for (const LinkPairs& link : links) {
    requireSizes(link);
    require(link.from < poses.size(), "link.from", link.from, "a pose");
    require(link.to < poses.size(), "link.to", link.to, "a pose");
    placed.emplace_back(link, poses[link.from], poses[link.to]);
  }
  std::vector<std::vector<double>> factors(links.size());
  if (kernel != RobustKernel::kNone)
    parallelFor(links.size(), num_threads, [&](std::size_t l) {
      factors[l] = robustFactors(placed[l], kernel);
    });
  const std::vector<Piece> pieces = piecesOf(links);
  std::vector<PairMoments> partials(pieces.size());
  parallelFor(pieces.size(), num_threads, [&](std::size_t i) {
    const Piece& piece = pieces[i];
    partials[i] =
        sumBlock(placed[piece.link], factors[piece.link], piece.begin, piece.end);
  });
  std::vector<LinkSums> sums(links.size());
  for (std::size_t i = 0; i < pieces.size();) {
    const std::size_t l = pieces[i].link;
    std::vector<PairMoments> of_link;
    for (; i < pieces.size() && pieces[i].link == l; ++i)
      of_link.push_back(partials[i]);
    sums[l] =
        mergeTree(std::move(of_link), &PairMoments::merge).about(placed[l].origin());
  }
  return sums;
}

LinkSums
sumLink(const LinkPairs& pairs,
        const Eigen::Isometry3d& T_world_from,
        const Eigen::Isometry3d& T_world_to,
        RobustKernel kernel)
{
  LinkPairs here = pairs;
  here.from = 0;
  here.to = 1;
  return sumLinks({here}, {T_world_from, T_world_to}, kernel, 1).front();
}

} // namespace pcl6d
