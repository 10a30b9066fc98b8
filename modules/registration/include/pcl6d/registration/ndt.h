// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How the points of a cell of a grid are spread. */
struct Distribution {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(); ///< [m]
  /** [1 / m^2] inverse of the covariance, whose smaller standard deviations count as at least
   * a tenth of the largest */
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /** the same in units of its largest eigenvalue, less the smallest: in which directions it
   * holds a point better than along its widest; n n^T of a plane, 0 of a ball */
  Eigen::Matrix3d form = Eigen::Matrix3d::Zero();
};

/** \brief The model of the normal distributions transform: the normal distributions of the
 * points in the cells of a grid, with a tree over their means. */
class DistributionGrid {
public:
  /** \param[in] resolution [m] side of a cell, > 0
   * \param[in] least_points cells with fewer do not count; >= 3
   * \throws BadArgument a rule is broken, or a point lies outside the grid (voxelKey()) */
  DistributionGrid(const Points& points,
                   double resolution,
                   std::size_t least_points = 6);

  const std::vector<Distribution>&
  distributions() const
  {
    return distributions_;
  }
  const PointTree&
  tree() const
  {
    return tree_;
  }
  double
  resolution() const
  {
    return resolution_;
  }

private:
  double resolution_;
  std::vector<Distribution> distributions_;
  PointTree tree_;
};

/** \brief Knobs of ndt(). Defaults as in pcl::NormalDistributionsTransform, but for the
 * epsilons. */
struct NdtOptions {
  double step_size = 0.1; ///< [m, rad] longest step; > 0
  double outlier_ratio =
      0.55; ///< share of points that belong to no distribution; in (0, 1)
  int max_iterations = 35;           ///< > 0
  double translation_epsilon = 1e-3; ///< [m] stop at a step no longer ...
  double rotation_epsilon = 1e-3;    ///< [rad] ... that turns no more; >= 0
  unsigned int num_threads = 0;      ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief The outcome of ndt(). */
struct NdtResult {
  Status status = Status::kTooFewPairs; ///< as that of IcpResult
  IcpStop stop = IcpStop::kTooFewPairs;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d last_step = Eigen::Isometry3d::Identity();
  int iterations = 0;
  std::size_t points = 0; ///< source points near a distribution
  double likelihood =
      0; ///< mean score of a source point, PCL's transformation likelihood
  Localizability localizability; ///< which motions the distributions fix
};

/** \brief The normal distributions transform: the motion that makes source points most
 * likely where the target's distributions are.
 *
 * Each step is Newton's, with a Hessian from which the downward bends of the score are left
 * out as far as they would make it indefinite, so that it goes uphill without a line
 * search. The same bits for any number of threads.
 * \return never throws on data; kTooFewPairs and kDiverged return the guess
 * \throws BadArgument an option breaks its rule
 * \note Source: P. Biber, W. Strasser, IROS 2003; M. Magnusson, "The three-dimensional normal
 * distributions transform", Örebro 2009, 6.1 to 6.9. \ingroup registration */
NdtResult
ndt(const DistributionGrid& target,
    const Points& source,
    const Eigen::Isometry3d& guess,
    const NdtOptions& options = {});

} // namespace pcl6d
