// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstdint>

/** \file Smooth random fields for rough surfaces. */
namespace pcl6d::simulation {

/** \brief Value noise: random numbers at the points of the unit lattice, blended in
 * between. Continuous, with a continuous gradient; a function of its arguments alone.
 * \return a number in [-1, 1] */
double
valueNoise(const Eigen::Vector3d& p, std::uint64_t seed);

/** \brief Three octaves of value noise: waves of length 1, 1/2 and 1/4, each half as
 * high as the previous. \return a number in [-1, 1] */
double
fractalNoise(const Eigen::Vector3d& p, std::uint64_t seed);

} // namespace pcl6d::simulation
