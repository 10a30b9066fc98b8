// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/block_system.h>
#include <pcl6d/graph_relaxation/control_adjustment.h>
#include <pcl6d/graph_relaxation/link_error.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {
namespace graph_relaxation {

/** \brief A target of a known point in a connected scan. */
struct ControlObservation {
  std::size_t target = 0; ///< index in ControlOptions::targets
  std::size_t point = 0;  ///< index in ControlOptions::points
  std::size_t vertex = 0; ///< index of its scan among the adjusted scans
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< [m] in the scan's frame
  bool is_active = false;                             ///< used as a constraint
};

/** \brief The test of one alternative hypothesis: a control point or a target is wrong. */
struct ControlTest {
  double statistic = 0;  ///< chi2 distributed with `directions` degrees of freedom
  int directions = 0;    ///< number of directions in which an error
                         ///< is detectable; 0: not controlled
  double detectable = 0; ///< [m] detectable error in the worst direction;
                         ///< infinite if a direction is not controlled

  /** \return standard deviations, scaled so that kTestLimit is the limit */
  double
  standardised() const;
};

/** Limit of a standardised residual; beyond, a blunder: 0.1 % of a normal distribution. */
constexpr double kTestLimit = 3.290526731491895;

/** \return the test of a vector against its covariance
 * \param[in] scale reference of the covariance: a direction is controlled above a hundredth of
 * the scale */
ControlTest
testOf(const Eigen::Vector3d& vector, const Eigen::Matrix3d& covariance, double scale);

/** \brief The derivative of T target by a small motion of T from the right: (translation,
 * rotation) in its own axes. */
Eigen::Matrix<double, 3, 6>
targetJacobian(const Eigen::Isometry3d& T, const Eigen::Vector3d& target);

/** \brief Links and control points as one system of normal equations. */
class ControlProblem {
public:
  /** \param[in] map links between the adjusted vertices, connected */
  ControlProblem(PoseGraph map,
                 std::vector<ControlObservation> observations,
                 const ControlOptions& options);

  /** \brief Moves every pose by one motion. */
  void
  move(const Eigen::Isometry3d& T);

  /** \brief Adjusts the poses by least squares, from the last poses.
   * \return false if the active observations do not fix the poses, or the sums overflow */
  bool
  adjust();

  const std::vector<Eigen::Isometry3d>&
  poses() const
  {
    return map_.poses;
  }
  std::vector<ControlObservation>&
  observations()
  {
    return observations_;
  }

  /** \return [m] T target - point */
  Eigen::Vector3d
  residual(std::size_t observation) const;

  /** \brief After adjust(): the test for a common error vector of every active observation of a
   * point.
   * \param[in] only index of a single wrong observation; empty: every observation */
  ControlTest
  test(std::size_t point, std::optional<std::size_t> only) const;

  /** \brief After adjust(): the test of inactive observations, by their mean.
   * \param[in] observations of one point */
  ControlTest
  predict(const std::vector<std::size_t>& observations) const;

  /** \return the weighted square sum of the residuals after adjust(), per degree of freedom */
  double
  varianceFactor() const;

  /** \return the inverse of the normal equations, block by block, after adjust() */
  std::vector<Matrix6>
  covariances() const
  {
    return system_.inverseDiagonals();
  }

  std::vector<std::size_t>
  observationsOf(std::size_t point, bool active) const;

private:
  void
  findStructure();
  void
  build();
  void
  addLinks();
  void
  addPoints();
  void
  addTo(std::size_t a, std::size_t b, const Matrix6& block);
  double
  sigmaOf(std::size_t point) const;
  double
  weightBetween(std::size_t point, std::size_t count, bool same) const;
  void
  findCovariances();
  Eigen::Matrix3d
  poseCovariance(std::size_t k, std::size_t l) const;

  PoseGraph map_;
  std::vector<ControlObservation> observations_;
  const ControlOptions& options_;
  std::vector<std::pair<std::size_t, std::size_t>>
      couplings_; ///< first < second, sorted
  BlockSystem<6> system_;
  std::vector<Vector6> right_side_;
  std::vector<std::size_t>
      column_of_;         ///< of a vertex in dense_, if it has observations
  Eigen::MatrixXd dense_; ///< covariance of the poses with observations
};

} // namespace graph_relaxation
} // namespace pcl6d
