// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp.h>

#include <pcl/registration/default_convergence_criteria.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Convergence criteria of ICP6D (getConvergeCriteria()): PCL's settings of the end of the
 * iteration, and the state of the last align().
 *
 * getConvergenceState() is the reason of the end: TRANSFORM, ABS_MSE or REL_MSE (at rest),
 * ITERATIONS or FAILURE_AFTER_MAX_ITERATIONS (the limit), NO_CORRESPONDENCES (fewer than 3 pairs),
 * NOT_CONVERGED (diverged, or stopped by the observer). Only hasConverged() and result() of ICP6D
 * tell whether the surfaces fix the final pose.
 *
 * Settings with setters in ICP6D (iterations, thresholds, relative error) show the values of ICP6D;
 * a value set here takes effect from the next align() on (PCL's align() overwrites it). Further
 * settings in force: setAbsoluteMSE() [m^2] (0, off, unless set; PCL: 1e-12),
 * setMaximumIterationsSimilarTransforms() (0 unless set: the first step at rest is the last),
 * setFailureAfterMaximumIterations() (true unless set, which is
 * ICP6D::setIterationLimitConverges(false); PCL: false). \ingroup registration */
template <typename Scalar = float>
class ConvergenceCriteria
: public pcl::registration::DefaultConvergenceCriteria<Scalar> {
public:
  using Base = pcl::registration::DefaultConvergenceCriteria<Scalar>;
  using Ptr = pcl::shared_ptr<ConvergenceCriteria<Scalar>>;
  using ConstPtr = pcl::shared_ptr<const ConvergenceCriteria<Scalar>>;
  using typename Base::Matrix4;

  /** \brief PCL's constructor; the arguments must outlive this object. */
  ConvergenceCriteria(const int& iterations,
                      const Matrix4& transform,
                      const pcl::Correspondences& correspondences);

  /** \return whether the state means convergence. No side effects, unlike PCL's method, which
   * evaluates the last step anew. */
  bool
  hasConverged() override;

  /** \brief Takes over the settings made here since the last run. \return whether a threshold of
   * the motion was set: translationEpsilon() and rotationEpsilon() then apply */
  bool
  takeChanges(int& max_iterations, double& relative_mse) const;
  /** \return [m] */
  double
  translationEpsilon() const;
  /** \return [rad] */
  double
  rotationEpsilon() const;

  /** \brief Shows settings in PCL's units. */
  void
  show(const IcpOptions& options);

  /** \brief Shows the settings of a starting run.
   * \param[in,out] options of the run; their epsilons become 0 where steps at rest are to be
   * counted: convergence is then decided here alone */
  void
  start(IcpOptions& options);

  /** \brief Evaluates an iteration. \return whether it is the last by settings unknown to icp() */
  bool
  endsAt(const IcpIteration& seen);

  /** \brief Sets the state from the outcome of a run, which counts as at rest if ended here.
   * \param[in] ended_here last result of endsAt() */
  void
  finish(IcpResult& result, bool ended_here);

private:
  using State = typename Base::ConvergenceState;

  State
  evaluate(const IcpIteration& seen) const;

  IcpOptions run_;    ///< the options of the run
  int shown_max_ = 0; ///< value written by show()
  double shown_translation_ = 0;
  double shown_rotation_ = 0;
  double shown_relative_ = 0;
  double last_mse_ = -1; ///< [m^2] -1: no iteration yet
  double last_scale_ = 1;
  int similar_ = 0; ///< consecutive steps at rest
  State last_result_ = Base::CONVERGENCE_CRITERIA_NOT_CONVERGED;
};

extern template class ConvergenceCriteria<float>;
extern template class ConvergenceCriteria<double>;

} // namespace pcl6d
