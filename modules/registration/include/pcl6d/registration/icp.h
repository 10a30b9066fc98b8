// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/status.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/registration/icp_options.h>
#include <pcl6d/registration/localizability.h>
#include <pcl6d/registration/pose_information.h>
#include <pcl6d/search/point_tree.h>

#include <functional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The source (data points) of ICP; refers to data owned by the caller. */
struct IcpSource {
  const Points* points = nullptr;
  const Normals* normals = nullptr; ///< for the metric kGicp
};

/** \brief Memory of the searches in a part, for the next iteration of ICP. Never
 * changes a result. */
enum class SearchMemory {
  kNone, ///< each point is searched anew in each iteration
  /** the neighbour, and the distance of the second nearest point: no search while by the triangle
   * inequality no other point can have become nearer */
  kNeighbours,
  /** the leaf of the neighbour, where the next search starts: the cached k-d tree,
   * PointTree::nearestFrom(); the tree must keep its cells */
  kLeaves
};

/** \brief A part of the target (model), for example one scan; refers to data owned
 * by the caller. */
struct IcpTargetPart {
  const PointTree* tree = nullptr; ///< over the points
  const Points* points = nullptr;
  const Normals* normals = nullptr; ///< for the metrics with normals
  Eigen::Isometry3d T_target_part = Eigen::Isometry3d::Identity();
  /** a search in place of the tree (which may then be null): the nearest point within the root of a
   * squared distance */
  std::function<Neighbour(const Eigen::Vector3f&, float)> search = {};
  /** kNeighbours takes effect only if set for every part of a target */
  SearchMemory memory = SearchMemory::kNeighbours;
  /** with another search, the k nearest points: places and squared distances, sorted */
  std::function<std::vector<Neighbour>(const Eigen::Vector3f&, std::size_t)> search_k =
      {};
};

/** \brief The target (model) of ICP: the union of its parts. Each part has its own tree, hence a
 * union of many scans needs no tree. */
using IcpTarget = std::vector<IcpTargetPart>;

/** \brief A pair of ICP with a target of one part. */
struct IcpPair {
  int source = -1;       ///< place among the source points
  int target = -1;       ///< place among the target points
  float distance_sq = 0; ///< [m^2]
};

/** \brief State of an iteration, for observers. */
struct IcpIteration {
  int number = 0;            ///< from 1
  std::size_t pairs = 0;     ///< pairs used
  double rms = 0;            ///< [m] distance of the used pairs, before the step
  double max_distance = 0;   ///< [m] the limit of this iteration
  double translation = 0;    ///< [m] way of the pairs' centroid in this step
  double rotation = 0;       ///< [rad] angle of the step
  std::size_t searched = 0;  ///< source points with a new search for the neighbour
  std::size_t from_leaf = 0; ///< searches started at a remembered leaf
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity(); ///< after the step
  double scale = 1; ///< after the step, see IcpResult
};

/** \brief Called after each iteration. \return false to stop (status kMaxIterations) */
using IcpObserver = std::function<bool(const IcpIteration&)>;

/** \brief Called after each iteration with the pairs used in it. */
using IcpPairsObserver =
    std::function<void(const IcpIteration&, const std::vector<IcpPair>&)>;

/** \brief Hooks into the iteration for the caller. Hooks of pairs need a target of one part. */
struct IcpHooks {
  IcpObserver observer;
  IcpPairsObserver pairs_observer;
  /** finds the pairs at a pose within a distance [m], in place of the tree; of several pairs of a
   * source point the closest is used */
  std::function<std::vector<IcpPair>(const Eigen::Isometry3d&, double)> find;
  /** leaves out pairs at a pose */
  std::function<std::vector<IcpPair>(const Eigen::Isometry3d&, std::vector<IcpPair>)>
      reject;
  /** the step from the pairs at a pose, in place of the minimisers */
  std::function<RigidEstimate(const Eigen::Isometry3d&, const std::vector<IcpPair>&)>
      minimise;
};

/** \brief Why ICP stopped. */
enum class IcpStop {
  kAtRest,         ///< the step was within both thresholds, or the error did not change
  kIterationLimit, ///< max_iterations
  kObserver,       ///< stopped by the observer
  kTooFewPairs,    ///< fewer than 3 pairs
  kDiverged        ///< a value was not finite, or the error grew beyond its limit
};

/** \return "at rest", "iteration limit", "observer", "too few pairs" or "diverged" */
const char*
toString(IcpStop stop);

/** \brief The outcome of ICP. */
struct IcpResult {
  /** kOk: at rest, and the surfaces fix the pose; kRankDeficient: at rest, but the surfaces leave a
   * motion open, along a corridor for example: the pose is one of many equally good poses */
  Status status = Status::kTooFewPairs;
  IcpStop stop = IcpStop::kTooFewPairs;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  /** size of the target relative to the source: m = T_target_source (scale d); 1 unless estimated
   * (IcpOptions::estimate_scale), and with kTooFewPairs and kDiverged */
  double scale = 1;
  int iterations = 0;
  std::size_t pairs = 0; ///< pairs used at the final pose
  double rms = 0;        ///< [m] distance of the pairs
  double residual = 0;   ///< [m] rms of the residuals of the metric
  double overlap = 0;    ///< share of the finite source points with a partner within
                         ///< max_distance, before trimming
  /** of T_target_source (x y z roll pitch yaw) [m, rad]: singular if the pairs leave a direction
   * open; empty with fewer than 3 pairs or near a pitch of a right angle */
  std::optional<PoseInformation> information;
  std::optional<PoseCovariance> covariance; ///< its inverse, if the pairs fix the pose
  /** how well the pairs fix each motion: pairs of surfaces by their normals, points that coincide
   * with their partners by the points; empty if the target has neither tree, search of several
   * points nor normals */
  std::optional<Localizability> localizability;
};

/** \brief ICP (book 4.1): closest pairs within a limit, then the motion that brings the pairs
 * together, until convergence.
 *
 * Bit-identical for any number of threads: blocks of source points are merged in a fixed order
 * (4.1.6). Unless set otherwise for a part (SearchMemory), a neighbour is searched only if another
 * point could have become nearer since the last search: exact. The limit may shrink from
 * max_distance_start to max_distance (4.1.5); the iteration does not stop before. Points that are
 * not finite are skipped, and pairs without the normals needed by kPlane.
 * \param[in] guess T_target_source to start from; the coordinates of the target's frame
 * should be small enough for float
 * \return never throws on data. kTooFewPairs and kDiverged return the guess, otherwise
 * the last iterate
 * \throws BadArgument an option is invalid, normals are missing or not one per point, hooks of
 * pairs with a target of several parts or an estimated scale, or SearchMemory::kLeaves with a tree
 * that keeps no cells */
IcpResult
icp(const IcpTarget& target,
    const IcpSource& source,
    const Eigen::Isometry3d& guess,
    const IcpOptions& options,
    const IcpHooks& hooks = {});

/** \brief icp() point to point, against one tree. \ingroup registration */
IcpResult
icp(const PointTree& target,
    const Points& target_points,
    const Points& source,
    const Eigen::Isometry3d& guess,
    const IcpOptions& options,
    const RigidMinimiser& minimiser = minimiseByQuaternion,
    const IcpObserver& observer = {});

} // namespace pcl6d
