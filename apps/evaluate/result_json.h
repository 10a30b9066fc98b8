// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/error_statistics.h>

#include <Eigen/Core>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pcl6d::app {

using Json = nlohmann::ordered_json;

inline Json
statisticsJson(const ErrorStatistics& errors)
{
  return {{"rms", errors.rms},
          {"mean", errors.mean},
          {"median", errors.median},
          {"max", errors.max}};
}

/** \return the elements of a matrix, row by row */
template <typename Matrix>
std::vector<double>
rowByRow(const Matrix& matrix)
{
  const Eigen::Matrix<double,
                      Matrix::RowsAtCompileTime,
                      Matrix::ColsAtCompileTime,
                      Eigen::RowMajor>
      rows = matrix;
  return {rows.data(), rows.data() + rows.size()};
}

/** \return a JSON file; names of files need not be UTF-8, but JSON must be */
inline std::string
jsonText(const Json& json, int indent = 2)
{
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace pcl6d::app
