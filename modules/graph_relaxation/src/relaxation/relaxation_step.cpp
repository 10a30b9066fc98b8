// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/relaxation_step.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/graph_relaxation/block_system.h>

#include <algorithm>
#include <map>
#include <optional>

namespace pcl6d::graph_relaxation {

namespace {
/** \return per pose the lowest pose of its component */
std::vector<std::size_t>
componentsOf(std::size_t num_poses, const std::vector<RoundLink>& links)
{
  Components components(num_poses);
  for (const RoundLink& link : links)
    components.join(link.from, link.to);
  return components.firsts();
}
} // namespace

GraphLayout::GraphLayout(std::size_t num_poses, const std::vector<RoundLink>& links)
: component(componentsOf(num_poses, links)), unknown(num_poses, kFixed)
{
  for (std::size_t i = 0; i < num_poses; ++i)
    if (component[i] != i)
      unknown[i] = num_unknowns++;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> places;
  for (const RoundLink& link : links) {
    const auto ends = std::minmax(unknown[link.from], unknown[link.to]);
    if (ends.second == kFixed) { // the larger, as kFixed is the largest number
      coupling_of_link.push_back(kFixed);
      continue;
    }
    const auto [entry, is_new] = places.try_emplace(ends, couplings.size());
    if (is_new)
      couplings.push_back(ends);
    coupling_of_link.push_back(entry->second);
  }
}

namespace {
constexpr double kLargestTurn = 1; ///< [rad] of a pose in a round

/** \brief The coupled system of every unknown (5.2.2): symmetric, a block per pose and per pair
 * of linked poses.
 * \tparam Size of the motion of a pose */
template <int Size>
class CoupledStep : public RelaxationStep {
public:
  using Matrix = Eigen::Matrix<double, Size, Size>;
  using Vector = Eigen::Matrix<double, Size, 1>;
  using Move = Eigen::Isometry3d (*)(const Eigen::Isometry3d&, const Vector&);

  explicit CoupledStep(Move move) : move_(move) {}

  bool
  advance(Round& round, double damping) override
  {
    assemble(round);
    damp(damping);
    if (!system_->factorize(0, round.num_threads))
      return false;
    std::vector<Vector> X = system_->solve(rhs_);
    limitTurns(X);
    for (std::size_t j = 0; j < round.poses.size(); ++j)
      if (round.layout.unknown[j] != GraphLayout::kFixed)
        round.poses[j] = move_(round.poses[j], X[round.layout.unknown[j]]);
    return true;
  }

  std::vector<Matrix6>
  inverses(const Round& round, double damping) override
  {
    assemble(round);
    damp(damping);
    if (!system_->factorize(0, round.num_threads))
      return {};
    std::vector<Matrix6> blocks;
    for (const Matrix& block : system_->inverseDiagonals())
      blocks.push_back(withoutScale(block));
    return blocks;
  }

private:
  /** A link's blocks, for the twists of its two poses about their positions. */
  struct Terms {
    Matrix aa, bb, ab;
    Vector a, b;
  };

  static Matrix6
  withoutScale(const Matrix& block)
  {
    Matrix6 rigid;
    rigid << block.template topLeftCorner<3, 3>(),
        block.template topRightCorner<3, 3>(), block.template bottomLeftCorner<3, 3>(),
        block.template bottomRightCorner<3, 3>();
    return rigid;
  }

  static LinkEquation<Size>
  equationOfLink(const Round& round, const RoundLink& link)
  {
    if constexpr (Size == 6)
      return link.equation;
    else if (link.measured)
      return equationOf<Size>(
          *link.measured, round.poses[link.from], round.poses[link.to]);
    else
      return equationOf<Size>(link.sums, round.least_variance);
  }

