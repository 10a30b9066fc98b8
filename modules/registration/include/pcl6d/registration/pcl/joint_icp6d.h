// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/pcl/icp6d.h>

#include <limits>
#include <memory>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief ICP of several pairs of clouds that share one motion, as a drop-in for
 * pcl::JointIterativeClosestPoint: ICP6D whose source points look for partners in the target
 * of their own pair alone. For the pose of one sensor on another from several observations.
 *
 * All settings of ICP6D count, metrics, normals and weights among them, but for a scale
 * and indices, which align() refuses. Rejectors and estimations see all clouds of a side as
 * one, as in PCL; a correspondence estimation is cloned for each pair, unless there is one
 * for each (addCorrespondenceEstimation()). Differences: the output of align() is all
 * sources, moved, in turn (PCL: empty); getFitnessScore() looks for the partners in the target
 * of the pair (PCL: of all sources in the first target); the clouds of the base class stay
 * those of the first pair.
 * \code
 * pcl6d::JointICP6D<pcl::PointXYZ, pcl::PointXYZ> icp;
 * for (const auto& seen : observations) {
 *   icp.addInputSource(seen.by_one);
 *   icp.addInputTarget(seen.by_other);
 * }
 * icp.align(aligned, guess);
 * \endcode \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class JointICP6D : public ICP6D<PointSource, PointTarget, Scalar> {
public:
  using Base = ICP6D<PointSource, PointTarget, Scalar>;
  using Pcl = typename Base::Base;
  using typename Base::Matrix4;
  using typename Base::PointCloudSource;
  using typename Base::PointCloudTarget;
  using Ptr = pcl::shared_ptr<JointICP6D<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<const JointICP6D<PointSource, PointTarget, Scalar>>;

  JointICP6D() { this->reg_name_ = "JointICP6D"; }

  /** \brief There are several. \throws BadArgument always (PCL: warns and does nothing) */
  void
  setInputSource(const typename Pcl::PointCloudSourceConstPtr& cloud) override;
  void
  setInputTarget(const typename Pcl::PointCloudTargetConstPtr& cloud) override;

  /** \brief Adds one side of a pair; the n-th source belongs to the n-th target. Empty clouds
   * are taken. \throws BadArgument the cloud is null */
  void
  addInputSource(const typename Pcl::PointCloudSourceConstPtr& cloud);
  void
  addInputTarget(const typename Pcl::PointCloudTargetConstPtr& cloud);

  /** \brief Adds the correspondence estimation of a pair: none, or one for each.
   * \throws BadArgument it is null */
  void
  addCorrespondenceEstimation(
      const typename Pcl::CorrespondenceEstimationPtr& estimation);

  void
  clearInputSources()
  {
    sources_.clear();
  }
  void
  clearInputTargets()
  {
    targets_.clear();
    joint_.reset();
  }
  void
  clearCorrespondenceEstimations()
  {
    estimations_.clear();
  }

  using Base::getFitnessScore;
  /** \return the mean squared distance [m^2] of all source points to the targets of their
   * pairs, after the motion; as in PCL, the largest double if there is none
   * \param[in] max_range [m^2] squares above it do not count, as in PCL */
  double
  getFitnessScore(double max_range = std::numeric_limits<double>::max());

protected:
  /** \throws BadArgument there are no pairs, or not as many sources as targets (PCL prints
   * it), and see ICP6D */
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

private:
  struct Target;  ///< all targets as one, each with its tree
  struct Sources; ///< the same of the sources
  using Finder = decltype(IcpHooks::find);

  void
  requirePairs(const IcpOptions& options) const;
  void
  makeTarget(unsigned int num_threads);
  void
  makeTargetNormals(const IcpOptions& options);
  Sources
  makeSources(const IcpOptions& options) const;
  Finder
  finder(const Sources& sources, std::size_t pair, const IcpOptions& options) const;
  IcpHooks
  hooks(const Sources& sources, const IcpOptions& options);

  std::vector<typename Pcl::PointCloudSourceConstPtr> sources_;
  std::vector<typename Pcl::PointCloudTargetConstPtr> targets_;
  std::vector<typename Pcl::CorrespondenceEstimationPtr> estimations_;
  std::shared_ptr<Target> joint_; ///< null: to be made
};

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/joint_icp6d.hpp>

#include <pcl/point_types.h>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(JointICP6D)
} // namespace pcl6d
