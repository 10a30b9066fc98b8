// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/instantiate.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/search/kd_tree.h>

#include <pcl/registration/registration.h>

namespace pcl6d {

/** \brief ICP with six degrees of freedom as a drop-in pcl::Registration, which says
 * honestly whether it converged.
 *
 * Where pcl::IterativeClosestPoint reports success at the iteration limit and on NaN,
 * here hasConverged() is true only if the motion fell below both thresholds;
 * result().status says why not. Runs in parallel with the same bits for any number of
 * threads; all sums are in double. Owns its search tree (FLANN is never built). PCL's
 * setters are honoured: setMaximumIterations (100 unless set),
 * setMaxCorrespondenceDistance (no limit unless set), setTransformationEpsilon (squared
 * [m^2], as in PCL), setTransformationRotationEpsilon (cosine, as in PCL), setIndices.
 * align() never throws on data; not converged, getFinalTransformation() is the last
 * good estimate or the guess. Not taken over from PCL, and refused by align() with
 * BadArgument: a search method that is no pcl6d::KdTree, correspondence rejectors, a
 * correspondence estimation, a transformation estimation of another library. Without
 * effect: setEuclideanFitnessEpsilon and the RANSAC settings.
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

  /** \brief Limit of the pair distance at the start [m], which shrinks by a tenth per
   * iteration to setMaxCorrespondenceDistance() (annealing, book 4.1.5). 0: off. */
  void
  setMaxCorrespondenceDistanceStart(double distance);

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

  /** \return what the last align() came to */
  const IcpResult&
  result() const
  {
    return result_;
  }

protected:
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

private:
  IcpOptions
  effectiveOptions() const;
  RigidMinimiser
  minimiser() const;

  IcpOptions options_;
  IcpObserver observer_;
  IcpResult result_;
};

} // namespace pcl6d
#include <pcl6d/registration/impl/icp6d.hpp>
namespace pcl6d {
PCL6D_DECLARE_PAIR_INSTANCES(ICP6D)
} // namespace pcl6d
