// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/common/status.h>
#include <pcl6d/graph_relaxation/link_sums.h>
#include <pcl6d/graph_relaxation/parameterisations.h>

#include <functional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief Relative weights of the links. */
enum class LinkWeights {
  kUnit,      ///< equal weights per link, whatever the number of pairs
  kPairs,     ///< equal weights per pair: minimises the plain sum of squares
  kCovariance ///< by the covariance of each link: s^2 (M^T M)^-1 of its
              ///< pairs, s^2 their variance (Lu and Milios; book 5.2.2)
};

/** \return unit, pairs, covariance */
std::vector<std::string>
linkWeightsNames();
/** \throws BadArgument an unknown name; the message lists the valid names */
LinkWeights
linkWeightsFromName(const std::string& name);
const char*
toString(LinkWeights weights);

/** \brief Knobs of GraphSlam. */
struct GraphSlamOptions {
  Relaxation relaxation = Relaxation::kHelix;
  LinkWeights weights = LinkWeights::kCovariance;
  RobustKernel robust = RobustKernel::kNone; ///< of the pairs within their link
  /** Links that contradict the rest lose their weight (Geman-McClure, with graduated
   * non-convexity), so that a wrong link does not bend the map, whatever its number of pairs.
   * Until wrong links are identified, every link has equal weight. Needs a graph in which the
   * true links confirm each other: a single cycle cannot identify a wrong link. */
  bool switch_links = false;
  double switch_scale = 0;           ///< [m] a link whose pairs ask for this much more
                                     ///< motion of its points counts a quarter, up to
                                     ///< 0.67 of it fully; 0: from the links, three
                                     ///< times their robust standard deviation; >= 0
  std::size_t min_pairs = 20;        ///< links with fewer are dropped; >= 3
  double least_deviation = 1e-3;     ///< [m] lower bound of s of a link,
                                     ///< and of switch_scale: links with
                                     ///< smaller residuals are true; > 0
  int max_iterations = 50;           ///< > 0
  double translation_epsilon = 1e-3; ///< [m] stop when no pose moved more ...
  double rotation_epsilon = 1e-4;    ///< [rad] ... nor turned more; >= 0
  double error_epsilon = 1e-6;  ///< stop, too, when the mean squared error of the pairs
                                ///< changes by a smaller share; >= 0, 0: off
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** shares the work between processes; null: one process. Each process has the pairs of the
   * links whose later scan is its own, as ScanNetwork finds them */
  WorkSharing* sharing = nullptr;
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Result of a link of pairs. */
struct LinkReport {
  std::size_t from = 0;
  std::size_t to = 0;
  std::size_t pairs = 0;    ///< finite pairs with a weight
  bool used = false;        ///< false: fewer than min_pairs
  double rms = 0;           ///< [m] of the pairs at the final poses
  double switch_weight = 1; ///< in [0, 1]; near 0: contradicts the other links
  int open_directions = 0;  ///< motions left open by its pairs, without information
                            ///< (a corridor 1, one plane with norms 3, a line 1)
  double variance = 0;      ///< s^2 of the pairs [m^2], with the guard
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m] mean of its
                                                    ///< points, in the world
  Twist correction = Twist::Zero(); ///< X_a - X_b demanded by the pairs, about centre
  /** inverse covariance of correction, MM / s^2; zero in open directions */
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
};

/** \return the link as a measured relative pose, for a pose graph
 * \param[in] poses of the result */
PoseLink
poseLinkOf(const LinkReport& link, const std::vector<Eigen::Isometry3d>& poses);

