// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Robust z-scores: (x - median) / (1.4826 MAD), where MAD is the median of |x -
 * median|. A spread below `least_spread` is raised to least_spread: a tiny deviation
 * among equal values is then no outlier.
 * \param[in] values NaN: not measured, with a score of NaN
 * \param[in] least_spread in the unit of the values; > 0
 * \note Source: B. Iglewicz, D. C. Hoaglin, "How to detect and handle outliers", 1993;
 * they call |z| > 3.5 an outlier. \ingroup benchmarking */
std::vector<double>
robustScores(const std::vector<double>& values, double least_spread);

} // namespace pcl6d
