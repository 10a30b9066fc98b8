// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

/** \file Reading JSON so that every error names the file and the place in it. Internal to
 * the module semantic_map. */
namespace pcl6d::semantic_map {

using Json = nlohmann::ordered_json;

/** \brief A value of a JSON file and where it stands. All functions throw IoFailed
 * "file: /planes/3/area: value, but must be rule". */
class JsonPlace {
public:
  /** \param[in] json kept by reference */
  JsonPlace(const Json& json, std::string file, std::string pointer = "")
  : json_(json), file_(std::move(file)), pointer_(std::move(pointer))
  {}

  [[noreturn]] void
  fail(const std::string& message) const;

  /** \throws IoFailed unless the rule is kept; names the value */
  void
  require(bool kept, const std::string& rule) const;

  /** \return the member of that name, which must be there */
  JsonPlace
  operator/(const std::string& key) const;

  /** \return the member of that name, if it is there and not null */
  std::optional<JsonPlace>
  find(const std::string& key) const;

  /** \brief Calls the function for each element of an array. */
  void
  forEach(const std::function<void(const JsonPlace& element)>& body) const;

  double
  number() const;
  std::size_t
  count() const;
  int
  integer() const;
  bool
  boolean() const;
  std::string
  text() const;
  std::vector<std::size_t>
  counts() const;

  /** \brief Takes as many numbers as the matrix has, row by row; rows may be arrays. */
  template <typename Matrix>
  void
  fill(Matrix& matrix) const
  {
    const std::vector<double> values = numbers(static_cast<std::size_t>(matrix.size()));
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
      matrix(i / matrix.cols(), i % matrix.cols()) =
          values[static_cast<std::size_t>(i)];
  }

  Eigen::Vector3d
  vector3() const;
  std::vector<Eigen::Vector3d>
  points() const;

  /** \return 16 numbers, row by row, that are a rigid motion */
  Eigen::Isometry3d
  pose() const;

  /** \return six rows of six numbers */
  Eigen::Matrix<double, 6, 6>
  matrix6() const;

private:
  std::vector<double>
  numbers(std::size_t size) const;

  const Json& json_;
  std::string file_;
  std::string pointer_;
};

/** \brief Reads a JSON file and hands its content on. \throws IoFailed it cannot be read or
 * is no JSON; names line and column */
void
readJson(const std::string& file, const std::function<void(const JsonPlace&)>& take);

/** \return the numbers of a matrix or vector, row by row */
template <typename Matrix>
Json
rowByRow(const Matrix& matrix)
{
  Json numbers = Json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      numbers.push_back(matrix(row, column));
  return numbers;
}

} // namespace pcl6d::semantic_map