/** \brief Result of GraphSlam. */
struct GraphSlamResult {
  /** The first that applies. kDiverged: the error grew tenfold or is not finite, input poses.
   * kTooFewPairs: no link is left, input poses. kMaxIterations: the stop rule was not met.
   * kRankDeficient: converged, but the graph is disconnected or open directions remain, which
   * were not changed. kOk. The order of PoseGraphResult. */
  Status status = Status::kTooFewPairs;
  std::vector<Eigen::Isometry3d> poses; ///< T_world_scan
  int iterations = 0;                   ///< rounds
  bool converged = false;               ///< the stop rule was met, whatever the status
  double rms_before = 0;                ///< [m] over the pairs of the first round
  /** [m] over the final pairs; with switch_links, links weighted by their agreement with the
   * rest: a quarter at the scale, 1 for a zero residual */
  double rms = 0;
  /** per pose: number of its component, the index of the first pose in the component. The first
   * pose stays fixed; components without pose 0 float */
  std::vector<std::size_t> component;
  std::vector<LinkReport> links;    ///< of the last round, in the order given
  std::vector<bool> open_direction; ///< per pose: some motion relative
                                    ///< to pose 0 is not determined
  /** per pose: covariance of the twist about its position in the world axes, translation [m],
   * then rotation [rad]; zero for pose 0, which is fixed, and for the poses of floating():
   * unknown there, as open_direction tells. See eulerCovariance(). Optimistic: pairs count as
   * independent, but closest points are not. */
  std::vector<Eigen::Matrix<double, 6, 6>> covariances;

  /** \return the poses disconnected from pose 0 */
  std::vector<std::size_t>
  floating() const;
};

/** \brief A round of GraphSlam, reported to the observer. */
struct GraphSlamRound {
  int iteration = 0; ///< from 1
  double rms = 0;    ///< [m] before the round
  double moved = 0;  ///< [m] longest motion of a pose
  double turned = 0; ///< [rad] largest turn of a pose
};

/** \brief Moves every scan at once so that matched points meet (book 5.2, 5.3): globally
 * consistent scan matching after Lu and Milios in six degrees of freedom.
 *
 * A round sums up each link's pairs at the current poses, solves one sparse linear system for
 * small motions of every scan except the first, and applies the motions.
 * \code
 * GraphSlam slam;
 * const auto result = slam.relax(poses, [&](const auto& current) {
 *   return pairsOfAllLinks(scans, current); // searched anew each round
 * });
 * \endcode
 * Links between two scans, in either direction, add up.
 * \note Source: F. Lu, E. Milios, "Globally consistent range scan alignment for environment
 * mapping", Autonomous Robots 4, 1997; D. Borrmann, J. Elseberg, K. Lingemann, A. Nuechter, J.
 * Hertzberg, RAS 56, 2008. Switching: H. Yang, P. Antonante, V. Tzoumas, L. Carlone, "Graduated
 * non-convexity for robust spatial perception", RA-L 5(2), 2020.
 * \ingroup graph_relaxation */
class GraphSlam {
public:
  using Poses = std::vector<Eigen::Isometry3d>;
  /** \brief Finds the links and their pairs at the given poses. */
  using PairSearch = std::function<std::vector<LinkPairs>(const Poses&)>;
  using Observer = std::function<bool(const GraphSlamRound&)>;

  /** \throws BadArgument an invalid option */
  explicit GraphSlam(const GraphSlamOptions& options = {});

  /** \brief Sets relative poses from other measurements, such as odometry, used besides the
   * pairs (6.3). Without LinkWeights::kCovariance they are weighted against the common
   * variance of the pairs. */
  void
  setMeasuredLinks(const std::vector<PoseLink>& links)
  {
    measured_ = links;
  }

  /** \brief Called after every round; return false to stop. */
  void
  setObserver(const Observer& observer)
  {
    observer_ = observer;
  }

  /** \brief Relaxes with fixed pairs.
   * \param[in] poses T_world_scan, the start
   * \throws BadArgument a pose is not rigid; a link of a scan to itself or to an index out of
   * range; vectors of a link that differ in size; invalid information, see informationFault() */
  GraphSlamResult
  relax(const Poses& poses, const std::vector<LinkPairs>& links) const;

  /** \brief Relaxes with pairs that are searched anew each round.
   * \param[in] last search of a last round, such as with more pairs, after the stop rule was met or
   * one round less than max_iterations; none: no such round. With max_iterations 1 there is none */
  GraphSlamResult
  relax(const Poses& poses,
        const PairSearch& search,
        const PairSearch& last = nullptr) const;

private:
  GraphSlamOptions options_;
  std::vector<PoseLink> measured_;
  Observer observer_;
};

} // namespace pcl6d
