// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/line_growth.h>
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

/** \brief ICP with six degrees of freedom, a drop-in pcl::Registration with a reliable
 * hasConverged().
 *
 * pcl::IterativeClosestPoint reports success even at the iteration limit and on NaN. Here
 * hasConverged() is true only if the motion fell below both thresholds and the surfaces leave no
 * motion open; result() has the reason of a failure, and how well each motion is fixed. Runs in
 * parallel, bit-identical for any number of threads. Sums are in double, about a place near the
 * target: UTM-sized coordinates lose no digits, except in getFinalTransformation() of Scalar float;
 * use result() instead.
 *
 * Minimises the distance of points, of points to planes, or of planes (setMetric()). Normals are
 * taken from the point type if filled in, else estimated, towards the origin; in a scan of lines
 * far apart, for example of a spinning lidar at the origin, from patches that grow across lines
 * (setLineGrowth()).
 *
 * PCL's setters are honoured: setMaximumIterations (100 unless set; 0 means 1, like in PCL),
 * setMaxCorrespondenceDistance (no limit unless set; no pair is within 0), setTransformationEpsilon
 * (squared [m^2], and, without setTransformationRotationEpsilon, 1 minus the cosine of the turn,
 * like in PCL), setTransformationRotationEpsilon (cosine, like in PCL), setEuclideanFitnessEpsilon
 * (relative change of the mean squared distance), setIndices, setTransformationEstimation (of
 * pcl6d, points to points or to planes, which sets the metric; also PCL's; an estimation with a
 * scale sets setEstimateScale()), setCorrespondenceEstimation, addCorrespondenceRejector,
 * setPointRepresentation (FLANN then searches for neighbours), registerVisualizationCallback,
 * setSearchMethodTarget (with a CachedKdTree each search starts at the leaf of the last neighbour;
 * otherwise a point is searched only when it may have a new neighbour, see SearchMethod). The
 * target's tree is built once; a FLANN tree only on request. Without effect, like in PCL's own
 * class: the RANSAC settings. align() never throws on data, even empty or NaN; without convergence,
 * getFinalTransformation() is the last good estimate or the guess. Exceptions of plugged-in classes
 * propagate. Not copyable, like PCL's class.
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

  /** \brief Unlike PCL, accepts an empty cloud, too: align() then gives kTooFewPairs. Indices out
   * of range of the new cloud must be set anew before align().
   * \throws BadArgument the cloud is null */
  void
  setInputSource(const typename Base::PointCloudSourceConstPtr& cloud) override;

  /** \brief Sets the target, see setInputSource(); data derived from the last target are rebuilt.
   * \throws BadArgument the cloud is null */
  void
  setInputTarget(const typename Base::PointCloudTargetConstPtr& cloud) override;

  using Base::setIndices;
  /** \brief The source points to use. \throws BadArgument null, or an index is out of range of a
   * source already set */
  void
  setIndices(const pcl::IndicesPtr& indices) override;
  void
  setIndices(const pcl::IndicesConstPtr& indices) override;
  void
  setIndices(const typename Base::PointIndicesConstPtr& indices) override;

  /** \brief PCL's setters, without null. \throws BadArgument null */
  void
  setSearchMethodTarget(const typename Base::KdTreePtr& tree,
                        bool force_no_recompute = false);
  void
  setTransformationEstimation(
      const typename Base::TransformationEstimationPtr& estimation);
  void
  addCorrespondenceRejector(const typename Base::CorrespondenceRejectorPtr& rejector);

  /** \brief The error metric; points to points unless set. */
  void
  setMetric(Metric metric)
  {
    options_.metric = metric;
  }

  /** \brief The number of nearest points for an estimated normal; 20 unless set.
   * \throws BadArgument by align(), if outside [3, 64] */
  void
  setNormalNeighbours(std::size_t neighbours)
  {
    normal_settings_.neighbours = neighbours;
  }

  /** \brief Whether the patch of an estimated normal grows across lines where the nearest points
   * lie on one line; see estimateScanNormals(). A point with a patch that stays a line has no
   * plane: the point-to-plane metrics leave the point out, GICP gives its pairs a thousandth of
   * the weight. kAuto unless set: patches grow on each side where the scan, seen from the origin,
   * consists of lines or rings; otherwise results are bit-identical to kNever. */
  void
  setLineGrowth(LineGrowth growth)
  {
    normal_settings_.growth = growth;
  }
  LineGrowth
  getLineGrowth() const
  {
    return normal_settings_.growth;
  }

  /** \brief Whether hasConverged() is true at the iteration limit, too, like in PCL; false unless
   * set. result() distinguishes both cases anyway. */
  void
  setIterationLimitConverges(bool converges)
  {
    criteria_->setFailureAfterMaximumIterations(!converges);
  }

  /** \brief PCL's object with the reason of the end and further settings of the end, see
   * ConvergenceCriteria. Valid during the lifetime of this object. */
  typename pcl::registration::DefaultConvergenceCriteria<Scalar>::Ptr
  getConvergeCriteria();

  /** \brief Kernel that reduces the weight of distant pairs; kNone unless set. */
  void
  setRobustKernel(RobustKernel kernel)
  {
    options_.robust = kernel;
  }

  /** \brief Whether the source is scaled, too: by Horn's unit quaternion with scale, in place of
   * the transformation estimation; false unless set. getFinalTransformation() then is s R and t,
   * like with PCL's TransformationEstimationSVDScale; result() has scale and motion apart. Both
   * PCL's class and TransformationEstimationScaleQuaternion, given to
   * setTransformationEstimation(), set this option. A guess is a rigid motion. Points to points
   * only, and without correspondence estimations, rejectors, estimations of PCL and reciprocal
   * pairs. \throws BadArgument by align(), if one of the excluded options is set */
  void
  setEstimateScale(bool estimate)
  {
    options_.estimate_scale = estimate;
  }

  /** \brief Uses only this share of the pairs, the closest (trimmed ICP). */
  void
  setKeptShare(double share)
  {
    options_.kept_share = share;
  }

  /** \brief Uses only mutually closest pairs. */
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

  /** \brief Limit of the pair distance at the start [m], shrinking by a tenth per iteration to
   * setMaxCorrespondenceDistance() (annealing, book 4.1.5). 0: off. */
  void
  setMaxCorrespondenceDistanceStart(double distance)
  {
    options_.max_distance_start = distance;
  }

  /** \brief Stop when a step is shorter [m] and turns less [rad]. */
  void
  setMotionEpsilon(double translation, double rotation);

  /** \brief Threads for the tree and the pairs.
   * \param[in] num_threads 0: a thread per core; never changes the result */
  void
  setNumberOfThreads(unsigned int num_threads);

  /** \brief Called after every iteration; return false to stop. */
  void
  setObserver(IcpObserver observer);

  /** \return the result of the last align(), in the frame of the target */
  const IcpResult&
  result() const
  {
    return result_;
  }

