// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/registration/linear_minimiser.h>
#include <pcl6d/registration/twist.h>

#include <cmath>
#include <limits>

namespace pcl6d {

namespace {
constexpr int kMaxSteps = 20;
constexpr double kAtRest = 1e-12;  ///< [rad]
constexpr double kLargestTurn = 1; ///< [rad] of a step
constexpr double kGimbalCosine = 1e-3;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/** The state of the pairs after a number of steps, and the solution of the next step. */
struct LinearState {
  const PairSums& sums;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity(); ///< source to target so far
  EulerAngles angles = {};                             ///< of T; used by Euler alone
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();      ///< x [rad]
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     ///< xb, about the centroid [m]

  /** \return where T takes the source's centroid */
  Eigen::Vector3d
  centroid() const
  {
    return T * sums.mean_source;
  }
};

/** The finite motion of a method from a solution: applies turn and shift to T. */
using Retraction = void (*)(LinearState&);

void
setRotation(LinearState& state, const Eigen::Matrix3d& R)
{
  state.T.linear() = R;
  state.T.translation() = state.sums.mean_target - R * state.sums.mean_source;
}

/** \return the normalised product of (w, turn / 2) and R */
Eigen::Matrix3d
turned(const Eigen::Matrix3d& R, double w, const Eigen::Vector3d& turn)
{
  const Eigen::Quaterniond small(w, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z());
  return (small * Eigen::Quaterniond(R)).normalized().toRotationMatrix();
}

/** \return R without the accumulated rounding of products of rotations */
Eigen::Matrix3d
normalised(const Eigen::Matrix3d& R)
{
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

void
retractHelix(LinearState& state)
{
  Twist twist;
  twist << state.shift, state.turn;
  const Eigen::Vector3d from = state.centroid();
  const Eigen::Isometry3d helix = motionFromTwist(twist);
  // About the centroid, moved by the helix's translation part.
  const Eigen::Matrix3d R = normalised(helix.linear() * state.T.linear());
  state.T.linear() = R;
  state.T.translation() = from + helix.translation() - R * state.sums.mean_source;
}

void
retractSmallAngle(LinearState& state)
{
  const EulerAngles small{state.turn.x(), state.turn.y(), state.turn.z()};
  setRotation(state, normalised(rotationFromEuler(small) * state.T.linear()));
}

void
retractEuler(LinearState& state)
{
  const Eigen::Matrix3d J = eulerRates(state.angles);
  if (std::abs(J.determinant()) < kGimbalCosine) {
    retractHelix(state);
    state.angles = eulerFromRotation(state.T.linear());
    return;
  }
  const Eigen::Vector3d change = J.inverse() * state.turn;
  state.angles.roll = wrapAngle(state.angles.roll + change.x());
  state.angles.pitch = wrapAngle(state.angles.pitch + change.y());
  state.angles.yaw = wrapAngle(state.angles.yaw + change.z());
  setRotation(state, rotationFromEuler(state.angles));
}

void
retractQuaternion(LinearState& state)
{
  setRotation(state, turned(state.T.linear(), 1, state.turn));
}

/** The seventh unknown, the relative change of scale s, has a solution of its own: 1 + s is the
 * best scale. Normalising drops s from the rotation, but the position, moved by the published
 * rule, keeps s. The arm reaches from the pose's position to the centroid. */
void
retractQuaternionUnconstrained(LinearState& state)
{
  const PairSums& sums = state.sums;
  const Eigen::Matrix3d R = state.T.linear();
  const Eigen::Vector3d arm = R * sums.mean_source;
  const double s = (R * sums.cross).trace() / sums.sourceSq() - 1;
  state.T.linear() = turned(R, 1 + 0.5 * s, state.turn);
  state.T.translation() = sums.mean_target - (1 + s) * arm - state.turn.cross(arm);
}

/** A symmetric 3x3 system, solved with the sizes of its eigenvalues: a Newton step goes uphill from
 * a maximum or saddle, this step downhill. */
class TurnSolver {
public:
  explicit TurnSolver(const Eigen::Matrix3d& symmetric)
  : eigen_(symmetricEigen(symmetric)), sizes_(eigen_.values.cwiseAbs())
  {
    sizes_ = sizes_.cwiseMax(kEpsilon * sizes_.maxCoeff()).eval();
  }

  double
  lowest() const
  {
    return eigen_.values(0);
  }

  /** \return at most 1 / epsilon */
  double
  condition() const
  {
    return sizes_.maxCoeff() / sizes_.minCoeff();
  }

  Eigen::Vector3d
  solve(const Eigen::Vector3d& rhs) const
  {
    const Eigen::Matrix3d& V = eigen_.vectors;
    return V * (V.transpose() * rhs).cwiseQuotient(sizes_);
  }

private:
  SymmetricEigen<3> eigen_;
  Eigen::Vector3d sizes_;
};

/** trace(A) I - (A + A^T) / 2: from a sum of products of coordinates to the matrix of
 * the turn. */
Eigen::Matrix3d
turningMatrix(const Eigen::Matrix3d& A)
{
  return A.trace() * Eigen::Matrix3d::Identity() - 0.5 * (A + A.transpose());
}

/** Solves for the next small motion. \return whether the pairs are at rest: without a further turn,
 * and not at a stationary half turn other than the minimum */
bool
solveStep(LinearState& state, bool first)
{
  const PairSums& sums = state.sums;
  const Eigen::Matrix3d R = state.T.linear();
  const Eigen::Matrix3d A = R * sums.cross;
  const Eigen::Vector3d gradient( // sum w p' x m'
      A(1, 2) - A(2, 1),
      A(2, 0) - A(0, 2),
      A(0, 1) - A(1, 0));
  const TurnSolver linear(turningMatrix(R * sums.scatter * R.transpose()));
  const TurnSolver exact(turningMatrix(A)); // the second derivative
  state.turn = linear.solve(gradient);
  state.shift = sums.mean_target - state.centroid();
  const bool at_rest =
      exact.lowest() > 0 &&
      state.turn.norm() <= kAtRest + 16 * kEpsilon * linear.condition();
  if (!first)
    state.turn = exact.solve(gradient);
  if (state.turn.norm() > kLargestTurn)
    state.turn *= kLargestTurn / state.turn.norm();
  return at_rest;
}

/** Alignment of the turned source with the target; largest at the minimum. */
double
alignment(const LinearState& state)
{
  return (state.T.linear() * state.sums.cross).trace();
}

/** Takes the step, or the first halving that does not turn away from the goal. */
void
advance(LinearState& state, Retraction retract)
{
  const LinearState before = state;
  const double size = std::sqrt(state.sums.sourceSq() * state.sums.target_sq);
  const double least = alignment(before) - 1e-12 * size;
  retract(state);
  for (double part = 0.5; alignment(state) < least && part > 1e-3; part *= 0.5) {
    state.T = before.T;
    state.angles = before.angles;
    state.turn = part * before.turn;
    retract(state);
  }
}

RigidEstimate
step(const PairSums& sums, Retraction retract)
{
  if (const auto degenerate = degenerateEstimate(sums))
    return *degenerate;
  LinearState state{sums};
  solveStep(state, true);
  retract(state);
  return {Status::kOk, state.T};
}

RigidEstimate
minimise(const PairSums& sums, Retraction retract)
{
  if (const auto degenerate = degenerateEstimate(sums))
    return *degenerate;
  LinearState state{sums};
  for (int i = 0; i < kMaxSteps; ++i) {
    const bool at_rest = solveStep(state, i == 0);
    advance(state, retract);
    if (at_rest)
      return {Status::kOk, state.T};
  }
  return {Status::kMaxIterations, state.T};
}
} // namespace

RigidEstimate
stepByHelix(const PairSums& sums)
{
  return step(sums, &retractHelix);
}

RigidEstimate
minimiseByHelix(const PairSums& sums)
{
  return minimise(sums, &retractHelix);
}

RigidEstimate
stepBySmallAngle(const PairSums& sums)
{
  return step(sums, &retractSmallAngle);
}

RigidEstimate
minimiseBySmallAngle(const PairSums& sums)
{
  return minimise(sums, &retractSmallAngle);
}

RigidEstimate
stepByEuler(const PairSums& sums)
{
  return step(sums, &retractEuler);
}

RigidEstimate
minimiseByEuler(const PairSums& sums)
{
  return minimise(sums, &retractEuler);
}

RigidEstimate
stepByQuaternionLinear(const PairSums& sums)
{
  return step(sums, &retractQuaternion);
}

RigidEstimate
minimiseByQuaternionLinear(const PairSums& sums)
{
  return minimise(sums, &retractQuaternion);
}

RigidEstimate
stepByQuaternionUnconstrained(const PairSums& sums)
{
  return step(sums, &retractQuaternionUnconstrained);
}

RigidEstimate
minimiseByQuaternionUnconstrained(const PairSums& sums)
{
  return minimise(sums, &retractQuaternionUnconstrained);
}

} // namespace pcl6d
