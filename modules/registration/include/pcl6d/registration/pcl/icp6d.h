// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/pcl/convergence_criteria.h>
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/registration/registration.h>

#include <memory>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

namespace registration {
template <typename PointSource, typename PointTarget, typename Scalar>
class PclAdapter;
} // namespace registration

/** \brief ICP with six degrees of freedom as a drop-in pcl::Registration, which says
 * honestly whether it converged.
 *
 * Where pcl::IterativeClosestPoint reports success at the iteration limit and on NaN,
 * here hasConverged() is true only if the motion fell below both thresholds and the
 * surfaces leave no motion open; result() says why not, and how well each is fixed. Runs
 * in parallel with the same bits for any number of threads; all sums are in double, about
 * a place near the target, so that UTM-sized coordinates lose nothing; but
 * getFinalTransformation() of Scalar float does, so take result() there.
 *
 * Minimises the distance of points, of points to planes, or of planes (setMetric()).
 * Normals are those of the point type if it has them and they are filled in, else they
 * are estimated, towards the origin.
 *
 * PCL's setters are honoured: setMaximumIterations (100 unless set; 0 is one, as in PCL),
 * setMaxCorrespondenceDistance (no limit unless set; none is within 0),
 * setTransformationEpsilon (squared [m^2], and, unless the next one is set, 1 minus the
 * cosine of the turn, as in PCL), setTransformationRotationEpsilon (cosine, as in PCL),
 * setEuclideanFitnessEpsilon (relative change of the mean squared distance), setIndices,
 * setTransformationEstimation (ours, points to points or to planes, which sets the metric;
 * also PCL's; one with a scale estimates it, see setEstimateScale()),
 * setCorrespondenceEstimation, addCorrespondenceRejector, setPointRepresentation (then
 * neighbours are searched by FLANN), registerVisualizationCallback,
 * setSearchMethodTarget (a CachedKdTree: each source point starts at the leaf of its last
 * neighbour; else it is searched only when it may have a new one, see SearchMethod). The
 * target's tree is built once; FLANN never, unless it is asked for. Without
 * effect, as with PCL's own class: the RANSAC settings. align() never throws on data, be
 * they empty or NaN; not converged, getFinalTransformation() is the last good estimate or the
 * guess. What a plugged class throws passes through. Not copied, as PCL's class.
 * \code
 * pcl6d::ICP6D<pcl::PointXYZ, pcl::PointXYZ> icp;
 * icp.setInputSource(data);
 * icp.setInputTarget(model);
 * icp.setMaxCorrespondenceDistance(0.5);
 * icp.align(aligned, guess);
 * if (!icp.hasConverged())
 *   std::cerr << pcl6d::toString(icp.result().status) << '\n';
 * \endcode
 * \note Source: P. J. Besl, N. D. McKay, "A method for registration of 3-D shapes",
 * PAMI 1992. Book: 4.1. \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class ICP6D : public pcl::Registration<PointSource, PointTarget, Scalar> {
public:
  using Base = pcl::Registration<PointSource, PointTarget, Scalar>;
  using typename Base::Matrix4;
  using typename Base::PointCloudSource;
  using typename Base::PointCloudTarget;
  using Ptr = pcl::shared_ptr<ICP6D<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<const ICP6D<PointSource, PointTarget, Scalar>>;

  ICP6D();
  ICP6D(const ICP6D&) = delete;
  ICP6D&
  operator=(const ICP6D&) = delete;

  /** \brief Unlike PCL, takes an empty cloud, too: align() then says kTooFewPairs. Indices
   * that it has no point of must be set anew before align().
   * \throws BadArgument the cloud is null */
  void
  setInputSource(const typename Base::PointCloudSourceConstPtr& cloud) override;

  /** \brief The same; whatever was made of the last target is made anew.
   * \throws BadArgument the cloud is null */
  void
  setInputTarget(const typename Base::PointCloudTargetConstPtr& cloud) override;

  using Base::setIndices;
  /** \brief The points of the source that count. \throws BadArgument null, or a source is
   * set and has no such point */
  void
  setIndices(const pcl::IndicesPtr& indices) override;
  void
  setIndices(const pcl::IndicesConstPtr& indices) override;
  void
  setIndices(const typename Base::PointIndicesConstPtr& indices) override;

  /** \brief PCL's setters, which refuse null. \throws BadArgument it is null */
  void
  setSearchMethodTarget(const typename Base::KdTreePtr& tree,
                        bool force_no_recompute = false);
  void
  setTransformationEstimation(
      const typename Base::TransformationEstimationPtr& estimation);
  void
  addCorrespondenceRejector(const typename Base::CorrespondenceRejectorPtr& rejector);

  /** \brief What is minimised; points to points unless set. */
  void
  setMetric(Metric metric)
  {
    options_.metric = metric;
  }

  /** \brief The number of nearest points that make a normal where none is given; 20
   * unless set. \throws BadArgument by align(), if outside [3, 64] */
  void
  setNormalNeighbours(std::size_t neighbours)
  {
    normal_neighbours_ = neighbours;
  }

  /** \brief Whether hasConverged() is true at the iteration limit, too, as in PCL; false
   * unless set. result() says in any case which it was. */
  void
  setIterationLimitConverges(bool converges)
  {
    criteria_->setFailureAfterMaximumIterations(!converges);
  }

  /** \brief PCL's object that tells why the iteration ended and takes more settings of its
   * end, see ConvergenceCriteria. It lives as long as this object. */
  typename pcl::registration::DefaultConvergenceCriteria<Scalar>::Ptr
  getConvergeCriteria();

  /** \brief Less weight for pairs that are far apart; none unless set. */
  void
  setRobustKernel(RobustKernel kernel)
  {
    options_.robust = kernel;
  }

  /** \brief Whether the source is scaled, too: by Horn's unit quaternion with scale, in
   * place of the transformation estimation; false unless set. getFinalTransformation() then
   * is s R and t as with PCL's TransformationEstimationSVDScale, result() has both apart; that
   * class and TransformationEstimationScaleQuaternion, given as estimation, set it. A
   * guess is a rigid motion. Points to points only, and without correspondence estimations,
   * rejectors, estimations of PCL's and reciprocal pairs. \throws BadArgument by align(), if
   * any of them is set */
  void
  setEstimateScale(bool estimate)
  {
    options_.estimate_scale = estimate;
  }

  /** \brief Only so large a share of the pairs, the closest ones, counts (trimmed ICP). */
  void
  setKeptShare(double share)
  {
    options_.kept_share = share;
  }

  /** \brief Only pairs that are each other's closest count. */
  void
  setUseReciprocalCorrespondences(bool reciprocal)
  {
    reciprocal_ = reciprocal;
  }
  bool
  getUseReciprocalCorrespondences() const
  {
    return reciprocal_;
  }

  /** \brief Limit of the pair distance at the start [m], which shrinks by a tenth per
   * iteration to setMaxCorrespondenceDistance() (annealing, book 4.1.5). 0: off. */
  void
  setMaxCorrespondenceDistanceStart(double distance)
  {
    options_.max_distance_start = distance;
  }

  /** \brief Stop when a step is shorter [m] and turns less [rad]. */
  void
  setMotionEpsilon(double translation, double rotation);

  /** \brief Threads for the tree and the pairs.
   * \param[in] num_threads 0: one per core; never changes the result */
  void
  setNumberOfThreads(unsigned int num_threads);

  /** \brief Called after every iteration; return false to stop. */
  void
  setObserver(IcpObserver observer);

  /** \return what the last align() came to, in the frame of the target */
  const IcpResult&
  result() const
  {
    return result_;
  }

