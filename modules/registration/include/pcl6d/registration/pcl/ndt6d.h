// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/registration/ndt.h>
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/registration/registration.h>

#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The normal distributions transform as a drop-in for
 * pcl::NormalDistributionsTransform, which says honestly whether it converged.
 *
 * hasConverged() is true only if a step fell below the epsilons and the distributions leave
 * no motion open (PCL: at the iteration limit, too, unless setIterationLimitConverges()). The
 * epsilon is a length in metres, and so large a turn in radians, unless
 * setTransformationRotationEpsilon() (a cosine, as in PCL) says otherwise; 1e-3 unless set
 * (PCL: 0.1, with which it stops after the first short step). setMaximumIterations: 35 unless
 * set. Sums are in double, about a place near the target; the same bits for any number of
 * threads. Without effect, as in PCL: setMaxCorrespondenceDistance, rejectors and
 * estimations.
 * \code
 * pcl6d::NDT6D<pcl::PointXYZ, pcl::PointXYZ> ndt;
 * ndt.setResolution(1);
 * ndt.setInputSource(data);
 * ndt.setInputTarget(model);
 * ndt.align(aligned, guess);
 * \endcode
 * \note Source: see ndt(). \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class NDT6D : public pcl::Registration<PointSource, PointTarget, Scalar> {
public:
  using Base = pcl::Registration<PointSource, PointTarget, Scalar>;
  using typename Base::Matrix4;
  using typename Base::PointCloudSource;
  using typename Base::PointCloudTarget;
  using Ptr = pcl::shared_ptr<NDT6D<PointSource, PointTarget, Scalar>>;
  using ConstPtr = pcl::shared_ptr<const NDT6D<PointSource, PointTarget, Scalar>>;

  NDT6D();
  NDT6D(const NDT6D&) = delete;
  NDT6D&
  operator=(const NDT6D&) = delete;

  /** \throws BadArgument the cloud is null */
  void
  setInputSource(const typename Base::PointCloudSourceConstPtr& cloud) override;
  void
  setInputTarget(const typename Base::PointCloudTargetConstPtr& cloud) override;

  /** \brief Side of a cell [m]; 1 unless set. */
  void
  setResolution(float resolution)
  {
    resolution_ = resolution;
    grid_.reset();
  }
  float
  getResolution() const
  {
    return resolution_;
  }

  /** \brief Cells with fewer points do not count; 6 unless set; less than 3 are 3. */
  void
  setMinPointPerVoxel(unsigned int count)
  {
    least_points_ = count < 3 ? 3 : count;
    grid_.reset();
  }

  /** \brief The longest step [m, rad]; 0.1 unless set. */
  void
  setStepSize(double step_size)
  {
    options_.step_size = step_size;
  }
  double
  getStepSize() const
  {
    return options_.step_size;
  }

  /** \brief The share of points that belong to no distribution; 0.55 unless set. PCL's
   * spelling, and the right one. */
  void
  setOulierRatio(double ratio)
  {
    options_.outlier_ratio = ratio;
  }
  double
  getOulierRatio() const
  {
    return options_.outlier_ratio;
  }
  void
  setOutlierRatio(double ratio)
  {
    options_.outlier_ratio = ratio;
  }
  double
  getOutlierRatio() const
  {
    return options_.outlier_ratio;
  }

  /** \return the mean score of a source point of the last align() */
  double
  getTransformationLikelihood() const
  {
    return result_.likelihood;
  }
  double
  getTransformationProbability() const
  {
    return result_.likelihood;
  }
  int
  getFinalNumIteration() const
  {
    return this->nr_iterations_;
  }

  /** \brief As ICP6D::setIterationLimitConverges(). */
  void
  setIterationLimitConverges(bool converges)
  {
    iteration_limit_converges_ = converges;
  }

  /** \param[in] num_threads 0: one per core; never changes the result */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    options_.num_threads = num_threads;
  }

  /** \return what the last align() came to, in the frame of the target */
  const NdtResult&
  result() const
  {
    return result_;
  }

protected:
  /** \throws BadArgument a setting breaks its rule */
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

private:
  NdtOptions
  effectiveOptions() const;

  float resolution_ = 1;
  std::size_t least_points_ = 6;
  bool iteration_limit_converges_ = false;
  NdtOptions options_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(); ///< of the grid [m]
  std::shared_ptr<const DistributionGrid> grid_; ///< of the target; null: to be made
  NdtResult result_;
};

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/ndt6d.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(NDT6D)
} // namespace pcl6d
