// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp.h>

#include <pcl/registration/default_convergence_criteria.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What ICP6D::getConvergeCriteria() gives out: PCL's settings of the end of the
 * iteration, and the state of the last align().
 *
 * getConvergenceState() says why the iteration ended: TRANSFORM, ABS_MSE or REL_MSE (at rest),
 * ITERATIONS or FAILURE_AFTER_MAX_ITERATIONS (the limit), NO_CORRESPONDENCES (fewer than 3
 * pairs), NOT_CONVERGED (diverged, or the observer said so). Whether the pose that it rests at
 * is fixed by the surfaces, only hasConverged() and result() of ICP6D say.
 *
 * Settings that ICP6D has setters for (iterations, thresholds, relative error) show the values
 * of ICP6D; a value that is set here counts from the next one on (PCL's align()
 * overwrites it). In force beside them: setAbsoluteMSE() [m^2] (0, off, unless set; PCL:
 * 1e-12), setMaximumIterationsSimilarTransforms() (0 unless set: the first step at rest is the
 * last), setFailureAfterMaximumIterations() (true unless set, which is
 * ICP6D::setIterationLimitConverges(false); PCL: false). \ingroup registration */
template <typename Scalar = float>
class ConvergenceCriteria
: public pcl::registration::DefaultConvergenceCriteria<Scalar> {
public:
  using Base = pcl::registration::DefaultConvergenceCriteria<Scalar>;
  using Ptr = pcl::shared_ptr<ConvergenceCriteria<Scalar>>;
  using ConstPtr = pcl::shared_ptr<const ConvergenceCriteria<Scalar>>;
  using typename Base::Matrix4;

  /** \brief PCL's constructor; what it refers to must outlive it. */
  ConvergenceCriteria(const int& iterations,
                      const Matrix4& transform,
                      const pcl::Correspondences& correspondences);

  /** \return whether the state is one of convergence. Unlike PCL's, which judges the last
   * step anew, it changes nothing. */
  bool
  hasConverged() override;

  /** \brief Takes over what was set here since the last run. \return whether a threshold of
   * the motion was, so that translationEpsilon() and rotationEpsilon() count */
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

  /** \brief Shows the settings of a run that starts.
   * \param[in,out] options of the run; their epsilons become 0 where steps at rest are to be
   * counted, so that it is judged here alone */
  void
  start(IcpOptions& options);

  /** \brief Looks at an iteration. \return whether it is the last by what is set here and
   * icp() does not know */
  bool
  endsAt(const IcpIteration& seen);

  /** \brief Sets the state from the outcome of a run, which counts as at rest if it was ended
   * here. \param[in] ended_here what endsAt() said last */
  void
  finish(IcpResult& result, bool ended_here);

private:
  using State = typename Base::ConvergenceState;

  State
  judge(const IcpIteration& seen) const;

  IcpOptions run_;    ///< the options of the run
  int shown_max_ = 0; ///< what show() wrote
  double shown_translation_ = 0;
  double shown_rotation_ = 0;
  double shown_relative_ = 0;
  double last_mse_ = -1; ///< [m^2] -1: none
  double last_scale_ = 1;
  int similar_ = 0; ///< steps at rest, one after the other
  State last_judgement_ = Base::CONVERGENCE_CRITERIA_NOT_CONVERGED;
};

extern template class ConvergenceCriteria<float>;
extern template class ConvergenceCriteria<double>;

} // namespace pcl6d
