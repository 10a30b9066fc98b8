// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/twist.h>

#include <cstddef>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Sums over the pairs of the metrics with normals: the normal equations A u = b of
 * sum w |m - d - v(d)|^2_N for a small motion v, the twist u about the centroid of the source
 * points (book 4.1.2 with normals).
 *
 * d: source point, m: target point [m], w: weight, |e|^2_N = e . N e. Point to plane:
 * N = n n^T with the unit normal n in m. Plane to plane: planeToPlane(). Sums of parts are
 * merged pairwise (4.1.6), like PairSums. \ingroup registration */
struct PlaneSums {
  using Matrix = Eigen::Matrix<double, 6, 6>;

  std::size_t count = 0;                                 ///< pairs
  double weight = 0;                                     ///< W = sum w
  Eigen::Vector3d mean_source = Eigen::Vector3d::Zero(); ///< c_d [m]
  Matrix A = Matrix::Zero(); ///< sum w J^T N J, J u = v(d); of planes J^T n = (n, (d -
                             ///< c_d) x n)
  Twist b = Twist::Zero();   ///< sum w J^T N (m - d)
  double residual_sq = 0;    ///< sum w |m - d|^2_N [m^2]
  double distance_sq = 0;    ///< sum w |m - d|^2 [m^2]
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero(); ///< sum w d' d'^T [m^2]

  /** \return s_d = sum w |d - c_d|^2 [m^2] */
  double
  sourceSq() const
  {
    return scatter.trace();
  }

  /** \return the sums of two disjoint sets of pairs */
  static PlaneSums
  merge(const PlaneSums& a, const PlaneSums& b);
};

/** \brief N of Generalized-ICP: the inverse of the sum of two covariances, 1 along a plane and
 * epsilon across, times 2 epsilon. Two equal planes thereby give their distance. A normal of zero
 * length means a covariance of 1 in every direction.
 * \param[in] n, m unit normals; their signs do not matter
 * \note Source: A. Segal, D. Haehnel, S. Thrun, "Generalized-ICP", RSS 2009; inverted in closed
 * form, since both covariances are a unit matrix minus a dyad. */
Eigen::Matrix3d
planeToPlane(const Eigen::Vector3d& n, const Eigen::Vector3d& m, double epsilon = 1e-3);

/** \brief Adds up pairs, eight at a time, about the first source point: points far from the origin
 * lose no digits. The bits depend on the order of the pairs. */
class PlaneAccumulator {
public:
  /** Condition on pairs that fix a motion, for error messages. */
  static constexpr const char* kNeeds =
      "the normals must resist all six directions of motion";

  /** \brief Adds a pair. Only the direction of the normal counts; pairs with a value that is not
   * finite, or a normal of zero length (never estimated), are skipped. */
  void
  add(const Eigen::Vector3d& source,
      const Eigen::Vector3d& target,
      const Eigen::Vector3d& normal,
      double weight = 1);

  /** \brief Adds a pair with a symmetric N; skipped if a value is not finite. */
  void
  addNorm(const Eigen::Vector3d& source,
          const Eigen::Vector3d& target,
          const Eigen::Matrix3d& N,
          double weight = 1);

  /** \brief Adds a pair with planeToPlane() of two unit normals; skipped if a value is not
   * finite. */
  void
  addPlanes(const Eigen::Vector3d& source,
            const Eigen::Vector3d& target,
            const Eigen::Vector3d& n,
            const Eigen::Vector3d& m,
            double epsilon,
            double weight = 1);

  PlaneSums
  sums() const;

private:
  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kSums = 39;

  /** Values of the pairs to be added next, one in each lane. */
  struct Waiting {
    std::size_t count = 0;
    double weight[kLanes] = {};
    double source[3][kLanes] = {}; ///< from the origin [m]
    double error[3][kLanes] = {};  ///< from source to target [m]
    double norm[6][kLanes] = {};   ///< N: xx, xy, xz, yy, yz, zz
  };

  bool
  begin(const Eigen::Vector3d& source, const Eigen::Vector3d& target, double weight);
  void
  end();
  static void
  addLanes(const Waiting& waiting, double (*sums)[kLanes]);

  std::size_t count_ = 0;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Waiting waiting_;
  double sums_[kSums][kLanes] = {}; ///< about origin_, see plane_sums.cpp
};

} // namespace pcl6d
