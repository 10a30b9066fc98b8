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

/** \brief The data points of ICP; refers to what its maker owns. */
struct IcpSource {
  const Points* points = nullptr;
  const Normals* normals = nullptr; ///< for the metric kGicp
};

/** \brief What ICP remembers of the searches in a part, for the next iteration. Never
 * changes a result. */
enum class SearchMemory {
  kNone, ///< nothing: each point is searched anew in each iteration
  /** the neighbour, and how near any other point came: no search as long as the triangle
   * inequality says that none can have become nearer */
  kNeighbours,
  /** the leaf of the tree in which the neighbour was found, where the next search starts:
   * the cached k-d tree, PointTree::nearestFrom(); the tree must keep its cells */
  kLeaves
};

/** \brief A part of the model, such as one scan; refers to what its maker owns. */
struct IcpTargetPart {
  const PointTree* tree = nullptr; ///< over the points
  const Points* points = nullptr;
  const Normals* normals = nullptr; ///< for the metrics with normals
  Eigen::Isometry3d T_target_part = Eigen::Isometry3d::Identity();
  /** another search than that of the tree (which may then be null): the nearest point
   * within the root of a squared distance */
  std::function<Neighbour(const Eigen::Vector3f&, float)> search = {};
  /** kNeighbours only if it is so for all parts of a target */
  SearchMemory memory = SearchMemory::kNeighbours;
  /** with another search, the k nearest points: places and squared distances, sorted */
  std::function<std::vector<Neighbour>(const Eigen::Vector3f&, std::size_t)> search_k =
      {};
};

/** \brief The model of ICP: the union of its parts, each with a tree of its own, so
 * that many scans together need no tree. */
using IcpTarget = std::vector<IcpTargetPart>;

/** \brief A pair of ICP with a target of one part. */
struct IcpPair {
  int source = -1;       ///< place among the source points
  int target = -1;       ///< place among the target points
  float distance_sq = 0; ///< [m^2]
};

/** \brief One iteration, as an observer sees it. */
struct IcpIteration {
  int number = 0;            ///< from 1
  std::size_t pairs = 0;     ///< pairs that counted
  double rms = 0;            ///< [m] distance of these pairs, before the step
  double max_distance = 0;   ///< [m] the limit of this iteration
  double translation = 0;    ///< [m] way of the pairs' centroid in this step
  double rotation = 0;       ///< [rad] angle of the step
  std::size_t searched = 0;  ///< source points whose neighbour had to be searched
  std::size_t from_leaf = 0; ///< of these, searches that started at a remembered leaf
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity(); ///< after the step
  double scale = 1; ///< after the step, see IcpResult
};

/** \brief Called after each iteration. \return false to stop (status kMaxIterations) */
using IcpObserver = std::function<bool(const IcpIteration&)>;

/** \brief Called after each iteration with the pairs that counted in it. */
using IcpPairsObserver =
    std::function<void(const IcpIteration&, const std::vector<IcpPair>&)>;

/** \brief Places where a caller may take part. Those of pairs need a target of one part. */
struct IcpHooks {
  IcpObserver observer;
  IcpPairsObserver pairs_observer;
  /** finds the pairs at a pose within a distance [m], in place of the tree; of several
   * pairs of one source point the closest counts */
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
  kObserver,       ///< the observer said so
  kTooFewPairs,    ///< fewer than 3 pairs
  kDiverged        ///< a value was not finite, or the error grew beyond its limit
};

/** \return "at rest", "iteration limit", "observer", "too few pairs" or "diverged" */
const char*
toString(IcpStop stop);

/** \brief The outcome of ICP. */
struct IcpResult {
  /** kOk: at rest, and the surfaces fix the pose; kRankDeficient: at rest, but they leave a
   * motion open, such as that along a corridor: the pose is one of many as good */
  Status status = Status::kTooFewPairs;
  IcpStop stop = IcpStop::kTooFewPairs;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  /** how many times as large as the source the target is: m = T_target_source (scale d); 1
   * unless it was to be estimated (IcpOptions::estimate_scale), and with kTooFewPairs and
   * kDiverged */
  double scale = 1;
  int iterations = 0;
  std::size_t pairs = 0; ///< pairs at the final pose that count
  double rms = 0;        ///< [m] distance of these pairs
  double residual = 0;   ///< [m] rms of what the metric minimises
  double overlap = 0;    ///< share of the finite source points with a partner within
                         ///< max_distance, before trimming
  /** of T_target_source (x y z roll pitch yaw) [m, rad]: singular if the pairs leave a
   * direction open; none without 3 pairs or near a pitch of a right angle */
  std::optional<PoseInformation> information;
  std::optional<PoseCovariance> covariance; ///< its inverse, if the pairs fix the pose
  /** which motions the pairs fix, and how well: of planes and surfaces by their normals, of
   * points that lie on their partners by the points; none if the target has neither tree,
   * search of several points nor normals */
  std::optional<Localizability> localizability;
};

/** \brief ICP (book 4.1): closest pairs within a limit, the motion that brings them
 * together, until it stops.
 *
 * The same bits for any number of threads: blocks of source points, merged in a fixed
 * order (4.1.6). Unless a part says otherwise (SearchMemory), a neighbour is searched only
 * if the point has moved so far since the last search that another could be nearer: exact.
 * The limit may shrink from
 * max_distance_start to max_distance (4.1.5); the iteration does not stop before it has
 * arrived there. Points that are not finite are skipped; so are pairs without the
 * normals that kPlane needs.
 * \param[in] guess T_target_source to start from; the coordinates of the target's frame
 * should be small enough for float
 * \return never throws on data. kTooFewPairs and kDiverged return the guess, others the
 * last iterate
 * \throws BadArgument an option breaks its rule, normals are missing or not one per
 * point, hooks of pairs meet a target of several parts or an estimated scale, or leaves are to be remembered of a
 * tree that keeps no cells */
IcpResult
icp(const IcpTarget& target,
    const IcpSource& source,
    const Eigen::Isometry3d& guess,
    const IcpOptions& options,
    const IcpHooks& hooks = {});

/** \brief The same point to point, against one tree. \ingroup registration */
IcpResult
icp(const PointTree& target,
    const Points& target_points,
    const Points& source,
    const Eigen::Isometry3d& guess,
    const IcpOptions& options,
    const RigidMinimiser& minimiser = minimiseByQuaternion,
    const IcpObserver& observer = {});

} // namespace pcl6d
