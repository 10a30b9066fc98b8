// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl6d::visualization {

/** \return whether a point can be drawn: finite coordinates of at most 1e7 m, far above
 * any map; float sums and squares of such coordinates stay finite */
inline bool
canBeDrawn(const Eigen::Vector3f& p)
{
  return (p.array().abs() <= 1e7F).all(); // not so NaN
}

/** \return a random selection of the indices within a budget, reproducible from the index */
std::vector<std::size_t>
thinned(const std::vector<std::size_t>& indices, std::size_t budget);

/** \return the quantile of the values at the given share (nearest rank, from an even
 * sample); \param[in] values not empty */
float
quantile(std::vector<float> values, double share);

/** \return the mean distance of neighbours on a picture [px]
 * \param[in] pixels column, row, layer; each within the picture */
double
pixelSpacing(const std::vector<Eigen::Vector3f>& pixels, int width, int height);

} // namespace pcl6d::visualization