protected:
  /** \throws BadArgument a setting breaks its rule, the source has no point of an index, the
   * search method was built from another cloud than the target, or a given estimation makes
   * what is no motion */
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

  struct Target; ///< what is made of the target
  struct Sides;  ///< what one run takes of both clouds

  /** The clouds and indices that a visualisation callback sees. */
  struct Shown {
    const PointCloudSource* source;
    const pcl::Indices* chosen;
    const PointCloudTarget* target;
    const pcl::Indices* searched;
  };
  using Adapter = registration::PclAdapter<PointSource, PointTarget, Scalar>;
  using Rejectors = std::vector<decltype(IcpHooks::reject)>;

  /** Options of a run from all setters, checked. */
  IcpOptions
  startRun();
  /** \return the guess, from where the motion is counted */
  Eigen::Isometry3d
  startPose(const Matrix4& guess);
  void
  addObservers(IcpHooks& hooks, const Eigen::Vector3d& origin, const Shown& shown);
  /** Adds the rejectors after some others, and the estimation, if it is not ours. */
  void
  plugIn(const std::shared_ptr<Adapter>& adapter,
         Rejectors rejectors,
         const IcpOptions& options,
         IcpHooks& hooks);
  /** Keeps the outcome of a run, but for the output. */
  void
  keep(const IcpResult& found, const Eigen::Vector3d& origin);
  void
  moveOutput(PointCloudSource& output) const;
  /** For settings that change the normals of the target. */
  void
  forgetTargetNormals();

  /** The normals of chosen points, as given or estimated.
   * \param[in] tree over the points; null: to be made */
  virtual Normals
  sourceNormals(const Points& points, const IcpOptions& options) const;
  virtual Normals
  targetNormals(const pcl::Indices& indices,
                const Points& points,
                const PointTree* tree,
                const IcpOptions& options) const;
  /** Lets a metric of its own take its step. */
  virtual void
  addStep(const Sides& /*sides*/, const IcpOptions& /*options*/, IcpHooks& /*hooks*/)
  {}

  IcpOptions options_; ///< what PCL's base class has no member for
  std::size_t normal_neighbours_ = 20;
  /** whether setTransformationEpsilon() is the square of a length, and a turn */
  bool epsilon_is_squared_ = true;
  bool reciprocal_ = false;
  IcpResult result_;

private:
  void
  takeCriteria();
  IcpOptions
  effectiveOptions() const;
  void
  makeTarget();
  void
  makeNormals(const IcpOptions& options);
  Sides
  sides(const IcpOptions& options);
  IcpHooks
  hooks(const Sides& sides, const IcpOptions& options);
  void
  showPairs(const IcpIteration& seen,
            const std::vector<IcpPair>& pairs,
            const Shown& shown);

  typename ConvergenceCriteria<Scalar>::Ptr criteria_;
  bool ended_by_criteria_ = false;
  bool has_stale_indices_ = false; ///< they are not of the source
  IcpObserver observer_;
  Eigen::Affine3d last_pose_ = Eigen::Affine3d::Identity(); ///< in the target's frame
  Eigen::Affine3d last_step_ = Eigen::Affine3d::Identity();
  std::shared_ptr<Target> made_; ///< of the target; null: to be made
};

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/icp6d.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(ICP6D)
} // namespace pcl6d
// The classes that are ICP6D with other settings have always come with it.
#include <pcl6d/registration/pcl/gicp6d.h>
#include <pcl6d/registration/pcl/icp6d_with_normals.h>
