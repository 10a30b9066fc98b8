// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/pcl/icp6d.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Generalized-ICP: drop-in for pcl::GeneralizedIterativeClosestPoint, ICP6D with
 * Metric::kGicp. Takes one Gauss-Newton step between two searches, hence PCL's settings of the
 * inner optimizer have no effect. The defaults are PCL's: 5 m, 200 iterations, at rest below
 * 5e-4 m (setTransformationEpsilon(), here not squared) and 2e-3 rad in a step.
 *
 * Covariances may be given instead of normals, for one side or both. Covariances of 1 along a plane
 * and 1e-3 across, PCL's own for example, cost no more than normals; other covariances enter each
 * step unchanged.
 * \note Source: A. Segal, D. Haehnel, S. Thrun, "Generalized-ICP", RSS 2009.
 * \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class GICP6D : public ICP6D<PointSource, PointTarget, Scalar> {
public:
  using Base = ICP6D<PointSource, PointTarget, Scalar>;
  using typename Base::Matrix4;
  using typename Base::PointCloudSource;
  using typename Base::PointCloudTarget;
  using Ptr = pcl::shared_ptr<GICP6D<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<const GICP6D<PointSource, PointTarget, Scalar>>;
  using MatricesVector =
      std::vector<Eigen::Matrix3d, Eigen::aligned_allocator<Eigen::Matrix3d>>;
  using MatricesVectorPtr = pcl::shared_ptr<MatricesVector>;
  using MatricesVectorConstPtr = pcl::shared_ptr<const MatricesVector>;
  using Vector6d = Eigen::Matrix<double, 6, 1>;

  GICP6D();

  /** \brief See ICP6D; forgets the covariances of the side, like in PCL. */
  void
  setInputSource(const typename Base::Base::PointCloudSourceConstPtr& cloud) override;
  void
  setInputTarget(const typename Base::Base::PointCloudTargetConstPtr& cloud) override;

  /** \brief The covariances of the cloud's points, to be set after the cloud; null or empty:
   * estimated, 1 along a plane and 1e-3 across (PCL's unit, mandatory if only one side is given).
   * With indices, each point keeps the covariance of its index (PCL: of its place among the
   * indices). Covariances of points that are not finite do not matter.
   *
   * align() throws BadArgument if their number differs from the number of points, if a covariance
   * is not symmetric and positive, or if another metric, an estimation or a robust kernel is
   * combined with covariances other than planes. Eigenvalues below 1e-9 of the largest are raised
   * to this value. */
  void
  setSourceCovariances(const MatricesVectorPtr& covariances);
  void
  setTargetCovariances(const MatricesVectorPtr& covariances);

  /** \return the matrix of the Mahalanobis distance between a point, by its place among the
   * indices, and its partner at the final pose: the inverse of the sum of both covariances [PCL's
   * unit]; the unit matrix without a partner, like in PCL
   * \throws BadArgument the index is out of range, or align() was not called */
  Eigen::Matrix3d
  mahalanobis(std::size_t index) const;

  /** \brief The derivative of a cost by roll, pitch and yaw, into g[3], g[4], g[5], of the
   * rotation Rz(x[5]) Ry(x[4]) Rx(x[3]) \param[in] dCost_dR_T the transposed derivative of
   * the cost by the rotation matrix */
  void
  computeRDerivative(const Vector6d& x,
                     const Eigen::Matrix3d& dCost_dR_T,
                     Vector6d& g) const;

  /** \brief PCL's inner optimizer, which PCL itself only calls inside align().
   * \throws BadArgument always: no inner optimizer exists here */
  void
  estimateRigidTransformationBFGS(const PointCloudSource& source,
                                  const pcl::Indices& source_indices,
                                  const PointCloudTarget& target,
                                  const pcl::Indices& target_indices,
                                  Matrix4& transformation);

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

  /** \brief PCL's name for setNormalNeighbours(); clamped to [3, 64]. */
  void
  setCorrespondenceRandomness(int neighbours)
  {
    this->setNormalNeighbours(static_cast<std::size_t>(std::clamp(neighbours, 3, 64)));
  }
  int
  getCorrespondenceRandomness() const
  {
    return static_cast<int>(this->normal_settings_.neighbours);
  }

  /** \brief PCL's settings of the optimizer between two searches, kept for their getters. The
   * single step in place of the optimizer is exact for the linear problem, and repeated by ICP. */
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

protected:
  using typename Base::Sides;

  Normals
  sourceNormals(const Points& points, const IcpOptions& options) const override;
  Normals
  targetNormals(const pcl::Indices& indices,
                const Points& points,
                const PointTree* tree,
                const IcpOptions& options) const override;
  void
  addStep(const Sides& sides, const IcpOptions& options, IcpHooks& hooks) override;

private:
  struct Run; ///< data of both clouds in the last align()

  int optimizer_iterations_ = 20;
  double translation_gradient_ = 1e-2;
  double rotation_gradient_ = 1e-2;
  MatricesVectorPtr input_covariances_, target_covariances_;
  std::shared_ptr<const Run> run_;
};

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/gicp6d.hpp>

#include <pcl/types.h>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(GICP6D)
} // namespace pcl6d
