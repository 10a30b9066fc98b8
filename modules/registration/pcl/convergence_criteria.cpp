// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/registration/pcl/convergence_criteria.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

template <typename Scalar>
ConvergenceCriteria<Scalar>::ConvergenceCriteria(
    const int& iterations,
    const Matrix4& transform,
    const pcl::Correspondences& correspondences)
: Base(iterations, transform, correspondences)
{
  this->setFailureAfterMaximumIterations(true);
  this->setAbsoluteMSE(0);
  show({});
}

template <typename Scalar>
bool
ConvergenceCriteria<Scalar>::hasConverged()
{
  const State state = this->getConvergenceState();
  return state == Base::CONVERGENCE_CRITERIA_TRANSFORM ||
         state == Base::CONVERGENCE_CRITERIA_ABS_MSE ||
         state == Base::CONVERGENCE_CRITERIA_REL_MSE ||
         state == Base::CONVERGENCE_CRITERIA_ITERATIONS;
}

template <typename Scalar>
bool
ConvergenceCriteria<Scalar>::takeChanges(int& max_iterations,
                                         double& relative_mse) const
{
  if (this->getMaximumIterations() != shown_max_)
    max_iterations = this->getMaximumIterations();
  if (this->getRelativeMSE() != shown_relative_)
    relative_mse = this->getRelativeMSE();
  return this->getTranslationThreshold() != shown_translation_ ||
         this->getRotationThreshold() != shown_rotation_;
}

template <typename Scalar>
double
ConvergenceCriteria<Scalar>::translationEpsilon() const
{
  return std::sqrt(std::max(0.0, this->getTranslationThreshold()));
}

template <typename Scalar>
double
ConvergenceCriteria<Scalar>::rotationEpsilon() const
{
  return portableAcos(std::max(-1.0, std::min(1.0, this->getRotationThreshold())));
}

template <typename Scalar>
void
ConvergenceCriteria<Scalar>::show(const IcpOptions& options)
{
  shown_max_ = options.max_iterations;
  shown_translation_ = options.translation_epsilon * options.translation_epsilon;
  constexpr double kHalfTurn = 3.14159265358979323846;
  shown_rotation_ = portableSinCos(std::min(kHalfTurn, options.rotation_epsilon)).cos;
  shown_relative_ = options.error_epsilon;
  this->setMaximumIterations(shown_max_);
  this->setTranslationThreshold(shown_translation_);
  this->setRotationThreshold(shown_rotation_);
  this->setRelativeMSE(shown_relative_);
}

template <typename Scalar>
void
ConvergenceCriteria<Scalar>::start(IcpOptions& options)
{
  show(options);
  run_ = options;
  this->setConvergenceState(Base::CONVERGENCE_CRITERIA_NOT_CONVERGED);
  last_result_ = Base::CONVERGENCE_CRITERIA_NOT_CONVERGED;
  last_mse_ = -1;
  last_scale_ = 1;
  similar_ = 0;
  if (this->getMaximumIterationsSimilarTransforms() > 0)
    options.translation_epsilon = options.rotation_epsilon = options.error_epsilon = 0;
}

/** PCL's criteria, in PCL's order. */
template <typename Scalar>
typename ConvergenceCriteria<Scalar>::State
ConvergenceCriteria<Scalar>::evaluate(const IcpIteration& seen) const
{
  if (seen.max_distance > run_.max_distance) // the limit still shrinks
    return Base::CONVERGENCE_CRITERIA_NOT_CONVERGED;
  if (seen.translation <= run_.translation_epsilon &&
      seen.rotation <= run_.rotation_epsilon &&
      std::abs(seen.scale / last_scale_ - 1) <= run_.rotation_epsilon)
    return Base::CONVERGENCE_CRITERIA_TRANSFORM;
  const double change = std::abs(seen.rms * seen.rms - last_mse_);
  if (last_mse_ >= 0 && change < this->getAbsoluteMSE())
    return Base::CONVERGENCE_CRITERIA_ABS_MSE;
  if (last_mse_ >= 0 && change < run_.error_epsilon * last_mse_)
    return Base::CONVERGENCE_CRITERIA_REL_MSE;
  return Base::CONVERGENCE_CRITERIA_NOT_CONVERGED;
}

template <typename Scalar>
bool
ConvergenceCriteria<Scalar>::endsAt(const IcpIteration& seen)
{
  last_result_ = evaluate(seen);
  last_mse_ = seen.rms * seen.rms;
  last_scale_ = seen.scale;
  const bool is_similar = last_result_ != Base::CONVERGENCE_CRITERIA_NOT_CONVERGED;
  const bool has_own_rule = this->getMaximumIterationsSimilarTransforms() > 0 ||
                            last_result_ == Base::CONVERGENCE_CRITERIA_ABS_MSE;
  const bool ends = is_similar && has_own_rule &&
                    similar_ >= this->getMaximumIterationsSimilarTransforms();
  similar_ = is_similar ? similar_ + 1 : 0;
  return ends;
}

template <typename Scalar>
void
ConvergenceCriteria<Scalar>::finish(IcpResult& result, bool ended_here)
{
  if (ended_here) {
    result.stop = IcpStop::kAtRest;
    const bool is_open = result.localizability
                             ? result.localizability->openDirections() > 0
                             : !result.covariance;
    result.status = is_open ? Status::kRankDeficient : Status::kOk;
    if (is_open)
      result.covariance.reset();
  }
  State state = Base::CONVERGENCE_CRITERIA_NOT_CONVERGED;
  if (result.stop == IcpStop::kAtRest)
    state = last_result_ == Base::CONVERGENCE_CRITERIA_NOT_CONVERGED
                ? Base::CONVERGENCE_CRITERIA_REL_MSE // the error no longer changes
                : last_result_;
  else if (result.stop == IcpStop::kIterationLimit)
    state = this->getFailureAfterMaximumIterations()
                ? Base::CONVERGENCE_CRITERIA_FAILURE_AFTER_MAX_ITERATIONS
                : Base::CONVERGENCE_CRITERIA_ITERATIONS;
  else if (result.stop == IcpStop::kTooFewPairs)
    state = Base::CONVERGENCE_CRITERIA_NO_CORRESPONDENCES;
  this->setConvergenceState(state);
}

template class ConvergenceCriteria<float>;
template class ConvergenceCriteria<double>;

} // namespace pcl6d
