// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/registration/icp_options.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief Matched points of two scans: the pairs of a link in GraphSLAM.
 * \ingroup graph_relaxation */
struct LinkPairs {
  std::size_t from = 0; ///< scan a
  std::size_t to = 0;   ///< scan b
  Points points_from;   ///< u [m], each in the frame of scan a
  Points points_to;     ///< v [m], partners of u, in the frame of scan b
  /** empty, or a symmetric N per pair in the world axes: the pair costs Z . N Z. The largest
   * eigenvalue is near 1, as in planeToPlane(). N is assumed to turn with the mean of both
   * scans, so that no torque acts on the map as a whole. */
  std::vector<Eigen::Matrix3d> norms;
  /** empty, or a weight per pair; pairs of weight 0 do not count */
  std::vector<double> weights;
  bool trusted = false; ///< never switched off, as links between successive scans
  /** how many pairs are worth one independent pair, as near points share the errors of their
   * normals: the sums are divided by it, the count is not; >= 1 */
  double redundancy = 1;
};

/** \brief The sums over the pairs of a link at the current poses (book 5.2.2, 5.3.1, 5.3.3),
 * about the mean of its points to keep precision in maps far from the origin.
 *
 * Pair k: pa = T_a u, pb = T_b v, both in the world; c = (pa + pb) / 2, Z = pa - pb; w: the
 * pair's weight (of a pair with a norm N: times the size of N, tr N^2 / tr N). The unknown is a
 * small motion v(p) = xb + s (p - centre) + x x (p - centre) with a change of scale s: M = [I |
 * c' | -[c']x]. Rows and columns are in the order xb, s, x; without row and column 3, the 6 of
 * the rigid motion remain.
 * \ingroup graph_relaxation */
struct LinkSums {
  using Matrix = Eigen::Matrix<double, 7, 7>;
  using Vector = Eigen::Matrix<double, 7, 1>;

  std::size_t count = 0; ///< finite pairs with a weight
  double weight = 0;     ///< sum w
  /** how many scalar equations the pairs are worth, (sum tr W)^2 / sum tr W^2 with W = w
   * I or w N: 3 m for m pairs of equal weight, m for planes */
  double equations = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< weighted mean of c [m]
  Eigen::Vector3d mean_z = Eigen::Vector3d::Zero();  ///< weighted mean of Z [m]
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero(); ///< sum w c' c'^T [m^2]
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();   ///< sum w c' Z'^T [m^2]
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  ///< sum w Z' Z'^T [m^2]
  Matrix A = Matrix::Zero();                         ///< sum M^T W M
  Vector b = Vector::Zero();                         ///< sum M^T W Z
  double residual_sq = 0;                            ///< sum Z . W Z [m^2]

  /** \return sqrt(sum Z . W Z / sum w) [m] */
  double
  rms() const;
};

/** \brief Sums of one link, over blocks of fixed size merged in a fixed order; pairs with a
 * non-finite coordinate are skipped.
 * \param[in] T_world_from, T_world_to poses of the two scans
 * \param[in] kernel weighs each pair by its residual over the scale (MAD) of the link's residuals
 * \throws BadArgument the sizes of the vectors differ */
LinkSums
sumLink(const LinkPairs& pairs,
        const Eigen::Isometry3d& T_world_from,
        const Eigen::Isometry3d& T_world_to,
        RobustKernel kernel = RobustKernel::kNone);

/** \brief Sums of many links at once, with the bits of sumLink(); free threads take links and
 * blocks.
 * \param[in] poses T_world_scan of every scan
 * \param[in] num_threads 0: a thread per core
 * \param[in] sharing null: this process has the pairs of each link; else of the links whose
 * later scan is its own, and the sums are exchanged */
std::vector<LinkSums>
sumLinks(const std::vector<LinkPairs>& links,
         const std::vector<Eigen::Isometry3d>& poses,
         RobustKernel kernel = RobustKernel::kNone,
         unsigned int num_threads = 0,
         WorkSharing* sharing = nullptr);

} // namespace pcl6d
