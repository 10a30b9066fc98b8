// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

/** \file Matrices in JSON, and what is wrong with a JSON file. Internal to the module
 * io. */
namespace PCL6D_EXPORTS pcl6d {

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

/** \brief Takes the numbers of a matrix or vector, row by row. \param[in] name for messages
 * \throws std::invalid_argument not as many numbers as the matrix has */
template <typename Matrix>
void
fill(const nlohmann::ordered_json& json, const std::string& name, Matrix& matrix)
{
  const auto values = json.get<std::vector<double>>();
  if (values.size() != static_cast<std::size_t>(matrix.size()))
    throw std::invalid_argument(name + ": expected " + std::to_string(matrix.size()) +
                                " numbers, got " + std::to_string(values.size()));
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    matrix(i / matrix.cols(), i % matrix.cols()) = values[static_cast<std::size_t>(i)];
}

/** \return the message of the JSON library without its number in brackets */
inline std::string
reasonOf(const nlohmann::ordered_json::exception& error)
{
  const std::string message = error.what();
  const std::size_t end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}

} // namespace pcl6d
