// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/pcl/icp6d.h>

#include <limits>
#include <memory>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief ICP of several pairs of clouds with one common motion: drop-in for
 * pcl::JointIterativeClosestPoint. An ICP6D in which source points have partners only in the
 * target of their own pair. For the relative pose of two sensors from several observations.
 *
 * Every setting of ICP6D is supported, metrics, normals and weights included, but a scale or
 * indices are an error in align(). Rejectors and estimations get the clouds of a side joined into
 * one, like in PCL; a correspondence estimation is cloned for each pair, unless set per pair
 * (addCorrespondenceEstimation()). Differences: the output of align() is the moved sources, in turn
 * (PCL: empty); getFitnessScore() searches in the target of the pair (PCL: in the first target for
 * every source); the base class keeps the clouds of the first pair.
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

  /** \brief Not supported, use addInputSource(). \throws BadArgument always (PCL: only warns) */
  void
  setInputSource(const typename Pcl::PointCloudSourceConstPtr& cloud) override;
  void
  setInputTarget(const typename Pcl::PointCloudTargetConstPtr& cloud) override;

  /** \brief Adds one side of a pair; the n-th source belongs to the n-th target. Empty clouds are
   * allowed. \throws BadArgument the cloud is null */
  void
  addInputSource(const typename Pcl::PointCloudSourceConstPtr& cloud);
  void
  addInputTarget(const typename Pcl::PointCloudTargetConstPtr& cloud);

  /** \brief Adds the correspondence estimation of a pair: for no pair, or one per pair.
   * \throws BadArgument null */
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
  /** \return the mean squared distance [m^2] of the source points to the targets of their pairs,
   * after the motion; the largest double without a distance, like in PCL
   * \param[in] max_range [m^2] larger squares are left out, like in PCL */
  double
  getFitnessScore(double max_range = std::numeric_limits<double>::max());

protected:
  /** \throws BadArgument no pairs, or different numbers of sources and targets (PCL prints a
   * message), and see ICP6D */
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

private:
  struct Target;  ///< the joined targets, each with its tree
  struct Sources; ///< the joined sources
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
