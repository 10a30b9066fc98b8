// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/registration/registration.h>

#include <algorithm>

namespace PCL6D_EXPORTS pcl6d {

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
    iteration_limit_converges_ = converges;
  }

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

  IcpOptions options_; ///< what PCL's base class has no member for
  std::size_t normal_neighbours_ = 20;
  /** whether setTransformationEpsilon() is the square of a length, and a turn */
  bool epsilon_is_squared_ = true;

private:
  struct Target;
  struct Sides;

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
  store(const IcpResult& found,
        const Eigen::Vector3d& origin,
        PointCloudSource& output);
  void
  moveOutput(PointCloudSource& output) const;
  void
  addObservers(IcpHooks& hooks, const Eigen::Vector3d& origin);
  void
  showPairs(const IcpIteration& seen, const std::vector<IcpPair>& pairs);

  bool reciprocal_ = false;
  bool iteration_limit_converges_ = false;
  bool has_stale_indices_ = false; ///< they are not of the source
  IcpObserver observer_;
  Eigen::Affine3d last_pose_ = Eigen::Affine3d::Identity(); ///< in the target's frame
  Eigen::Affine3d last_step_ = Eigen::Affine3d::Identity();
  std::shared_ptr<Target> made_; ///< of the target; null: to be made
  IcpResult result_;
};

/** \brief Generalized-ICP as a drop-in for pcl::GeneralizedIterativeClosestPoint: ICP6D
 * with Metric::kGicp. Takes one Gauss-Newton step between two searches, so that PCL's
 * settings of the inner optimizer have no counterpart. Its defaults are PCL's: 5 m, 200
 * iterations, at rest below 5e-4 m (setTransformationEpsilon(), here not squared) and 2e-3 rad
 * in a step.
 * \note Source: A. Segal, D. Haehnel, S. Thrun, "Generalized-ICP", RSS 2009.
 * \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class GICP6D : public ICP6D<PointSource, PointTarget, Scalar> {
public:
  using Ptr = pcl::shared_ptr<GICP6D<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<const GICP6D<PointSource, PointTarget, Scalar>>;

  GICP6D()
  {
    this->reg_name_ = "GICP6D";
    this->setMetric(Metric::kGicp);
    this->max_iterations_ = 200; // all as in PCL
    this->corr_dist_threshold_ = 5;
    this->transformation_epsilon_ = 5e-4;
    this->options_.rotation_epsilon = 2e-3;
    this->epsilon_is_squared_ = false;
  }

  /** \brief Stop when a step also turns less [rad]; 2e-3 unless set. */
  void
  setRotationEpsilon(double epsilon)
  {
    this->options_.rotation_epsilon = epsilon;
  }
  double
  getRotationEpsilon() const
  {
    return this->options_.rotation_epsilon;
  }

  /** \brief PCL's name for setNormalNeighbours(); less than 3 count as 3, more than 64 as
   * 64. */
  void
  setCorrespondenceRandomness(int neighbours)
  {
    this->setNormalNeighbours(std::clamp(neighbours, 3, 64));
  }
  int
  getCorrespondenceRandomness() const
  {
    return static_cast<int>(this->normal_neighbours_);
  }

  /** \brief PCL's settings of the optimizer between two searches, kept for their getters. The
   * one step that stands in its place is exact for the linear problem, and ICP repeats it. */
  void
  setMaximumOptimizerIterations(int count)
  {
    optimizer_iterations_ = count;
  }
  int
  getMaximumOptimizerIterations() const
  {
    return optimizer_iterations_;
  }
  void
  setTranslationGradientTolerance(double tolerance)
  {
    translation_gradient_ = tolerance;
  }
  double
  getTranslationGradientTolerance() const
  {
    return translation_gradient_;
  }
  void
  setRotationGradientTolerance(double tolerance)
  {
    rotation_gradient_ = tolerance;
  }
  double
  getRotationGradientTolerance() const
  {
    return rotation_gradient_;
  }

private:
  int optimizer_iterations_ = 20;
  double translation_gradient_ = 1e-2;
  double rotation_gradient_ = 1e-2;
};

/** \brief ICP by points and planes as a drop-in for pcl::IterativeClosestPointWithNormals:
 * ICP6D with Metric::kPlane, and its symmetric objective. Normals that the points do not have
 * are estimated. \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class ICP6DWithNormals : public ICP6D<PointSource, PointTarget, Scalar> {
public:
  using Ptr = pcl::shared_ptr<ICP6DWithNormals<PointSource, PointTarget, Scalar>>;
  using ConstPtr =
      pcl::shared_ptr<const ICP6DWithNormals<PointSource, PointTarget, Scalar>>;

  ICP6DWithNormals()
  {
    this->reg_name_ = "ICP6DWithNormals";
    this->setMetric(Metric::kPlane);
  }

  /** \brief Whether the normals of both sides count (IcpOptions::symmetric); false unless
   * set. */
  void
  setUseSymmetricObjective(bool symmetric)
  {
    this->options_.symmetric = symmetric;
  }
  bool
  getUseSymmetricObjective() const
  {
    return this->options_.symmetric;
  }

  /** \brief Whether then a normal is turned towards its partner's; true unless set. */
  void
  setEnforceSameDirectionNormals(bool enforce)
  {
    this->options_.align_normals = enforce;
  }
  bool
  getEnforceSameDirectionNormals() const
  {
    return this->options_.align_normals;
  }
};

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/icp6d.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(ICP6D)
PCL6D_DECLARE_PAIR_INSTANCES(GICP6D)
PCL6D_DECLARE_PAIR_INSTANCES(ICP6DWithNormals)
} // namespace pcl6d
