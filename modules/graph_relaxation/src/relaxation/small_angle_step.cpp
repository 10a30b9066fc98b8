// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/relaxation_step.h"

#include <pcl6d/graph_relaxation/block_system.h>

namespace pcl6d::graph_relaxation {

namespace {
/** Terms of a link in the two systems of 5.3.3. */
struct SmallAngleTerms {
  Eigen::Matrix3d aa, bb, ab; ///< of the rotation system
  Eigen::Vector3d turn;       ///< right side of a; negative for b
  Eigen::Vector3d centre_a, centre_b;
  double weight; ///< N
};

Eigen::Matrix3d
turningMatrix(const Eigen::Matrix3d& moments)
{
  return moments.trace() * Eigen::Matrix3d::Identity() - moments;
}

SmallAngleTerms
termsOfPairs(const LinkSums& sums)
{
  // Centred points a = c + z / 2, b = c - z / 2.
  const Eigen::Matrix3d C = sums.cross + sums.cross.transpose();
  const Eigen::Matrix3d D = sums.cross.transpose() - sums.cross;
  const Eigen::Matrix3d S = sums.scatter, Z = 0.25 * sums.spread;
  const Eigen::Matrix3d ab = S + 0.5 * D - Z; // sum a b^T
  return {turningMatrix(S + 0.5 * C + Z),
          turningMatrix(S - 0.5 * C + Z),
          -turningMatrix(ab.transpose()),
          {ab(1, 2) - ab(2, 1), ab(2, 0) - ab(0, 2), ab(0, 1) - ab(1, 0)},
          sums.centre + 0.5 * sums.mean_z,
          sums.centre - 0.5 * sums.mean_z,
          sums.weight};
}

/** The measurement puts b's origin at the centre, with an isotropic weight. */
SmallAngleTerms
termsOfMeasurement(const LinkEquation<6>& equation, const Eigen::Vector3d& b)
{
  const Eigen::Matrix3d K = equation.K.bottomRightCorner<3, 3>();
  return {K,
          K,
          -K,
          -K * equation.D.tail<3>(),
          equation.centre,
          b,
          equation.K.topLeftCorner<3, 3>().trace() / 3};
}

/** \brief Rotations first, then positions. Pose j moves to t_j + s_j and turns by theta_j about
 * t_j. */
class SmallAngleStep : public RelaxationStep {
public:
  bool
  advance(Round& round, double damping) override
  {
    const GraphLayout& layout = round.layout;
    const std::vector<SmallAngleTerms> terms = termsOf(round);
    Systems systems = assemble(round, terms);
    if (!factorize(systems, damping, round.num_threads))
      return false;
    const std::vector<Eigen::Vector3d> theta = systems.turns.solve(systems.turn_rhs);
    std::vector<Eigen::Matrix3d> R(round.poses.size(), Eigen::Matrix3d::Identity());
    for (std::size_t j = 0; j < R.size(); ++j)
      if (layout.unknown[j] != GraphLayout::kFixed)
        R[j] = rotationFromVector(theta[layout.unknown[j]]);
    const std::vector<Eigen::Vector3d> s = solveShifts(round, terms, R, systems.shifts);
    for (std::size_t j = 0; j < R.size(); ++j)
      if (layout.unknown[j] != GraphLayout::kFixed) {
        Eigen::Isometry3d& pose = round.poses[j];
        pose.linear() =
            Eigen::Quaterniond(R[j] * pose.linear()).normalized().toRotationMatrix();
        pose.translation() += s[layout.unknown[j]];
      }
    return true;
  }

  std::vector<Matrix6>
  inverses(const Round& round, double damping) override
  {
    Systems systems = assemble(round, termsOf(round));
    if (!factorize(systems, damping, round.num_threads))
      return {};
    const auto turns = systems.turns.inverseDiagonals();
    const auto shifts = systems.shifts.inverseDiagonals();
    std::vector<Matrix6> blocks(turns.size(), Matrix6::Zero());
    for (std::size_t j = 0; j < blocks.size(); ++j) {
      blocks[j].topLeftCorner<3, 3>().diagonal().setConstant(shifts[j](0, 0));
      blocks[j].bottomRightCorner<3, 3>() = turns[j];
    }
    return blocks;
  }

private:
  struct Systems {
    BlockSystem<3> turns;
    BlockSystem<1> shifts;
    std::vector<Eigen::Vector3d> turn_rhs;
  };

