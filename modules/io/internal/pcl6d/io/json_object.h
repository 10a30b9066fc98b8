// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/** \file JSON files, with errors that name the file and the position. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A value of a JSON document with its path; keeps the document alive. A missing value or
 * a wrong type throws IoFailed "file: /planes/3/area: ..."
 *
 * Every JSON file is read by this class; nlohmann::ordered_json is used for writing. */
class JsonValue {
public:
  using Json = nlohmann::ordered_json;

  /** \brief The whole of a document. \param[in] file name, for messages */
  JsonValue(std::string file, Json json);

  /** \throws IoFailed "file: /pointer: message" */
  [[noreturn]] void
  fail(const std::string& message) const;

  /** \brief For a member, which may be missing. \throws IoFailed "file: /pointer/key: message" */
  [[noreturn]] void
  fail(const std::string& key, const std::string& message) const;

  /** \throws IoFailed "... value, but must be rule" unless the rule is kept */
  void
  require(bool kept, const std::string& rule) const;

  bool
  isObject() const;
  bool
  isArray() const;
  bool
  isText() const;
  bool
  isNull() const;

  /** \return whether the value is a finite number */
  bool
  isNumber() const;

  /** \return whether the value is an array of two */
  bool
  isPair() const;

  /** \return the member of an object, which must exist */
  JsonValue
  operator/(const std::string& key) const;

  bool
  has(const std::string& key) const;

  /** \return the member of an object; empty if missing */
  std::optional<JsonValue>
  member(const std::string& key) const;

  /** \return the member of an object; empty if missing or null */
  std::optional<JsonValue>
  find(const std::string& key) const;

  /** \return the keys of an object, in the order of the file */
  std::vector<std::string>
  keys() const;

  /** \throws IoFailed an object has a key that is not listed */
  void
  allow(const std::vector<std::string>& known) const;

  /** \return the elements of an array */
  std::vector<JsonValue>
  elements() const;

  /** \return the elements of the array under a key, which may be missing */
  std::vector<JsonValue>
  elements(const std::string& key) const;

  /** \return a finite number */
  double
  number() const;

  /** \return a whole number >= 0 */
  std::size_t
  count() const;

  /** \return a whole number up to a million */
  int
  integer() const;
  bool
  boolean() const;
  std::string
  text() const;
  std::vector<std::size_t>
  counts() const;

  /** \return the numbers of an array; an error names the array */
  std::vector<double>
  numbers() const;

  /** \brief Copies the numbers into the matrix, row by row; the number of values must match,
   * rows may be arrays. */
  void
  fill(Eigen::Ref<Eigen::MatrixXd> matrix) const;

  Eigen::Vector2d
  vector2() const;
  Eigen::Vector3d
  vector3() const;
  std::vector<Eigen::Vector3d>
  points() const;

  /** \return 16 numbers, row by row, checked to be a rigid motion */
  Eigen::Isometry3d
  pose() const;

  /** \return six rows of six numbers */
  Eigen::Matrix<double, 6, 6>
  matrix6() const;

  /** \brief Reads the member of an object, if present. \throws IoFailed of another type */
  template <typename T>
  void
  read(const std::string& key, T& value) const
  {
    if (const std::optional<JsonValue> json = member(key))
      json->take(value);
  }

  /** \return the member of an object, which must exist */
  template <typename T>
  T
  get(const std::string& key) const
  {
    T value{};
    (*this / key).take(value);
    return value;
  }

  /** \return the value as JSON text, shortened */
  std::string
  excerpt() const;

  /** \return the whole value as JSON text \throws nlohmann's exceptions for invalid UTF-8 */
  std::string
  dump() const;

  const Json&
  json() const
  {
    return *json_;
  }

  /** \return "file: /pointer" */
  std::string
  place() const;

private:
  JsonValue(std::shared_ptr<const std::string> file,
            std::shared_ptr<const Json> json,
            std::string pointer);

  /** \return a member of the value, under the same owner */
  JsonValue
  part(const Json& json, const std::string& name) const;
  void
  appendNumbers(std::vector<double>& values) const;

  void
  take(double& value) const
  {
    value = number();
  }
  void
  take(int& value) const
  {
    value = integer();
  }
  void
  take(std::uint64_t& value) const
  {
    value = count();
  }
  void
  take(std::string& value) const
  {
    value = text();
  }
  void
  take(Eigen::Vector2d& value) const
  {
    value = vector2();
  }
  void
  take(Eigen::Vector3d& value) const
  {
    value = vector3();
  }

  std::shared_ptr<const std::string> file_;
  std::shared_ptr<const Json> json_; ///< shares the document
  std::string pointer_;
};

/** \return the document; comments are allowed \param[in] name of the file, for messages
 * \throws IoFailed naming file and line */
JsonValue
parseJson(const std::string& text, const std::string& name);

/** \return the content of a JSON file \throws IoFailed naming file and line */
JsonValue
readJson(const std::filesystem::path& file);

/** \return the text as a JSON string in ASCII; invalid UTF-8 is replaced */
std::string
jsonText(const std::string& text);

bool
isUtf8(const std::string& text);

} // namespace pcl6d
