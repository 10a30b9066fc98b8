// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/registration/coarse_estimate.h>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of searchByOverlap(). Missing values follow from the target, with r the
 * median distance of its points from their centroid. */
struct OverlapSearchOptions {
  std::optional<Eigen::Vector3d> translation_window; ///< [m] x, y, z: largest error of
                                                     ///< the guess; > 0. Missing: 1.25,
                                                     ///< 1.25 and 0.375 times the
                                                     ///< derived first cube
  Eigen::Vector3d rotation_window{0.1, 0.1, 0.35};   ///< [rad] roll, pitch, yaw; > 0
  std::optional<double> first_cube; ///< [m] coarsest edge; > 0. Missing: r / 6, at
                                    ///< least 8 median spacings, and large enough for a
                                    ///< wide translation window
  std::optional<double> last_cube;  ///< [m] edges are halved down to about this
                                    ///< length; > 0. Missing: a quarter of r / 6
                                    ///< or of 8 spacings
  int max_cubes = 600;              ///< of the source, at most; >= 3
  int max_candidates = 4;           ///< placements pursued at a time; >= 2
  double min_score = 0.3;           ///< accepted share of the source's cubes; in [0, 1]
  double max_ambiguity = 0.95;      ///< accepted second score / score; in [0, 1]
  unsigned int num_threads = 0;     ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Improves an initial pose by octree overlap search (book 5.1.1), for errors
 * too large for ICP.
 *
 * Both scans become sets of occupied cubes. Of 3375 placements on a grid about the
 * guess (5 steps in x, y and yaw, 3 in z, roll and pitch; turns are about the source's
 * centroid) the search keeps the placements with most cube centres of the source in
 * occupied cubes of the target; cubes and window are then halved about each. To find
 * rival placements, the search pursues several local maxima more than the first cube
 * apart. Ties: the smallest motion.
 * \param[in] target, source points [m] in any frames; points that are not
 * finite are left out
 * \param[in] guess T_target_source, within the window of the truth
 * \return score: share of the source's cubes of the last size. kTooFewPairs: fewer
 * than 3 cubes, or the score is below min_score; kRankDeficient: another placement
 * is equally good
 * \throws BadArgument an option is invalid, or the guess is not rigid
 * \note Source: A. Nüchter, K. Lingemann, J. Hertzberg, H. Surmann, "6D SLAM - 3D
 * mapping outdoor environments", JFR 24(8/9), 2007. \ingroup registration */
CoarseEstimate
searchByOverlap(const Points& target,
                const Points& source,
                const Eigen::Isometry3d& guess,
                const OverlapSearchOptions& options = {});

} // namespace pcl6d