  /** Any pair fixes positions; turns may be open. */
  static bool
  factorize(Systems& systems, double damping, unsigned int num_threads)
  {
    for (std::size_t i = 0; damping > 0 && i < systems.turn_rhs.size(); ++i) {
      auto diagonal = systems.turns.diagonal(i).diagonal();
      const double mean = diagonal.mean();
      diagonal.array() += damping * (mean > 0 ? mean : 1);
    }
    return systems.turns.factorize(0, num_threads) &&
           systems.shifts.factorize(0, num_threads);
  }

  static std::vector<SmallAngleTerms>
  termsOf(const Round& round)
  {
    std::vector<SmallAngleTerms> terms;
    for (const RoundLink& link : round.links)
      terms.push_back(
          link.measured
              ? termsOfMeasurement(link.equation, round.poses[link.to].translation())
              : termsOfPairs(link.sums));
    return terms;
  }

  static Systems
  assemble(const Round& round, const std::vector<SmallAngleTerms>& terms)
  {
    const GraphLayout& layout = round.layout;
    const std::size_t size = layout.num_unknowns;
    Systems systems{{size, layout.couplings},
                    {size, layout.couplings},
                    std::vector<Eigen::Vector3d>(size, Eigen::Vector3d::Zero())};
    systems.turns.setZero();
    systems.shifts.setZero();
    const auto addTo = [&](std::size_t j,
                           const Eigen::Matrix3d& K,
                           double weight,
                           const Eigen::Vector3d& turn) {
      if (j == GraphLayout::kFixed)
        return;
      systems.turns.diagonal(j) += K;
      systems.shifts.diagonal(j)(0, 0) += weight;
      systems.turn_rhs[j] += turn;
    };
    for (std::size_t l = 0; l < terms.size(); ++l) {
      const RoundLink& link = round.links[l];
      const double factor = round.factorOf(link, link.equation.variance);
      const double weight = factor * terms[l].weight;
      const std::size_t a = layout.unknown[link.from], b = layout.unknown[link.to];
      addTo(a, factor * terms[l].aa, weight, factor * terms[l].turn);
      addTo(b, factor * terms[l].bb, weight, -factor * terms[l].turn);
      const std::size_t k = layout.coupling_of_link[l];
      if (k == GraphLayout::kFixed)
        continue;
      const Eigen::Matrix3d K = factor * terms[l].ab;
      if (a < b)
        systems.turns.coupling(k) += K;
      else
        systems.turns.coupling(k) += K.transpose();
      systems.shifts.coupling(k)(0, 0) -= weight;
    }
    return systems;
  }

  static std::vector<Eigen::Vector3d>
  solveShifts(const Round& round,
              const std::vector<SmallAngleTerms>& terms,
              const std::vector<Eigen::Matrix3d>& R,
              const BlockSystem<1>& system)
  {
    using Scalar = BlockSystem<1>::Vector;
    std::vector<Eigen::Vector3d> rhs(round.layout.num_unknowns,
                                     Eigen::Vector3d::Zero());
    for (std::size_t l = 0; l < terms.size(); ++l) {
      const RoundLink& link = round.links[l];
      // Displacement of a point by the turn of its pose.
      const auto turned = [&](std::size_t j, const Eigen::Vector3d& p) {
        const Eigen::Vector3d arm = p - round.poses[j].translation();
        return Eigen::Vector3d(R[j] * arm - arm);
      };
      const SmallAngleTerms& t = terms[l];
      const Eigen::Vector3d gap = t.centre_b - t.centre_a +
                                  turned(link.to, t.centre_b) -
                                  turned(link.from, t.centre_a);
      const double factor = round.factorOf(link, link.equation.variance);
      const Eigen::Vector3d pull = factor * t.weight * gap;
      if (round.layout.unknown[link.from] != GraphLayout::kFixed)
        rhs[round.layout.unknown[link.from]] += pull;
      if (round.layout.unknown[link.to] != GraphLayout::kFixed)
        rhs[round.layout.unknown[link.to]] -= pull;
    }
    std::vector<Eigen::Vector3d> shifts(rhs.size());
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Scalar> side(rhs.size());
      for (std::size_t j = 0; j < rhs.size(); ++j)
        side[j](0) = rhs[j](axis);
      const std::vector<Scalar> solution = system.solve(side);
      for (std::size_t j = 0; j < rhs.size(); ++j)
        shifts[j](axis) = solution[j](0);
    }
    return shifts;
  }
};
} // namespace

std::unique_ptr<RelaxationStep>
makeSmallAngleStep()
{
  return std::make_unique<SmallAngleStep>();
}

} // namespace pcl6d::graph_relaxation
