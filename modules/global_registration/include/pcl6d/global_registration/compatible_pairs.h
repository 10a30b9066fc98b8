// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of compatiblePairs(). */
struct CompatibilityOptions {
  double noise =
      0.1; ///< [m] how far apart the points of a right pair may lie after the
           ///< right motion; finite, > 0
  /** of more pairs, so many, evenly, are looked at, each against each; of the others those
   * join that agree with all that are left; in [3, 30000] */
  std::size_t max_pairs = 3000;
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Of pairs of points of two clouds, most of them wrong, those that one rigid motion can
 * bring together, without looking for it: any two have the same distance in both clouds,
 * within twice the noise.
 *
 * Pairs are the vertices of a graph, with an edge between two that agree. Right ones all
 * agree, so that they form a clique; wrong ones agree by chance. A greedy search looks for
 * the largest clique, starting at the pairs with the largest core numbers: a pair of a clique
 * of n has a core number of n - 1 at least, so that all with smaller ones are left out as
 * soon as such a clique is found. The largest clique is not promised (that is NP-hard). With
 * 95 of 100 pairs wrong it is all right pairs as a rule, while these are more than what agrees
 * by chance, which is a handful of 3000. Distances do not see a mirror image: a motion is to be
 * estimated from the pairs and looked at.
 * \param[in] source, target one point each per pair [m]; pairs with points that are not
 * finite are left out
 * \return places of pairs, ascending: any two of them agree; so small a number as chance
 * gives says that no motion was found
 * \throws BadArgument an option breaks its rule, or the numbers of points differ
 * \note Time and memory grow with the square of max_pairs: 3000 take 0.05 s and 1 MB.
 * \note Sources: J. Shi, H. Yang, L. Carlone, "ROBIN: a graph-theoretic approach to reject
 * outliers in robust estimation", ICRA 2021 (invariants, cores, cliques); H. Lim et al.,
 * "KISS-Matcher", ICRA 2025; V. Batagelj, M. Zaversnik, "An O(m) algorithm for cores
 * decomposition of networks", 2003; R. A. Rossi et al., "Fast maximum clique algorithms for
 * large graphs", WWW 2014 (greedy search in order of cores).
 * \ingroup global_registration */
std::vector<std::size_t>
compatiblePairs(const Points& source,
                const Points& target,
                const CompatibilityOptions& options = {});

} // namespace pcl6d
