// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl6d::graph_relaxation {

namespace {
constexpr double kFirstDamping = 1e-8; ///< small: Marquardt's scaling is cautious
constexpr double kLargestDamping = 1e12;
constexpr double kNegligibleDamping = 1e-9; ///< below, the step length
                                            ///< shows convergence
constexpr double kRounding = 1e-20;         ///< squared error by rounding alone
constexpr double kRoundingShare = 1e-6;     ///< of the cost: larger
                                            ///< predicted decreases are real
constexpr double kDampingFactor = 10;
constexpr double kNarrowing =
    1.4; ///< of the squared width per stage (Yang et al. 2020)

/** The state of a search. */
class Descent {
public:
  Descent(PoseGraphProblem& problem,
          const PoseGraphProblem::Poses& poses,
          const PoseGraphOptions& options)
  : problem_(problem), options_(options)
  {
    result_.poses = poses;
    result_.squared_errors = problem.squaredErrors(poses);
    result_.chi2_before = chi2();
    robust_.kernel = options.graduated ? RobustKernel::kGemanMcClure : options.robust;
    robust_.width_sq = options.robust_width * options.robust_width;
    damping_ = options.method == GraphMethod::kLevenbergMarquardt ? kFirstDamping : 0;
  }

  GraphDescent
  run()
  {
    if (!std::isfinite(result_.chi2_before))
      result_.status = Status::kDiverged; // overflow by large information
    else if (problem_.numPoses() > 1) {
      if (options_.graduated)
        narrow();
      result_.status = minimise() ? Status::kOk : Status::kMaxIterations;
      const bool may_be_free =
          is_singular_ || options_.method == GraphMethod::kLevenbergMarquardt;
      if (may_be_free && result_.status == Status::kOk && isFree())
        result_.status = Status::kRankDeficient;
    }
    result_.chi2_after = chi2();
    result_.weights = problem_.weights(result_.squared_errors, robust_);
    return std::move(result_);
  }

private:
  double
  chi2() const
  {
    return std::accumulate(
        result_.squared_errors.begin(), result_.squared_errors.end(), 0.0);
  }

  /** One step per width, from a width at which every link counts down to the wanted width. */
  void
  narrow()
  {
    const double wanted = robust_.width_sq;
    const double largest =
        *std::max_element(result_.squared_errors.begin(), result_.squared_errors.end());
    for (robust_.width_sq = 2 * largest; robust_.width_sq > wanted;
         robust_.width_sq /= kNarrowing) {
      if (result_.iterations >= options_.max_iterations)
        break;
      step();
    }
    robust_.width_sq = wanted;
  }

  /** \return whether the minimum was reached */
  bool
  minimise()
  {
    is_stuck_ = false;
    while (result_.iterations < options_.max_iterations && !is_stuck_)
      if (step())
        return true;
    return false;
  }

  /** \brief Takes a step that lowers the cost, if possible.
   * \return whether the minimum was reached */
  bool
  step()
  {
    linearize();
    const double before = problem_.cost(result_.squared_errors, robust_);
    if (before <= kRounding * static_cast<double>(result_.squared_errors.size()))
      return true;
    double promised = 0; ///< by the least damped, longest step
    while (result_.iterations < options_.max_iterations) {
      ++result_.iterations;
      double expected = 0;
      const bool is_lower = tryStep(before, expected);
      promised = std::max(promised, expected);
      const bool is_last =
          damping_ <= kNegligibleDamping && expected <= options_.chi2_epsilon * before;
      if (is_lower)
        relaxDamping();
      if (is_lower || is_last)
        return is_last;
      growDamping();
      if (damping_ > kLargestDamping) {
        // Not even the smallest step lowers the cost: rounding, or no way to the minimum.
        is_stuck_ = promised > kRoundingShare * before;
        return !is_stuck_;
      }
    }
    return false;
  }

  void
  linearize()
  {
    problem_.linearize(result_.poses,
                       problem_.weights(result_.squared_errors, robust_));
    if (is_singular_)
      problem_.addRidge();
  }

  /** Links that leave a motion free make the undamped system singular: a ridge, weak beside the
   * links, then fixes the motion. */
  bool
  solve(std::vector<Vector6>& step)
  {
    if (problem_.solve(damping_, step))
      return true;
    if (damping_ > 0 || is_singular_)
      return false;
    is_singular_ = true;
    problem_.addRidge();
    return problem_.solve(damping_, step);
  }

  /** \return whether the links leave a motion free at the end */
  bool
  isFree()
  {
    is_singular_ = false;
    linearize();
    return !problem_.system().factorize(0, options_.num_threads);
  }

  /** \param[out] expected decrease of a quadratic cost
   * \return whether a step lowers the cost; the step is then taken */
  bool
  tryStep(double before, double& expected)
  {
    std::vector<Vector6> step;
    expected = before;
    if (!solve(step))
      return false;
    expected = problem_.expectedDecrease(step);
    PoseGraphProblem::Poses poses = result_.poses;
    for (std::size_t i = 0; i < step.size(); ++i)
      poses[i + 1] = poses[i + 1].moved(step[i]);
    std::vector<double> squares = problem_.squaredErrors(poses);
    if (!(problem_.cost(squares, robust_) <= before)) // true for NaN
      return false;
    result_.poses = std::move(poses);
    result_.squared_errors = std::move(squares);
    return true;
  }

  void
  relaxDamping()
  {
    growth_ = kDampingFactor;
    damping_ = damping_ > kNegligibleDamping ? damping_ / kDampingFactor : 0;
  }

  /** Increasingly fast, as the right damping may be far. */
  void
  growDamping()
  {
    damping_ = std::max(kNegligibleDamping, damping_) * growth_;
    growth_ *= kDampingFactor;
  }

  PoseGraphProblem& problem_;
  const PoseGraphOptions& options_;
  RobustCost robust_;
  GraphDescent result_;
  double damping_ = 0;
  double growth_ = kDampingFactor; ///< of the damping at the next failure
  bool is_singular_ = false;
  bool is_stuck_ = false; ///< steps promise to lower the cost, and do not
};
} // namespace

GraphDescent
descend(PoseGraphProblem& problem,
        const PoseGraphProblem::Poses& poses,
        const PoseGraphOptions& options)
{
  return Descent(problem, poses, options).run();
}

} // namespace pcl6d::graph_relaxation
