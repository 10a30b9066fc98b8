// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/placed_pairs.h"

#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/graph_relaxation/link_sums.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr std::size_t kBlockSize = 4096; // pairs
/** [m] Least scale of the residuals: finer than any scanner, for scans that are exact copies. */
constexpr double kLeastScale = 1e-6;

/** Sums over the pairs of a block, about an origin common to all blocks of a link: blocks are merged
 * by addition. A pair has a midpoint c and a difference Z; its norm is a 3x3 weight matrix W, with
 * the cost Z^T W Z. */
struct PairMoments {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  std::size_t count = 0;
  double weight = 0;
  double weight_sq = 0;
  Vector6 first = Vector6::Zero();  ///< sum w (c, Z)
  Matrix6 second = Matrix6::Zero(); ///< sum w (c, Z) (c, Z)^T

  // Only of pairs with norms; without norms these sums follow from the moments.
  bool has_norms = false;
  double trace = 0;    ///< sum tr W
  double trace_sq = 0; ///< sum tr W^2
  LinkSums::Matrix A = LinkSums::Matrix::Zero();
  LinkSums::Vector b = LinkSums::Vector::Zero();
  double residual_sq = 0;

  /** \param[in] c, Z midpoint about the origin and difference of a pair */
  void
  add(const Eigen::Vector3d& c, const Eigen::Vector3d& Z, double w);

  /** Adds a pair with a norm, times its weight. */
  void
  addNorm(const Eigen::Vector3d& c, const Eigen::Vector3d& Z, const Eigen::Matrix3d& W);

  static PairMoments
  merge(const PairMoments& a, const PairMoments& b);

  /** \return the sums about the mean of c */
  LinkSums
  about(const Eigen::Vector3d& origin) const;
};

/** \return [I | c | -[c]x] */
Eigen::Matrix<double, 3, 7>
motionMatrix(const Eigen::Vector3d& c)
{
  Eigen::Matrix<double, 3, 7> M;
  M << Eigen::Matrix3d::Identity(), c, -skew(c);
  return M;
}

/** Fills in A, b and residual_sq of pairs without norms, from the moments. */
void
fillFromMoments(LinkSums& sums)
{
  const double squares = sums.scatter.trace();
  sums.A.topLeftCorner<3, 3>().diagonal().setConstant(sums.weight);
  sums.A(3, 3) = squares;
  sums.A.bottomRightCorner<3, 3>() =
      squares * Eigen::Matrix3d::Identity() - sums.scatter;
  const Eigen::Matrix3d& C = sums.cross;
  sums.b << sums.weight * sums.mean_z, C.trace(), C(1, 2) - C(2, 1), C(2, 0) - C(0, 2),
      C(0, 1) - C(1, 0);
  sums.residual_sq = sums.spread.trace() + sums.weight * sums.mean_z.squaredNorm();
}

void
PairMoments::add(const Eigen::Vector3d& c, const Eigen::Vector3d& Z, double w)
{
  Vector6 p;
  p << c, Z;
  const Vector6 wp = w * p;
  ++count;
  weight += w;
  weight_sq += w * w;
  first += wp;
  second.noalias() += wp * p.transpose();
}

void
PairMoments::addNorm(const Eigen::Vector3d& c,
                     const Eigen::Vector3d& Z,
                     const Eigen::Matrix3d& W)
{
  const double tr = W.trace(), tr_sq = W.squaredNorm();
  if (!(tr > 0))
    return;
  add(c, Z, tr_sq / tr);
  has_norms = true;
  trace += tr;
  trace_sq += tr_sq;
  const Eigen::Matrix<double, 3, 7> M = motionMatrix(c);
  const Eigen::Matrix<double, 3, 7> WM = W * M;
  A.noalias() += M.transpose() * WM;
  b.noalias() += WM.transpose() * Z;
  residual_sq += Z.dot(W * Z);
}

PairMoments
PairMoments::merge(const PairMoments& a, const PairMoments& b)
{
  PairMoments sum = a;
  sum.count += b.count;
  sum.weight += b.weight;
  sum.weight_sq += b.weight_sq;
  sum.first += b.first;
  sum.second += b.second;
  sum.has_norms = a.has_norms || b.has_norms;
  sum.trace += b.trace;
  sum.trace_sq += b.trace_sq;
  sum.A += b.A;
  sum.b += b.b;
  sum.residual_sq += b.residual_sq;
  return sum;
}

LinkSums
PairMoments::about(const Eigen::Vector3d& origin) const
{
  LinkSums sums;
  if (count == 0)
    return sums;
  const Vector6 mean = first / weight;
  const Matrix6 central = second - weight * mean * mean.transpose();
  const Eigen::Vector3d shift = mean.head<3>();
  sums.count = count;
  sums.weight = weight;
  sums.centre = origin + shift;
  sums.mean_z = mean.tail<3>();
  sums.scatter = central.topLeftCorner<3, 3>();
  sums.cross = central.topRightCorner<3, 3>();
  sums.spread = central.bottomRightCorner<3, 3>();
  if (!has_norms) {
    sums.equations = 3 * weight * weight / weight_sq;
    fillFromMoments(sums);
    return sums;
  }
  // M about the mean is M about the origin times L.
  LinkSums::Matrix L = LinkSums::Matrix::Identity();
  L.topRightCorner<3, 4>() = -motionMatrix(shift).rightCols<4>();
  sums.equations = trace * trace / trace_sq;
  sums.A = L.transpose() * A * L;
  sums.b = L.transpose() * b;
  sums.residual_sq = residual_sq;
  return sums;
}

/** Reduces the sums to those of as many pairs as are independent. */
void
thinOut(LinkSums& sums, double redundancy)
{
  const double share = 1 / redundancy;
  sums.weight *= share;
  sums.equations *= share;
  sums.scatter *= share;
  sums.cross *= share;
  sums.spread *= share;
  sums.A *= share;
  sums.b *= share;
  sums.residual_sq *= share;
}

/** Square root of the cost of each pair; negative: the pair does not count. */
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

/** \return the robust weight of each pair, by its residual relative to the scale of all residuals
 * (1.4826 times the median: the standard deviation of normal noise); empty: 1 for all */
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
  require(pairs.redundancy >= 1 && std::isfinite(pairs.redundancy),
          "redundancy",
          pairs.redundancy,
          "finite and >= 1");
}

/** A block of pairs of one link, summed by one thread. */
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

/** For transfer to other processes. */
template <typename Archive>
void
packFields(Archive& archive, LinkSums& sums)
{
  archive(sums.count, sums.weight, sums.equations, sums.centre, sums.mean_z);
  archive(sums.scatter, sums.cross, sums.spread, sums.A, sums.b, sums.residual_sq);
}

double
LinkSums::rms() const
{
  return weight > 0 ? std::sqrt(std::max(0.0, residual_sq) / weight) : 0;
}

std::vector<LinkSums>
sumLinks(const std::vector<LinkPairs>& links,
         const std::vector<Eigen::Isometry3d>& poses,
         RobustKernel kernel,
         unsigned int num_threads,
         WorkSharing* sharing)
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
    if (links[l].redundancy > 1)
      thinOut(sums[l], links[l].redundancy);
  }
  const auto later = [&](std::size_t l) {
    return std::max(links[l].from, links[l].to);
  };
  // Each process has summed its own links; here it gets the sums of the others.
  sharedFor(sharing, num_threads, sums, later, [](std::size_t) {});
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