protected:
  /** \throws BadArgument a setting is invalid, an index of the source is out of range, the search
   * method was built from a cloud other than the target, or a given estimation returns a matrix
   * that is no motion */
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

  struct Target; ///< data derived from the target
  struct Sides;  ///< data of both clouds for one run

  /** The clouds and indices for a visualisation callback. */
  struct Shown {
    const PointCloudSource* source;
    const pcl::Indices* chosen;
    const PointCloudTarget* target;
    const pcl::Indices* searched;
  };
  using Adapter = registration::PclAdapter<PointSource, PointTarget, Scalar>;
  using Rejectors = std::vector<decltype(IcpHooks::reject)>;

  /** Options of a run from the setters, checked. */
  IcpOptions
  startRun();
  /** \return the guess, from where the motion is counted */
  Eigen::Isometry3d
  startPose(const Matrix4& guess);
  void
  addObservers(IcpHooks& hooks, const Eigen::Vector3d& origin, const Shown& shown);
  /** Adds the rejectors after the given rejectors, and the estimation, if not of pcl6d. */
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

  /** The normals of chosen points, given or estimated. */
  virtual Normals
  sourceNormals(const Points& points, const IcpOptions& options) const;
  /** Like sourceNormals(). \param[in] tree over the points; null: to be made */
  virtual Normals
  targetNormals(const pcl::Indices& indices,
                const Points& points,
                const PointTree* tree,
                const IcpOptions& options) const;
  /** Hook for a derived class to add the step of its own metric. */
  virtual void
  addStep(const Sides& /*sides*/, const IcpOptions& /*options*/, IcpHooks& /*hooks*/)
  {}

  IcpOptions options_; ///< options without a member in PCL's base class
  ScanNormals normal_settings_;
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
  bool has_stale_indices_ = false; ///< the indices belonged to a former, larger source
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
// Classes derived from ICP6D have always been included with this header.
#include <pcl6d/registration/pcl/gicp6d.h>
#include <pcl6d/registration/pcl/icp6d_with_normals.h>
