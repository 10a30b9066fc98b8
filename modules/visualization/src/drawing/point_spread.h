// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl6d::visualization {

/** \return whether a point has a place on a picture: its coordinates are finite and up to
 * 1e7 m, as no map is larger; then all sums and squares of them are finite in float, too */
inline bool
canBeDrawn(const Eigen::Vector3f& p)
{
  return (p.array().abs() <= 1e7F).all(); // not so NaN
}

/** \return the indices that stay when a random choice, fixed by the index, thins them to
 * a budget */
std::vector<std::size_t>
thinned(const std::vector<std::size_t>& indices, std::size_t budget);

/** \return the value below which the given share of the values lies (nearest rank, from
 * an even sample of them); \param[in] values not empty */
float
quantile(std::vector<float> values, double share);

/** \return the mean distance of neighbours on a picture [px]
 * \param[in] pixels column, row, layer; all on the picture */
double
pixelSpacing(const std::vector<Eigen::Vector3f>& pixels, int width, int height);

} // namespace pcl6d::visualization
