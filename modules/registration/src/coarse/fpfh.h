// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coarse/feature_scan.h"

#include <array>
#include <vector>

namespace pcl6d::registration {

constexpr std::size_t kFpfhSize = 33;
using Fpfh = std::array<float, kFpfhSize>;

/** \brief Computes fast point feature histograms, 11 bins for each of three angles; the bins of an
 * angle sum up to 100. Equivalent to pcl::FPFHEstimation, without its library: the 100 000 symbols
 * of the library delayed the start of every program by 0.1 s.
 * \param[in] radius [m] of the surroundings
 * \return a histogram per point; zeros for a point without normal or neighbours
 * \note Source: R. B. Rusu, N. Blodow, M. Beetz, "Fast point feature histograms (FPFH)
 * for 3D registration", ICRA 2009. */
std::vector<Fpfh>
computeFpfh(const FeatureScan& scan, double radius, unsigned int num_threads);

} // namespace pcl6d::registration
