// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

/** \file Matrices in JSON. Internal to the module io. */
namespace pcl6d {

/** \return the numbers of a matrix or vector, row by row */
template <typename Matrix>
nlohmann::ordered_json
rowByRow(const Matrix& matrix)
{
  nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      numbers.push_back(matrix(row, column));
  return numbers;
}

} // namespace pcl6d
