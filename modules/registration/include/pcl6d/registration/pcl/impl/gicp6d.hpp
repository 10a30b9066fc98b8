// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/gicp6d.h>

#include <pcl/types.h>

#include <memory>
#include <string>
#include <utility>

namespace PCL6D_EXPORTS pcl6d {
namespace registration {

using Covariances = std::vector<Eigen::Matrix3d>;

/** \brief Checks a covariance, and bounds its eigenvalues from below.
 * \param[in] name, index for the message
 * \throws BadArgument not finite, symmetric and positive */
Eigen::Matrix3d
checkedCovariance(const Eigen::Matrix3d& covariance,
                  const char* name,
                  std::size_t index);

/** \return the direction of least variance of each covariance */
Normals
leastDirections(const Covariances& covariances);

/** \return whether every covariance is 1 along a plane and epsilon across; true for an empty set */
bool
arePlanes(const Covariances& covariances, double epsilon);

/** \return a covariance of 1 along a plane and epsilon across; 1 in every direction for a normal
 * of zero length */
Eigen::Matrix3d
covarianceOf(const Eigen::Vector3f& normal, double epsilon);
Covariances
covariancesOf(const Normals& normals, double epsilon);

/** \return the inverse of C_t + R C_s R^T */
Eigen::Matrix3d
mahalanobisOf(const Eigen::Matrix3d& R,
              const Eigen::Matrix3d& of_source,
              const Eigen::Matrix3d& of_target);

/** \brief The points and covariances of both sides. */
struct GicpSides {
  Points source;
  Points target;
  Covariances of_source;
  Covariances of_target;
};

/** \return the Gauss-Newton step of the sum of the pairs' Mahalanobis distances at a pose */
RigidEstimate
gicpStep(const GicpSides& sides,
         const Eigen::Isometry3d& T,
         const std::vector<IcpPair>& pairs,
         const IcpOptions& options);

/** \return the derivatives of a cost by roll, pitch and yaw */
Eigen::Vector3d
derivativeByAngles(const Eigen::Vector3d& roll_pitch_yaw,
                   const Eigen::Matrix3d& dCost_dR_T);

/** \return the covariances of chosen points, checked
 * \throws BadArgument not one covariance per point of the cloud */
template <typename Given>
Covariances
chosenCovariances(const Given& given,
                  std::size_t cloud_size,
                  const pcl::Indices& indices,
                  const Points& points,
                  const char* name)
{
  if (given.size() != cloud_size)
    throw BadArgument(std::string("GICP6D: ") + name + " has " +
                      std::to_string(cloud_size) + " points, but " +
                      std::to_string(given.size()) + " covariances are given");
  Covariances chosen(indices.size(), Eigen::Matrix3d::Identity());
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (points[i].allFinite()) {
      const auto index = static_cast<std::size_t>(indices[i]);
      chosen[i] = checkedCovariance(given[index], name, index);
    }
  return chosen;
}

} // namespace registration

template <typename PointSource, typename PointTarget, typename Scalar>
struct GICP6D<PointSource, PointTarget, Scalar>::Run {
  std::shared_ptr<const typename Base::Target> target;
  Points source;
  Normals source_normals;
  double epsilon = 0;
  registration::Covariances of_source, of_target; ///< empty unless given
};

template <typename PointSource, typename PointTarget, typename Scalar>
GICP6D<PointSource, PointTarget, Scalar>::GICP6D()
{
  this->reg_name_ = "GICP6D";
  this->setMetric(Metric::kGicp);
  this->max_iterations_ = 200; // PCL's values
  this->corr_dist_threshold_ = 5;
  this->transformation_epsilon_ = 5e-4;
  this->options_.rotation_epsilon = 2e-3;
  this->epsilon_is_squared_ = false;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
GICP6D<PointSource, PointTarget, Scalar>::setInputSource(
    const typename Base::Base::PointCloudSourceConstPtr& cloud)
{
  Base::setInputSource(cloud);
  input_covariances_.reset();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
GICP6D<PointSource, PointTarget, Scalar>::setInputTarget(
    const typename Base::Base::PointCloudTargetConstPtr& cloud)
{
  Base::setInputTarget(cloud);
  target_covariances_.reset();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
GICP6D<PointSource, PointTarget, Scalar>::setSourceCovariances(
    const MatricesVectorPtr& covariances)
{
  input_covariances_ = covariances && covariances->empty() ? nullptr : covariances;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
GICP6D<PointSource, PointTarget, Scalar>::setTargetCovariances(
    const MatricesVectorPtr& covariances)
{
  target_covariances_ = covariances && covariances->empty() ? nullptr : covariances;
  this->forgetTargetNormals();
}

template <typename PointSource, typename PointTarget, typename Scalar>
Normals
GICP6D<PointSource, PointTarget, Scalar>::sourceNormals(const Points& points,
                                                        const IcpOptions& options) const
{
  if (!input_covariances_)
    return Base::sourceNormals(points, options);
  return registration::leastDirections(
      registration::chosenCovariances(*input_covariances_,
                                      this->input_->size(),
                                      *this->indices_,
                                      points,
                                      "the source"));
}

template <typename PointSource, typename PointTarget, typename Scalar>
Normals
GICP6D<PointSource, PointTarget, Scalar>::targetNormals(const pcl::Indices& indices,
                                                        const Points& points,
                                                        const PointTree* tree,
                                                        const IcpOptions& options) const
{
  if (!target_covariances_)
    return Base::targetNormals(indices, points, tree, options);
  return registration::leastDirections(registration::chosenCovariances(
      *target_covariances_, this->target_->size(), indices, points, "the target"));
}

/** Covariances of planes are represented by normals; others need a step of their own. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
GICP6D<PointSource, PointTarget, Scalar>::addStep(const Sides& sides,
                                                  const IcpOptions& options,
                                                  IcpHooks& hooks)
{
  using namespace registration;
  run_.reset();
  const bool are_given = input_covariances_ || target_covariances_;
  if (are_given && (options.metric != Metric::kGicp || hooks.minimise))
    throw BadArgument(
        "GICP6D: with covariances neither another metric nor a transformation "
        "estimation can be set");
  if (options.metric != Metric::kGicp)
    return;
  const auto run = std::make_shared<Run>();
  *run = {
      sides.target, sides.source, sides.source_normals, options.gicp_epsilon, {}, {}};
  if (input_covariances_)
    run->of_source = chosenCovariances(*input_covariances_,
                                       this->input_->size(),
                                       *this->indices_,
                                       sides.source,
                                       "the source");
  if (target_covariances_)
    run->of_target = chosenCovariances(*target_covariances_,
                                       this->target_->size(),
                                       sides.target->indices,
                                       sides.target->points,
                                       "the target");
  run_ = run;
  if (arePlanes(run->of_source, run->epsilon) &&
      arePlanes(run->of_target, run->epsilon))
    return;
  if (options.robust != RobustKernel::kNone)
    throw BadArgument("GICP6D: covariances that are no planes take no robust kernel");
  const auto both = std::make_shared<GicpSides>();
  *both = {sides.source, sides.target->points, run->of_source, run->of_target};
  if (!input_covariances_)
    both->of_source = covariancesOf(sides.source_normals, run->epsilon);
  if (!target_covariances_)
    both->of_target = covariancesOf(sides.target->normals, run->epsilon);
  hooks.minimise = [both, options](const Eigen::Isometry3d& T,
                                   const std::vector<IcpPair>& pairs) {
    return gicpStep(*both, T, pairs, options);
  };
}

template <typename PointSource, typename PointTarget, typename Scalar>
Eigen::Matrix3d
GICP6D<PointSource, PointTarget, Scalar>::mahalanobis(std::size_t index) const
{
  using namespace registration;
  require(run_ && index < run_->source.size(),
          "index",
          index,
          "that of a source point of the last align()");
  const auto& target = *run_->target;
  Eigen::Isometry3d T = this->result_.T_target_source;
  T.pretranslate(-target.origin);
  const Eigen::Vector3f query =
      (T * run_->source[index].template cast<double>()).template cast<float>();
  const float limit_sq = limitThatIncludes(this->corr_dist_threshold_);
  const Neighbour found = target.search ? target.search(query, limit_sq)
                                        : target.tree->nearest(query, limit_sq);
  if (found.index < 0)
    return Eigen::Matrix3d::Identity();
  const auto partner = static_cast<std::size_t>(found.index);
  return mahalanobisOf(
      T.linear(),
      run_->of_source.empty() ? covarianceOf(run_->source_normals[index], run_->epsilon)
                              : run_->of_source[index],
      run_->of_target.empty() ? covarianceOf(target.normals[partner], run_->epsilon)
                              : run_->of_target[partner]);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
GICP6D<PointSource, PointTarget, Scalar>::computeRDerivative(
    const Vector6d& x,
    const Eigen::Matrix3d& dCost_dR_T,
    Vector6d& g) const
{
  g.template tail<3>() =
      registration::derivativeByAngles(x.template tail<3>(), dCost_dR_T);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
GICP6D<PointSource, PointTarget, Scalar>::estimateRigidTransformationBFGS(
    const PointCloudSource& /*source*/,
    const pcl::Indices& /*source_indices*/,
    const PointCloudTarget& /*target*/,
    const pcl::Indices& /*target_indices*/,
    Matrix4& /*transformation*/)
{
  throw BadArgument(
      "GICP6D has no inner optimizer: it takes one Gauss-Newton step between "
      "two searches; call align()");
}

} // namespace pcl6d
