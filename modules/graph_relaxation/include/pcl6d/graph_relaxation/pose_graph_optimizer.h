// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/common/status.h>
#include <pcl6d/registration/icp_options.h>

#include <memory>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How steps are found. */
enum class GraphMethod {
  kGaussNewton,       ///< full steps; damped only after a failed step
  kLevenbergMarquardt ///< damped from the start
};

/** \return gauss-newton, levenberg-marquardt */
std::vector<std::string>
graphMethodNames();
/** \throws BadArgument an unknown name; the message lists the valid names */
GraphMethod
graphMethodFromName(const std::string& name);
const char*
toString(GraphMethod method);

/** \brief Knobs of PoseGraphOptimizer. */
struct PoseGraphOptions {
  GraphMethod method = GraphMethod::kGaussNewton;
  /** The weight of a link by its error r = sqrt(e^T information e). */
  RobustKernel robust = RobustKernel::kNone;
  /** The r at which a kernel sets in, > 0. A measurement with a correct covariance exceeds 4.1
   * in 1 of 100 cases (chi2 distribution of 6 degrees of freedom). */
  double robust_width = 4.1;
  /** Graduated non-convexity with the kernel of Geman and McClure, whatever `robust`: starts so
   * wide that every link counts, and narrows to robust_width, which switches wrong links off.
   * Not proven optimal: where few links contradict a wrong link, right links of the chain may
   * be switched off instead, unless trust_chain is set. */
  bool graduated = false;
  /** Links between neighbours (odometry) always count fully: poses with the ids i and
   * i + 1, whatever their order in the graph. */
  bool trust_chain = false;
  int max_iterations = 100;   ///< tried steps of a component; > 0
  double chi2_epsilon = 1e-8; ///< stop when a step lowers the cost by no larger share;
                              ///< in [0, 1)
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A connected part of a graph. */
struct GraphComponent {
  std::size_t fixed_pose = 0; ///< its first pose, not moved
  std::size_t num_poses = 0;
  std::size_t num_links = 0; ///< that carry information
  double chi2_before = 0;
  double chi2_after = 0;
  int iterations = 0; ///< tried steps
  Status status = Status::kOk;
};

/** \brief Result of PoseGraphOptimizer. */
struct PoseGraphResult {
  /** The worst of the components. Of each, the first that applies. kDiverged: not finite; its
   * poses are the input. kMaxIterations: the minimum was not reached, because of the limit or
   * because no step lowers the cost although the derivatives predict a decrease.
   * kRankDeficient: the minimum was reached, but the links leave some motion free, which is
   * unchanged. kOk. The order of GraphSlamResult. */
  Status status = Status::kOk;
  std::vector<Eigen::Isometry3d> poses; ///< T_world_vertex [m]
  double chi2_before = 0;               ///< e^T information e over every link
  double chi2_after = 0;
  int iterations = 0;                     ///< the most of any component
  std::vector<std::size_t> component;     ///< of each pose
  std::vector<GraphComponent> components; ///< in the order of their first poses
  std::vector<double> weights;            ///< of each link: 1, or reduced by the kernel
};

/** \brief Optimises the poses of a pose graph.
 *
 * Minimises the sum over the links of rho(e^T information e) with e = (t, 2 vec(q)) of
 * T_from_to^-1 T_a^-1 T_b and a robust kernel rho. Each connected component is a separate
 * problem with its first pose fixed; links without any information connect no poses. Parallel
 * links between two poses, in either direction, are merged before solving (mergeLinks()), so
 * that a robust kernel sees one link; chi2 is over the given links. Information is made positive
 * semidefinite to the last digit (semidefinite()). Bit-identical for any number of threads.
 *
 * \code
 * pcl6d::PoseGraphOptimizer optimizer(pcl6d::readPoseGraph("garage.g2o"));
 * const pcl6d::PoseGraphResult& result = optimizer.optimize();
 * \endcode
 *
 * \note Sources: G. Grisetti, R. Kuemmerle, C. Stachniss, W. Burgard, "A tutorial on
 * graph-based SLAM", IEEE ITS Magazine 2(4), 2010; H. Yang, P. Antonante, V. Tzoumas, L.
 * Carlone, "Graduated non-convexity for robust spatial perception", RA-L 5(2), 2020.
 * \ingroup graph_relaxation */
class PoseGraphOptimizer {
public:
  /** \throws BadArgument the graph (see checkPoseGraph()) or an option breaks a rule */
  explicit PoseGraphOptimizer(PoseGraph graph, const PoseGraphOptions& options = {});
  ~PoseGraphOptimizer();
  PoseGraphOptimizer(PoseGraphOptimizer&&) noexcept;
  PoseGraphOptimizer&
  operator=(PoseGraphOptimizer&&) noexcept;

  /** \brief Optimises from the poses of the last result, at first from the graph. */
  const PoseGraphResult&
  optimize();

  /** \return the result; before optimize() the poses of the graph */
  const PoseGraphResult&
  result() const;

  /** \return the covariance of each pose relative to the fixed pose of its component, for small
   * motions (translation [m], rotation [rad]) in its own axes; zero for fixed poses
   * \throws ComputeFailed the links leave a motion free */
  std::vector<Eigen::Matrix<double, 6, 6>>
  marginalCovariances() const;

  /** \return the covariance of the relative pose T_a^-1 T_b, for small motions in the axes of b
   * \throws BadArgument an index out of range, or a and b are not connected
   * \throws ComputeFailed the links leave a motion free */
  Eigen::Matrix<double, 6, 6>
  relativeCovariance(std::size_t a, std::size_t b) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace pcl6d
