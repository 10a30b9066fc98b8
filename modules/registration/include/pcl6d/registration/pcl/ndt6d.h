// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/registration/ndt.h>
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/registration/registration.h>

#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The normal distributions transform: drop-in for pcl::NormalDistributionsTransform with a
 * reliable hasConverged().
 *
 * hasConverged() is true only if a step fell below the epsilons and the distributions leave no
 * motion open (PCL: at the iteration limit, too, unless setIterationLimitConverges()). The epsilon
 * is a length in metres, and likewise a turn in radians, unless set by
 * setTransformationRotationEpsilon() (a cosine, like in PCL); 1e-3 unless set (PCL: 0.1, which
 * stops after the first short step). setMaximumIterations: 35 unless set. Sums are in double, about
 * a place near the target; bit-identical for any number of threads. Without effect, like in PCL:
 * setMaxCorrespondenceDistance, rejectors and estimations.
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

  /** \brief Whether cells with their points on one line have no plane, see Distribution. kAuto
   * unless set: applied if the target, seen from the origin, is a scan of lines or rings;
   * otherwise results are bit-identical to kNever. */
  void
  setLineGrowth(LineGrowth growth)
  {
    line_growth_ = growth;
    grid_.reset();
  }
  LineGrowth
  getLineGrowth() const
  {
    return line_growth_;
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

  /** \brief The share of points outside the distributions; 0.55 unless set. In PCL's spelling and
   * in correct spelling. */
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

  /** \brief See ICP6D::setIterationLimitConverges(). */
  void
  setIterationLimitConverges(bool converges)
  {
    iteration_limit_converges_ = converges;
  }

  /** \param[in] num_threads 0: a thread per core; never changes the result */
  void
  setNumberOfThreads(unsigned int num_threads)
  {
    options_.num_threads = num_threads;
  }

  /** \return the result of the last align(), in the frame of the target */
  const NdtResult&
  result() const
  {
    return result_;
  }

protected:
  /** \throws BadArgument a setting is invalid */
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

private:
  NdtOptions
  effectiveOptions() const;

  float resolution_ = 1;
  std::size_t least_points_ = 6;
  LineGrowth line_growth_ = LineGrowth::kAuto;
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
