// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {
namespace verification {

/** \brief The scans connected by consistent links to the largest component of a map. */
struct Ties {
  std::vector<bool> tied;          ///< connected; one per scan
  std::vector<Rejection> cut_from; ///< one per scan: why its links were cut, or empty
  std::vector<bool> cut;           ///< for each link: rejected together with the cut
};

/** Links connect their scans below this probability of a wrong pose, a single link as well as all
 * links between two parts of a map together. */
constexpr double kGoodBelow = 0.01;

/** \brief Constants of the test of cuts: of all links between two parts of a map together. */
struct CutConstants {
  double even_share; ///< of poses along even surfaces among wrong poses
  double
      precision; ///< of the background: sum of both parameters of a beta distribution
  double least_background; ///< share of contradicted patches
  double rest_patches; ///< weight of the rest of the map in the background of a link
  double surfaces;     ///< weight of the surface evidence
  double cut_from;     ///< least probability of a wrong place that cuts a part off
};

/** \return the constants in use, with their sources in calibration.h */
CutConstants
cutConstants();

/** \brief Connects scans by consistent and unverified links, except the links between two parts of
 * a map that jointly contradict their relative pose: after a jump of the odometry to a similar
 * place, a few links across the jump may seem consistent. Tested parts: consecutive scans, because
 * an odometry error displaces all later scans, and parts connected by a single link.
 * \param[in] background of the map */
Ties
tiesOf(std::size_t num_scans, const std::vector<LinkCheck>& links, double background);

/** \brief The same with other constants, for calibration (test/benchmark/bench_cuts.cpp). */
Ties
tiesOf(std::size_t num_scans,
       const std::vector<LinkCheck>& links,
       double background,
       const CutConstants& constants);

/** \brief Tests a scan as tiesOf() tests parts, but no other part: where few links are known besides
 * those of the scan, a cut between other scans leaves no link for a background.
 * \param[in] cut_from least probability of a wrong place that rejects the scan
 * \return why the scan's links together contradict its pose; empty if they do not */
Rejection
contradictionOfScan(std::size_t scan,
                    std::size_t num_scans,
                    const std::vector<LinkCheck>& links,
                    double background,
                    double cut_from);

} // namespace verification
} // namespace pcl6d