  static Terms
  termsOf(const Round& round, const RoundLink& link)
  {
    const LinkEquation<Size> equation = equationOfLink(round, link);
    const auto shift = [&](std::size_t pose) {
      return originShift<Size>(round.poses[pose].translation(), equation.centre);
    };
    const Matrix Sa = shift(link.from), Sb = shift(link.to);
    const double factor = round.factorOf(link, equation.variance);
    const Matrix K = factor * equation.K;
    const Vector g = factor * equation.g;
    const Matrix KSa = K * Sa, KSb = K * Sb;
    return {Sa.transpose() * KSa,
            Sb.transpose() * KSb,
            -Sa.transpose() * KSb,
            Sa.transpose() * g,
            -Sb.transpose() * g};
  }

  /** Makes room for the system, unless its structure is unchanged. */
  void
  prepare(const GraphLayout& layout)
  {
    if (!system_ || couplings_ != layout.couplings ||
        rhs_.size() != layout.num_unknowns) {
      system_.emplace(layout.num_unknowns, layout.couplings);
      couplings_ = layout.couplings;
    }
    system_->setZero();
    rhs_.assign(layout.num_unknowns, Vector::Zero());
  }

  void
  assemble(const Round& round)
  {
    const GraphLayout& layout = round.layout;
    prepare(layout);
    std::vector<Terms> terms(round.links.size());
    parallelBlocks(terms.size(), 64, round.num_threads, [&](const Block& block) {
      for (std::size_t l = block.begin; l < block.end; ++l)
        terms[l] = termsOf(round, round.links[l]);
    });
    for (std::size_t l = 0; l < terms.size(); ++l) {
      const std::size_t a = layout.unknown[round.links[l].from];
      const std::size_t b = layout.unknown[round.links[l].to];
      if (a != GraphLayout::kFixed) {
        system_->diagonal(a) += terms[l].aa;
        rhs_[a] += terms[l].a;
      }
      if (b != GraphLayout::kFixed) {
        system_->diagonal(b) += terms[l].bb;
        rhs_[b] += terms[l].b;
      }
      if (layout.coupling_of_link[l] != GraphLayout::kFixed) {
        if (a < b)
          system_->coupling(layout.coupling_of_link[l]) += terms[l].ab;
        else
          system_->coupling(layout.coupling_of_link[l]) += terms[l].ab.transpose();
      }
    }
  }

  /** Shortens a solution with a turn beyond a radian as a whole: linearisation is invalid there. */
  static void
  limitTurns(std::vector<Vector>& X)
  {
    double largest = 0;
    for (const Vector& x : X)
      largest = std::max(largest, x.template tail<3>().norm());
    if (largest > kLargestTurn)
      for (Vector& x : X)
        x *= kLargestTurn / largest;
  }

  /** Adds to the diagonal of each block a share of its mean, not of each entry: the entry of an
   * open direction may be zero. */
  void
  damp(double share)
  {
    if (share == 0)
      return;
    const auto meanOf = [](const auto& diagonal) {
      const double mean = diagonal.mean();
      return mean > 0 ? mean : 1;
    };
    for (std::size_t i = 0; i < rhs_.size(); ++i) {
      auto diagonal = system_->diagonal(i).diagonal();
      diagonal.template head<3>().array() +=
          share * meanOf(diagonal.template head<3>());
      diagonal.template tail<Size - 3>().array() +=
          share * meanOf(diagonal.template tail<Size - 3>());
    }
  }

  Move move_;
  std::optional<BlockSystem<Size>> system_;
  std::vector<std::pair<std::size_t, std::size_t>> couplings_;
  std::vector<Vector> rhs_;
};
} // namespace

std::unique_ptr<RelaxationStep>
makeRelaxationStep(Relaxation relaxation)
{
  switch (relaxation) {
  case Relaxation::kEuler:
    return std::make_unique<CoupledStep<6>>(&moveByEuler);
  case Relaxation::kQuaternion:
    return std::make_unique<CoupledStep<6>>(&moveByQuaternion);
  case Relaxation::kQuaternionPublished:
    return std::make_unique<CoupledStep<7>>(&moveByScaledQuaternion);
  case Relaxation::kSmallAngle:
    return makeSmallAngleStep();
  case Relaxation::kHelix:
    break;
  }
  return std::make_unique<CoupledStep<6>>(&moveByHelix);
}

} // namespace pcl6d::graph_relaxation
